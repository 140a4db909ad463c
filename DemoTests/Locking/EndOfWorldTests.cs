using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Locking;

/// <summary>A simulation after its end, and pools that are cleared too early.</summary>
public class EndOfWorldTests
{
    public static TheoryData<string> Operations => [.. LockOperations.All.Keys];

    [Theory]
    [MemberData(nameof(Operations))]
    public void Whatever_comes_after_Dispose_is_refused(string name)
    {
        var world = new LockedWorld(1, 8);
        var body = world.Simulation.Bodies[world.Body];
        var still = world.Simulation.Statics[world.SpareStatic];
        world.Step();
        world.Simulation.Dispose();
        world.Pool.AssertEmpty();
        CheckEnded(world, body, still, name);
        world.Pool.AssertEmpty();
        world.Pool.Clear();
    }

    [Theory]
    [MemberData(nameof(Operations))]
    public void Whatever_comes_after_its_pool_was_cleared_is_refused(string name)
    {
        var world = new LockedWorld(1, 8);
        var body = world.Simulation.Bodies[world.Body];
        var still = world.Simulation.Statics[world.SpareStatic];
        world.Step();
        world.Pool.Clear();
        CheckEnded(world, body, still, name);
        Assert.Equal(0ul, world.Pool.GetTotalAllocatedByteCount());
    }

    [Fact]
    public void What_a_simulation_shows_of_itself_after_its_end_is_empty_or_refused()
    {
        var world = new LockedWorld(1, 8);
        world.Step();
        world.Simulation.Dispose();
        Assert.Equal(0, world.Simulation.Bodies.CountBodies());
        Assert.Equal(0, world.Simulation.Statics.Count);
        Assert.Equal(0, world.Simulation.Solver.CountConstraints());
        Assert.Equal(0, world.Simulation.Bodies.HandleToLocation.Length);
        Assert.Equal(0, world.Simulation.BroadPhase.ActiveTree.LeafCount);
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.Bodies.ActiveSet.Count);
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.Solver.ActiveSet.CountConstraints());
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.Statics[0].Pose);
        Assert.Throws<ObjectDisposedException>(() => world.Simulation.Validate());
        Assert.False(world.Simulation.Bodies.BodyExists(world.Body));
        Assert.False(world.Simulation.Statics.StaticExists(world.Ground));
        Assert.False(world.Simulation.Solver.ConstraintExists(world.Joint));
        world.Simulation.Dispose();
        world.Pool.Clear();
    }

    [Fact]
    public void A_pool_that_was_cleared_serves_a_new_simulation()
    {
        var pool = new BufferPool();
        for (int round = 0; round < 3; ++round)
        {
            var simulation = NewSimulation(pool);
            simulation.Bodies.Add(BodyDescription.CreateKinematic(RigidPose.Identity, simulation.Shapes.Add(new Sphere(1)), -1));
            simulation.Timestep(1 / 60f);
            pool.Clear();
            // As in games that dispose in any order.
            simulation.Dispose();
            pool.AssertEmpty();
        }
    }

    [Fact]
    public void Properties_whose_pool_was_cleared_hold_nothing_and_say_so()
    {
        var pool = new BufferPool();
        using var world = new LockedWorld(1, 8);
        using var property = new CollidableProperty<int>(world.Simulation, pool);
        property[world.Body] = 7;
        property[world.Ground] = 8;
        pool.Clear();
        Assert.Throws<ArgumentOutOfRangeException>(() => property[world.Body]);
        Assert.Throws<ArgumentOutOfRangeException>(() => property[world.Ground]);
        property.Allocate(world.Body) = 9;
        Assert.Equal(9, property[world.Body]);
        property.Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void The_leaves_of_a_simulation_are_its_own()
    {
        using var world = new LockedWorld(1, 8);
        var broadPhase = world.Simulation.BroadPhase;
        var bounds = new BoundingBox(-Vector3.One, Vector3.One);
        var body = world.Simulation.Bodies[world.Body].CollidableReference;
        Assert.Throws<InvalidOperationException>(() => broadPhase.AddActive(body, ref bounds));
        Assert.Throws<InvalidOperationException>(() => broadPhase.AddStatic(body, ref bounds));
        Assert.Throws<InvalidOperationException>(() => broadPhase.RemoveActiveAt(0, out _));
        Assert.Throws<InvalidOperationException>(() => broadPhase.RemoveStaticAt(0, out _));
        Assert.Throws<InvalidOperationException>(broadPhase.Clear);
        Assert.Throws<InvalidOperationException>(broadPhase.Dispose);
        world.Step();
        world.Simulation.Validate();
    }

    [Fact]
    public void Impossible_capacities_of_a_broad_phase_change_nothing()
    {
        var pool = new BufferPool();
        using var broadPhase = new BepuPhysics.CollisionDetection.BroadPhase(pool, 16, 16);
        foreach (int bad in new[] { -1, int.MinValue, BepuPhysics.Trees.Tree.MaximumLeafCount + 1, int.MaxValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => broadPhase.EnsureCapacity(1000, bad));
            Assert.Throws<ArgumentOutOfRangeException>(() => broadPhase.EnsureCapacity(bad, 1000));
            Assert.Throws<ArgumentOutOfRangeException>(() => broadPhase.Resize(1000, bad));
            Assert.Throws<ArgumentOutOfRangeException>(() => broadPhase.Resize(bad, 1000));
        }
        Assert.Equal(16, broadPhase.ActiveTree.Leaves.Length);
        Assert.Equal(16, broadPhase.StaticTree.Leaves.Length);
    }

    [Fact]
    public void Shapes_whose_pool_was_cleared_are_refused_by_those_who_share_them()
    {
        var shapePool = new BufferPool();
        var pool = new BufferPool();
        var shapes = new Shapes(shapePool, 4);
        using (var simulation = NewSimulation(pool, shapes))
        {
            var sphere = shapes.Add(new Sphere(1));
            simulation.Bodies.Add(BodyDescription.CreateKinematic(RigidPose.Identity, sphere, -1));
            simulation.Timestep(1 / 60f);
            shapePool.Clear();
            Assert.Throws<ObjectDisposedException>(() => simulation.Timestep(1 / 60f));
            Assert.Throws<ObjectDisposedException>(() => shapes.Add(new Sphere(1)));
            Assert.False(shapes.Exists(sphere));
        }
        pool.AssertEmpty();
    }

    [Fact]
    public void A_simulation_whose_callbacks_throw_at_the_beginning_or_the_end_leaves_no_memory_behind()
    {
        var pool = new BufferPool();
        Assert.Throws<TimeZoneNotFoundException>(() => Simulation.Create(
            pool, new ThrowingContacts { InInitialize = true }, new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 2)));
        pool.AssertEmpty();
        var simulation = Simulation.Create(
            pool, new ThrowingContacts { InDispose = true }, new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 2));
        Assert.Throws<TimeZoneNotFoundException>(simulation.Dispose);
        simulation.Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void In_builds_with_checks_a_pool_says_what_was_not_returned()
    {
        var reports = new List<string>();
        BufferPool.LeakFound += reports.Add;
        try
        {
            var pool = new BufferPool();
            pool.Take<int>(1000, out var numbers);
            pool.Take<Vector3>(10, out var vectors);
            pool.Return(ref numbers);
            pool.Take<double>(3, out _);
            pool.Clear();
            reports.RemoveAll(report => !report.Contains("Vector3", StringComparison.Ordinal) || !report.Contains("Double", StringComparison.Ordinal));
            Assert.Equal(Check.IsEnabled ? 1 : 0, reports.Count);
            Assert.DoesNotContain(reports, report => report.Contains("Int32", StringComparison.Ordinal));
        }
        finally
        {
            BufferPool.LeakFound -= reports.Add;
        }
    }

    static void CheckEnded(LockedWorld world, BodyReference body, StaticReference still, string name)
    {
        var exception = Record.Exception(() => LockOperations.All[name].Do(world));
        // A second Dispose, and clearing the pool, are no calls to the simulation.
        if (name is "Simulation.Dispose" or "BufferPool.Clear")
            Assert.Null(exception);
        else
            Assert.True(exception is ObjectDisposedException, $"{name}: {exception?.ToString() ?? "worked"}");
        Assert.False(body.Exists);
        Assert.False(still.Exists);
        Assert.Throws<ObjectDisposedException>(() => body.Pose);
        Assert.Throws<ObjectDisposedException>(() => body.BoundingBox);
        Assert.Throws<ObjectDisposedException>(() => still.Pose);
        Assert.Throws<ObjectDisposedException>(() => still.BoundingBox);
    }

    static Simulation NewSimulation(BufferPool pool, Shapes? shapes = null) =>
        Simulation.Create(pool, new ThrowingContacts(), new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 2), shapes: shapes);
}
