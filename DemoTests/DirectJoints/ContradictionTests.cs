using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.DirectJoints;

/// <summary>Joints that contradict each other, as games make them by mistake: solved at once they give way, as they do by sweeps.</summary>
public class ContradictionTests(ITestOutputHelper output)
{
    /// <summary>
    /// Knots of joints on a floor, none of which is where it should be. Solved at once as stiff as can be three of four had more than a kilojoule, and some
    /// more than a bomb; by sweeps one in sixty has.
    /// </summary>
    [Theory]
    [InlineData(DirectJointsChoice.Off, 1)]
    [InlineData(DirectJointsChoice.Always, 3)]
    [InlineData(DirectJointsChoice.WhereNeeded, 3)]
    public void A_knot_is_no_bomb(DirectJointsChoice mode, int most)
    {
        var energies = Enumerable.Range(0, 60).Select(seed => GreatestEnergy(mode, seed)).Order().ToArray();
        output.WriteLine($"{mode}: median {energies[30]} J, most {energies[^1]} J, {energies.Count(energy => energy > 1000)} above 1 kJ");
        Assert.InRange(energies.Count(energy => energy > 1000), 0, most);
        // What a joint of half a metre may be off by, with the stiffness of the sweeps, is some kilojoules.
        Assert.InRange(energies[^1], 0, 1e5);
        Assert.InRange(energies[30], 0, 100);
    }

    // After the half second in which the parts come together.
    static double GreatestEnergy(DirectJointsChoice mode, int seed)
    {
        using var world = Floor(mode);
        var bodies = ContradictingJoints.AddKnot(world, seed);
        double greatest = 0;
        for (int step = 0; step < 300; ++step)
        {
            world.Step();
            if (step > 30)
                greatest = Math.Max(greatest, Energy(world, bodies));
        }
        return greatest;
    }

    static TestWorld Floor(DirectJointsChoice mode)
    {
        var world = new TestWorld(new AccuracySettings { DirectJoints = mode });
        world.AddStatic(new Box(400, 1, 400), new RigidPose(new(0, -.5f, 0)));
        return world;
    }

    static double Energy(TestWorld world, IEnumerable<BodyHandle> bodies)
    {
        double sum = 0;
        foreach (var handle in bodies)
        {
            var body = world.Bodies[handle];
            sum += .5 / body.LocalInertia.InverseMass * body.Velocity.Linear.LengthSquared();
        }
        Assert.True(double.IsFinite(sum));
        return sum;
    }

    /// <summary>A net that sagged under a load that sweeps do not bear comes back where it is to be solved at once.</summary>
    [Fact]
    public void A_loop_that_only_sagged_is_put_right()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None, DirectJoints = DirectJointsChoice.Off });
        ContradictingJoints.AddNet(world, 9, load: 800);
        float Lowest()
        {
            ref var set = ref world.Bodies.ActiveSet;
            var lowest = 0f;
            for (int body = 0; body < set.Count; ++body)
                lowest = MathF.Min(lowest, set.MotionStates[body].Pose.Position.Y);
            return lowest;
        }
        world.Step(60);
        var sagged = Lowest();
        world.Solver.DirectJoints = DirectJointsMode.WhereNeeded;
        world.Step(420);
        output.WriteLine($"{sagged} m, {Lowest()} m");
        Assert.InRange(sagged, -5, -.5f);
        // Links of .4 m, four to each side, of which a taut net has none to spare.
        Assert.InRange(Lowest(), -.2f, 0);
    }
}
