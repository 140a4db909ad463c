using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>Statics that a game moves in each step push what stands on them, as lifts.</summary>
/// <remarks>The load path took the speed at which contacts push out for a load: eight boxes on such a lift of .2 m/s sank in by 1.1 m, and fell.</remarks>
public class MovedStaticTests
{
    // Nothing is handed down to such a lift, so a stack stands on it as it does by sweeps.
    [Theory]
    [InlineData(1, .2f, false), InlineData(3, .2f, false), InlineData(8, .2f, false), InlineData(8, .2f, true), InlineData(3, 1, true), InlineData(8, 1, false)]
    public void What_stands_on_a_lift_sinks_in_no_deeper_than_by_sweeps(int count, float speed, bool inPlace) =>
        Assert.InRange(Sunk(LoadPathMode.WhereNeeded, count, speed, inPlace), 0, 2 * Sunk(LoadPathMode.Off, count, speed, inPlace) + .001f);

    static float Sunk(LoadPathMode mode, int count, float speed, bool inPlace) => LiftedStack.Sunk(mode, count, speed, world =>
    {
        var lift = AddStatic(world);
        return way => Move(world, lift, way, inPlace);
    });

    /// <summary>What is moved along under a stack, or away from it, bears it like the ground.</summary>
    // What goes down in each step is a fall and an impact, after which boxes walk aside by luck: 16 to 144 mm, with other bits in one place or another.
    [Theory, InlineData(.2f, 0, 0, .02f), InlineData(0, -.2f, .5f, .15f)]
    public void What_goes_aside_or_down_bears_as_the_ground(float aside, float down, float friction, float mostAside)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: friction);
        var floor = AddStatic(world);
        var boxes = LiftedStack.Add(world, 8);
        for (int i = 0; i < 60; ++i)
            world.Step();
        for (int i = 0; i < 180; ++i)
        {
            Move(world, floor, new Vector3(aside, down, 0) * LoadPathWorld.Dt, inPlace: false);
            world.Step();
        }
        var ground = world.Simulation.Statics[floor].Pose.Position.Y + .25f;
        for (int i = 0; i < boxes.Length; ++i)
        {
            var position = world.Simulation.Bodies[boxes[i]].Pose.Position;
            Assert.InRange(position.Y, ground + .5f + i - .01f, ground + .5f + i + .01f);
            Assert.InRange(position.X, -mostAside, mostAside);
        }
    }

    /// <summary>A world that is saved after a static was moved and before the step goes on from there with the same bits.</summary>
    [Fact]
    public void A_snapshot_knows_what_was_moved()
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var lift = AddStatic(world);
        var boxes = LiftedStack.Add(world, 3);
        for (int i = 0; i < 30; ++i)
            world.Step();
        Move(world, lift, new Vector3(0, .02f, 0), inPlace: false);
        using var snapshot = new SimulationSnapshot(world.Simulation.BufferPool);
        world.Simulation.Save(snapshot);
        var first = Positions();
        world.Simulation.Restore(snapshot);
        Assert.Equal(first, Positions());
        // What was moved before other steps is not in the snapshot.
        Move(world, lift, new Vector3(0, .02f, 0), inPlace: false);
        world.Simulation.Restore(snapshot);
        Assert.Equal(first, Positions());

        Vector3[] Positions()
        {
            world.Step();
            return [.. boxes.Select(box => world.Simulation.Bodies[box].Pose.Position)];
        }
    }

    static StaticHandle AddStatic(LoadPathWorld world) =>
        world.Simulation.Statics.Add(new StaticDescription(LiftedStack.Start, world.Simulation.Shapes.Add(new Box(8, .5f, 8))));

    static void Move(LoadPathWorld world, StaticHandle handle, Vector3 way, bool inPlace)
    {
        var moved = world.Simulation.Statics[handle];
        if (inPlace)
        {
            moved.Pose.Position += way;
            moved.UpdateBounds();
            return;
        }
        var description = moved.GetDescription();
        description.Pose.Position += way;
        moved.ApplyDescription(description);
    }
}
