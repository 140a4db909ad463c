using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What an explosion leaves leans on each other in no order: that is no arch, and takes no work as if it were one.</summary>
public class RubbleTests
{
    const int Side = 7;
    const int Height = 8;

    /// <summary>
    /// Of 49 stacks of eight boxes in which something has gone off, in the twelve seconds after. A round goes over each patch of an island: for each body and
    /// step that was 31 patches where all that leans was relaxed as an arch is, and is 10.
    /// </summary>
    [Fact]
    public void What_leans_in_no_row_is_relaxed_by_few_rounds()
    {
        const int steps = 720;
        var relaxed = 0L;
        float[] strengths = [4, 5, 6, 8];
        foreach (var strength in strengths)
        {
            using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
            AddStacks(world.Simulation);
            Explode(world.Simulation, new Vector3(1.5f, .2f, 1.5f), strength);
            for (int step = 0; step < steps; ++step)
            {
                world.Step();
                relaxed += world.Simulation.NarrowPhase.RelaxedCount;
            }
        }
        Assert.InRange(relaxed / ((double)strengths.Length * steps * Side * Side * Height), 1, 12);
    }

    static void AddStacks(Simulation simulation)
    {
        var box = new Box(.5f, .5f, .5f);
        var shape = simulation.Shapes.Add(box);
        var inertia = box.ComputeInertia(1);
        for (int i = 0; i < Side * Side * Height; ++i)
        {
            var position = new Vector3(i / Height / Side * .51f, .25f + i % Height * .5f, i / Height % Side * .51f);
            simulation.Bodies.Add(BodyDescription.CreateDynamic(position, inertia, shape, .01f));
        }
    }

    static void Explode(Simulation simulation, Vector3 center, float strength)
    {
        for (int i = 0; i < simulation.Bodies.ActiveSet.Count; ++i)
        {
            var body = simulation.Bodies[simulation.Bodies.ActiveSet.IndexToHandle[i]];
            var way = body.Pose.Position - center;
            body.ApplyLinearImpulse(Vector3.Normalize(way) * (strength / (1 + way.LengthSquared())));
        }
    }
}
