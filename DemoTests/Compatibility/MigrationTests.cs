using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Compatibility;

/// <summary>What Docs/Migration.md says of behaviour, row by row, where no other test shows it.</summary>
public class MigrationTests
{
    [Fact]
    public void Stages_are_timed()
    {
        using var world = new TestWorld();
        world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        world.Step();
        Assert.True(world.Simulation.Profiler[world.Solver] > 0);
        Assert.True(world.Simulation.Profiler[world.Simulation.NarrowPhase] > 0);
    }

    // Types of these names are in every game, beside a using of this namespace.
    [Fact]
    public void Ready_made_callbacks_do_not_collide_with_those_of_games()
    {
        string[] taken = ["NarrowPhaseCallbacks", "PoseIntegratorCallbacks", "DemoNarrowPhaseCallbacks", "DemoPoseIntegratorCallbacks"];
        Assert.DoesNotContain(typeof(Simulation).Assembly.GetExportedTypes(), type => Array.IndexOf(taken, type.Name) >= 0);
        Assert.Equal(typeof(Simulation).Namespace, typeof(DefaultNarrowPhaseCallbacks).Namespace);
        Assert.Equal(typeof(Simulation).Namespace, typeof(DefaultPoseIntegratorCallbacks).Namespace);
    }

    [Fact]
    public void Kinematic_bodies_with_constraints_are_found()
    {
        using var world = new TestWorld();
        var anchor = world.AddKinematic(new Sphere(.1f), RigidPose.Identity);
        var free = world.AddKinematic(new Sphere(.1f), new RigidPose(new Vector3(5, 0, 0)));
        var bob = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(0, -1, 0)));
        world.Solver.Add(anchor, bob, new BallSocket { LocalOffsetB = Vector3.UnitY });
        var found = new List<BodyHandle>();
        foreach (var handle in new[] { anchor, free, bob })
        {
            var body = world.Bodies[handle];
            if (body.Kinematic && body.Constraints.Count > 0)
                found.Add(handle);
        }
        Assert.Equal([anchor], found);
    }

    [Fact]
    public void Springs_without_a_frequency_are_rigid()
    {
        Assert.Equal(SpringSettings.Rigid, default);
        // As a joint without settings hangs, so does one of the greatest frequency that the substep holds.
        var sag = Sag(default);
        Assert.Equal(sag, Sag(new SpringSettings(60 * 4 * SpringSettings.JointCyclesPerSubstep(1), 1)), .1f * sag);
    }

    [Fact]
    public void Frequencies_are_capped()
    {
        Assert.Equal(30, 60 * 4 * SpringSettings.JointCyclesPerSubstep(1));
        Assert.Equal(30, 60 * 4 * SpringSettings.ContactCyclesPerSubstep(1));
        Assert.Equal(Sag(new SpringSettings(30, 1)), Sag(new SpringSettings(300, 1)));
        Assert.True(Sag(new SpringSettings(15, 1)) > 3 * Sag(new SpringSettings(30, 1)));
    }

    // How far a weight pulls a joint apart. A spring of frequency f gives way by g / (2 pi f)^2.
    static float Sag(SpringSettings spring)
    {
        using var world = new TestWorld();
        var anchor = world.AddKinematic(new Sphere(.1f), RigidPose.Identity);
        var bob = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(0, -1, 0)));
        world.Solver.Add(anchor, bob, new BallSocket { LocalOffsetB = Vector3.UnitY, SpringSettings = spring });
        world.Step(240);
        return -1 - world.Bodies[bob].Pose.Position.Y;
    }

    [Fact]
    public void Switches_that_are_kept_for_callers_do_nothing()
    {
        static List<ulong> Run(bool deterministic)
        {
            using var world = new TestWorld();
            world.Simulation.Deterministic = deterministic;
            world.AddStatic(new Box(10, 2, 10), new RigidPose(new Vector3(0, -1, 0)));
            var random = new Random(4);
            for (int i = 0; i < 20; ++i)
            {
                var pose = new RigidPose(new Vector3(0, 2 + i, 0), TestWorld.Turn(random));
                world.AddDynamic(new Box(.5f, .6f, .7f), 1, pose, new BodyVelocity(default, new Vector3(3)));
            }
            return world.HashSteps(60);
        }
        Assert.Equal(Run(true), Run(false));
    }

    [Fact]
    public void Shared_shapes_are_left_alone()
    {
        using var pool = new BufferPool();
        var shapes = new Shapes(pool, 4);
        var sphere = shapes.Add(new Sphere(1));
        var world = new TestWorld(shapes: shapes);
        world.Bodies.Add(BodyDescription.CreateKinematic(RigidPose.Identity, sphere, -1));
        world.Simulation.Clear();
        Assert.True(shapes.Exists(sphere));
        world.Dispose();
        Assert.True(shapes.Exists(sphere));
        shapes.Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void Triangles_have_one_side_unless_they_ask_for_two()
    {
        static float HeightAfterASecond(bool twoSided, bool fromAbove)
        {
            using var world = new TestWorld();
            // Seen from above its corners go round clockwise, so it faces up.
            var triangle = new Triangle(new Vector3(-9, 0, 9), new Vector3(-9, 0, -9), new Vector3(9, 0, 0)) { TwoSided = twoSided };
            if (!fromAbove)
                (triangle.A, triangle.B) = (triangle.B, triangle.A);
            world.AddStatic(triangle, RigidPose.Identity);
            var ball = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(-3, 1, 0)));
            world.Step(60);
            return world.Bodies[ball].Pose.Position.Y;
        }
        Assert.Equal(.5f, HeightAfterASecond(twoSided: false, fromAbove: true), .02f);
        Assert.True(HeightAfterASecond(twoSided: false, fromAbove: false) < -2);
        Assert.Equal(.5f, HeightAfterASecond(twoSided: true, fromAbove: false), .02f);
    }
}
