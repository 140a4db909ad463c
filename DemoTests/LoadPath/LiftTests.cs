using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What rests and overlaps what carries it is moved out by its pose, along with all that it carries, and has no velocity meanwhile.</summary>
public class LiftTests
{
    // Part of the overlap beyond the band that is taken out for each substep, and part of the band to which it is: as the solver has them.
    const double PerSubstep = .04, Aimed = .9375;

    /// <summary>
    /// Boxes that are dropped on each other and never sleep stay where they came to rest. (Pushed out by velocities, that the load path and friction
    /// were at odds about, they walked aside by half their size in twenty seconds, and fell.)
    /// </summary>
    [Theory]
    [InlineData(2, 1, .1f, 4)]
    [InlineData(4, 1, .01f, 4)]
    [InlineData(4, 1, .3f, 4)]
    [InlineData(5, 1, .3f, 8)]
    [InlineData(3, .2f, .03f, 8)]
    [InlineData(5, .2f, .1f, 8)]
    [InlineData(8, .2f, .1f, 4)]
    [InlineData(10, 5, .1f, 4)]
    public void What_was_dropped_stays_where_it_comes_to_rest(int count, float size, float gap, int substeps)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, substeps: substeps);
        var boxes = Enumerable.Range(0, count)
            .Select(i => world.Add(new Vector3(0, .5f + i + gap * (i + 1), 0) * size, new Vector3(size), size * size * size)).ToArray();
        world.Run(5);
        var places = boxes.Select(world.Position).ToArray();
        // Each lies on the one below, and none has sunk in by more than the band.
        for (int i = 0; i < count; ++i)
            Assert.InRange(places[i].Y / size, .5f + i - .0006f * (i + 1), .5f + i + .0011f * (i + 1));

        world.Run(15);

        for (int i = 0; i < count; ++i)
            Assert.InRange((world.Position(boxes[i]) - places[i]).Length() / size, 0, 1e-4f);
    }

    /// <summary>A share of what is left for each substep, and no velocity.</summary>
    [Theory]
    [InlineData(1, .03f, 4)]
    [InlineData(1, .1f, 1)]
    [InlineData(1, .01f, 16)]
    [InlineData(.01f, .0002f, 4)]
    [InlineData(50, .2f, 4)]
    public void An_overlap_goes_by_a_share_for_each_substep(float size, float overlap, int substeps)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, substeps: substeps);
        var boxes = Enumerable.Range(0, 2)
            .Select(i => world.Add(new Vector3(0, (.5f + i) * size - overlap * (i + 1), 0), new Vector3(size), size * size * size)).ToArray();
        var rest = Aimed * ContactMaterialWide.BandPerExtent * size * .5;
        for (int step = 1; step <= 8; ++step)
        {
            world.Step();
            var left = rest + (overlap - rest) * Math.Pow(1 - PerSubstep, step * substeps);
            for (int i = 0; i < 2; ++i)
            {
                Assert.Equal((i + 1) * left, (.5 + i) * size - world.Position(boxes[i]).Y, .01 * left * (i + 1) + 1e-6 * size);
                Assert.InRange(world.Velocity(boxes[i]).Length(), 0, 1e-4f * MathF.Sqrt(9.81f * size));
            }
        }
    }

    /// <summary>A tower that stands askew in the ground is set upright like one thing: none of its boxes goes aside of the others.</summary>
    [Fact]
    public void What_stands_on_it_is_turned_along()
    {
        const int count = 6;
        const float tilt = .01f;
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, tilt);
        // The foot is .005 deep in the mean: one edge is on the ground, the other .01 below.
        var foot = new Vector3(0, -.005f, 0);
        var boxes = Enumerable.Range(0, count).Select(i =>
        {
            var box = world.Add(foot + Vector3.Transform(new Vector3(0, .5f + i, 0), turn), Vector3.One, 1);
            world.Simulation.Bodies[box].Pose.Orientation = turn;
            return box;
        }).ToArray();

        world.Run(2);

        var up = Vector3.Transform(Vector3.UnitY, world.Simulation.Bodies[boxes[0]].Pose.Orientation);
        Assert.InRange(MathF.Abs(up.X), 0, .0012f);
        var lowest = world.Position(boxes[0]);
        // Its foot is where it was, and the others straight above.
        Assert.InRange((lowest - up * .5f - foot).X, -3e-4f, 3e-4f);
        for (int i = 1; i < count; ++i)
            Assert.InRange((world.Position(boxes[i]) - lowest - up * i).Length(), 0, 6e-4f);
    }

    /// <summary>No faster than the limit of recovery, which is meant for each body against the one below.</summary>
    [Theory]
    [InlineData(.2f)]
    [InlineData(1)]
    public void It_is_no_faster_than_recovery(float maximumRecoveryVelocity)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, maximumRecoveryVelocity: maximumRecoveryVelocity);
        var boxes = Enumerable.Range(0, 2).Select(i => world.Add(new Vector3(0, .5f + i - .25f * (i + 1), 0), Vector3.One, 1)).ToArray();
        var way = maximumRecoveryVelocity * LoadPathWorld.Dt;
        for (int step = 1; step <= 3; ++step)
        {
            world.Step();
            for (int i = 0; i < 2; ++i)
                Assert.Equal(.5f + i - (.25f - way * step) * (i + 1), world.Position(boxes[i]).Y, 1e-3f * way);
        }
    }

    /// <summary>What joints hold down in the ground stays there, and does not stir.</summary>
    [Fact]
    public void What_is_welded_down_is_left_in_peace()
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var anchor = world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(
            new Vector3(0, 3, 0), new CollidableDescription(world.Simulation.Shapes.Add(new Sphere(.1f))), -1));
        var box = world.Add(new Vector3(0, .48f, 0), Vector3.One, 1);
        world.Simulation.Solver.Add(anchor, box, new BepuPhysics.Constraints.Weld
        {
            LocalOffset = new Vector3(0, -2.52f, 0),
            LocalOrientation = Quaternion.Identity,
            SpringSettings = new(10, 1),
        });
        world.Run(2);
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            Assert.InRange(world.Velocity(box).Length(), 0, 1e-3f);
        }
    }
}
