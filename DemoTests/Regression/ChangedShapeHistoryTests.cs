using System.Numerics;
using BepuPhysics.Collidables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A pair in contact whose shape becomes one that keeps a history, or no longer does, goes on. (A pair that was cached without a history
/// was looked up in the histories by an index that none has.)
/// </summary>
public class ChangedShapeHistoryTests
{
    [Fact]
    public void A_resting_body_may_change_between_shapes_with_and_without_history()
    {
        using var world = new TestWorld();
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        var box = world.Simulation.Shapes.Add(new Box(1, 1, 1));
        var cylinder = world.Simulation.Shapes.Add(new Cylinder(.5f, 1));
        var body = world.AddDynamic(new Box(1, 1, 1), 1, new Vector3(0, .5f, 0));
        world.Step(30);
        for (int i = 0; i < 6; ++i)
        {
            world.Bodies.SetShape(body, i % 2 == 0 ? cylinder : box);
            for (int step = 0; step < 20; ++step)
            {
                world.Step();
                world.Simulation.Validate();
            }
            Assert.Equal(1, world.Simulation.NarrowPhase.PairCount);
            Assert.InRange(world.Bodies[body].Pose.Position.Y, .495f, .505f);
        }
    }
}
