using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Arms stay to the bit while a stack rests, on every way that a contact constraint goes from step to step.</summary>
public class KeptArmsPathTests
{
    const int Count = 6;
    const int SettlingSteps = 180;
    const int WatchedSteps = 60;
    // What is held by the load path moves by less than rounding, so that little would be shown.
    static readonly AccuracySettings bySweeps = new() { LoadPath = LoadPathChoice.Off };

    [Fact]
    public void Where_the_test_of_a_pair_is_run_in_each_step()
    {
        using var world = new TestWorld(bySweeps);
        AddStack(world, new Box(1, 1, 1));
        AssertKeepsArms(world);
    }

    /// <summary>Pairs of hulls are not tested while they have hardly moved: their contacts are carried along.</summary>
    [Fact]
    public void Where_the_test_of_a_pair_is_skipped()
    {
        using var world = new TestWorld(bySweeps);
        Vector3[] corners = [.. from x in (float[])[-.5f, .5f] from y in (float[])[-.5f, .5f] from z in (float[])[-.5f, .5f] select new Vector3(x, y, z)];
        var hull = new ConvexHull(corners, world.Pool, out _);
        AddStack(world, hull);
        world.Step();
        Assert.True(world.Simulation.NarrowPhase.Pairs.Histories.Count > 0);
        AssertKeepsArms(world);
        hull.Dispose(world.Pool);
    }

    [Fact]
    public void Where_pairs_may_bounce()
    {
        using var world = new TestWorld(bySweeps, restitution: .5f);
        AddStack(world, new Box(1, 1, 1));
        AssertKeepsArms(world);
    }

    [Fact]
    public void Where_constraints_are_in_the_fallback_batch()
    {
        using var world = new TestWorld(bySweeps, fallbackBatchThreshold: 1);
        AddStack(world, new Box(1, 1, 1));
        world.Step();
        Assert.True(world.Solver.ActiveSet.Batches[1].Kind == BatchKind.Fallback);
        AssertKeepsArms(world);
    }

    /// <summary>Bodies come and go beside it, and with each the constraints of others move in memory.</summary>
    [Fact]
    public void Where_constraints_move_in_memory()
    {
        using var world = new TestWorld(bySweeps);
        var other = world.AddDynamic(new Box(1, 1, 1), 1, new Vector3(5, .5f, 0));
        AddStack(world, new Box(1, 1, 1));
        AssertKeepsArms(world, beforeStep: step =>
        {
            if (step == WatchedSteps / 2)
                world.Bodies.Remove(other);
        });
    }

    static void AddStack<TShape>(TestWorld world, in TShape shape) where TShape : unmanaged, IConvexShape
    {
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        for (int i = 0; i < Count; ++i)
            world.AddDynamic(shape, 1, new Vector3(0, i + .5f, 0));
    }

    static void AssertKeepsArms(TestWorld world, Action<int>? beforeStep = null)
    {
        world.Step(SettlingSteps);
        var before = Arms(world);
        Assert.Equal(Count, before.Count(pair => pair.Value.Count == 4 && pair.Key.X < 3));
        for (int step = 0; step < WatchedSteps; ++step)
        {
            beforeStep?.Invoke(step);
            // A tremble of a hundredth of a millimetre: without it nothing would move.
            world.Bodies.ActiveSet.MotionStates[step % Count].Velocity.Linear.X += 6e-4f;
            world.Step();
        }
        var after = Arms(world);
        world.Simulation.Validate();
        Assert.All(after, pair =>
        {
            var old = before[pair.Key];
            for (int i = 0; i < pair.Value.Count; ++i)
                Assert.Equal(old.Arms[i], pair.Value.Arms[i]);
            Assert.Equal(old.OffsetB, pair.Value.OffsetB);
        });
        Assert.Contains(after, pair => pair.Value.Normals[0] != before[pair.Key].Normals[0]);
    }

    // By the place of the upper body, to the nearest half metre.
    static Dictionary<Vector3, ContactPatch> Arms(TestWorld world)
    {
        var found = new Dictionary<Vector3, ContactPatch>();
        ref var pairs = ref world.Simulation.NarrowPhase.Pairs.Pairs;
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var manifold = ref pairs.Values[i].Single;
            if (!manifold.HasConstraint)
                continue;
            var a = world.Bodies[pairs.Keys[i].A.BodyHandle].Pose.Position;
            var b = pairs.Keys[i].B.Mobility == CollidableMobility.Static ? a : world.Bodies[pairs.Keys[i].B.BodyHandle].Pose.Position;
            new ContactConstraint(world.Solver, manifold.Constraint, ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId))
                .ReadPatch(manifold.Features, out var patch);
            found.Add(new Vector3(MathF.Round(a.X), MathF.Round(a.Y + b.Y), 0), patch);
        }
        return found;
    }
}
