using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using DemoTests.Queries;
using Xunit;

namespace DemoTests.OwnShapes;

/// <summary>What a shape of a game's own answers may be in any order and of any number; what is wrong is refused, and the world goes on.</summary>
public class OddVoxelTests
{
    static (VoxelWorld World, TypedIndex Land) Create(Oddity oddity, int threads = 1)
    {
        var world = new VoxelWorld(threads: threads);
        world.Simulation.NarrowPhase.CollisionTaskRegistry.RegisterHomogeneousCompound<OddVoxels, Box, BoxWide>();
        var land = world.Create(16, 6, 16, 1, new Vector3(-8, -4, -8), (x, y, z) => y < 2 + (x / 4 + z / 4) % 3);
        var name = world.Own(world.Shapes.Add(new OddVoxels(land) { Oddity = oddity }));
        var place = new RigidPose(new Vector3(.3f, -.2f, .1f), Quaternion.CreateFromYawPitchRoll(.4f, .05f, -.1f));
        world.Simulation.Statics.Add(new StaticDescription(place, name));
        var sample = MeshSample.Box(new(.3f, .25f, .4f));
        var mesh = world.Own(world.Shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, world.Pool)));
        world.Pool.Take(2, out Buffer<CompoundChild> pair);
        pair[0] = new(new RigidPose(new Vector3(-.3f, 0, 0)), world.Shapes.Add(new Sphere(.25f)));
        pair[1] = new(new RigidPose(new Vector3(.3f, 0, 0)), world.Shapes.Add(new Box(.4f, .5f, .6f)));
        var compound = world.Own(world.Shapes.Add(new Compound(pair)));
        var inertia = new Box(.8f, .6f, .6f).ComputeInertia(1);
        for (int i = 0; i < 35; ++i)
        {
            var pose = new RigidPose(new Vector3(i % 4 * 1.3f - 2, 1 + i * .35f, i / 4 % 4 * 1.2f - 2), Quaternion.CreateFromYawPitchRoll(i, .3f * i, .1f));
            switch (i % 7)
            {
                case 0: world.AddBody(new Sphere(.4f), pose); break;
                case 1: world.AddBody(new Capsule(.25f, .5f), pose); break;
                case 2: world.AddBody(new Box(.7f, .5f, .6f), pose); break;
                case 3: world.AddBody(new Cylinder(.3f, .5f), pose); break;
                case 4: world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, mesh, -1f)); break;
                case 5: world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, compound, -1f)); break;
                case 6:
                    var cubes = world.Create(3, 2, 2, .3f, new Vector3(-.45f, -.3f, -.3f), (x, y, z) => x + y + z != 4);
                    var body = world.Own(world.Shapes.Add(new OddVoxels(cubes) { Oddity = oddity }));
                    world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, body, -1f));
                    break;
            }
        }
        return (world, name);
    }

    [Theory, InlineData(Oddity.Backward), InlineData(Oddity.Shuffled), InlineData(Oddity.Twice)]
    internal void The_order_of_children_changes_nothing(Oddity oddity)
    {
        using var expected = Create(Oddity.None).World;
        using var actual = Create(oddity, 2).World;
        for (int i = 0; i < 120; ++i)
        {
            expected.Step();
            actual.Step(validate: i % 20 == 0);
            Assert.True(expected.State().SequenceEqual(actual.State()), $"step {i}");
        }
    }

    [Theory]
    [InlineData(Oddity.NaNBounds, 1), InlineData(Oddity.InfiniteBounds, 1), InlineData(Oddity.TurnedBounds, 2), InlineData(Oddity.ThrowsInBounds, 2)]
    [InlineData(Oddity.ThrowsInOverlaps, 1), InlineData(Oddity.ThrowsInChild, 2)]
    internal void What_goes_wrong_reaches_the_caller_and_the_world_goes_on(Oddity oddity, int threads)
    {
        var isOfBounds = oddity is not (Oddity.ThrowsInOverlaps or Oddity.ThrowsInChild);
        var (world, land) = Create(Oddity.None, threads);
        for (int i = 0; i < 40; ++i)
            world.Step();
        foreach (var areBodies in new[] { false, true })
        {
            SetAll(world, areBodies, oddity);
            // The land is measured when it is added, not in a step.
            if (areBodies || !isOfBounds)
                AssertRefused(oddity, () => world.Step());
            if (!areBodies && isOfBounds)
            {
                var statics = world.Simulation.Statics.Count;
                AssertRefused(oddity, () => world.Simulation.Statics.Add(new StaticDescription(new Vector3(100, 0, 0), land)));
                Assert.Equal(statics, world.Simulation.Statics.Count);
                var bodies = world.Simulation.Bodies.ActiveSet.Count;
                var inertia = new Sphere(1).ComputeInertia(1);
                AssertRefused(oddity, () => world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(200, 0, 0), inertia, land, -1f)));
                Assert.Equal(bodies, world.Simulation.Bodies.ActiveSet.Count);
            }
            SetAll(world, areBodies, Oddity.None);
            for (int i = 0; i < 5; ++i)
                world.Step(validate: true);
        }
        world.Simulation.Dispose();
        world.Pool.Clear();
    }

    /// <summary>The pool has all of its memory back.</summary>
    [Theory, InlineData(Oddity.ThrowsInBounds), InlineData(Oddity.ThrowsInOverlaps), InlineData(Oddity.ThrowsInChild)]
    internal void Queries_that_fail_take_no_memory(Oddity oddity)
    {
        using var world = Create(Oddity.None).World;
        SetAll(world, false, oddity);
        AssertRefused(oddity, () => world.Simulation.RayCast(new Vector3(0, 50, 0), -Vector3.UnitY, 1000, world.Pool, out _));
        var hits = new SweepHits([]);
        AssertRefused(oddity, () => world.Simulation.Sweep(
            new Box(1, 1, 1), new RigidPose(new Vector3(0, 50, 0)), new BodyVelocity(-Vector3.UnitY), 1000, world.Pool, ref hits));
        SetAll(world, false, Oddity.None);
    }

    [Fact]
    public void Less_than_no_children_are_none()
    {
        using var world = Create(Oddity.NegativeCount).World;
        for (int i = 0; i < 10; ++i)
            world.Step(validate: true);
        Assert.False(world.Simulation.RayCast(new Vector3(-6, 1, -6), -Vector3.UnitY, 1000, world.Pool, out _));
    }

    /// <summary>However long the way is on which nothing is met, children are asked for only as long as it is in the box around all of them.</summary>
    [Fact]
    public void A_ray_that_has_left_the_shape_asks_for_no_more()
    {
        using var world = new VoxelWorld();
        world.Simulation.NarrowPhase.CollisionTaskRegistry.RegisterHomogeneousCompound<OddVoxels, Box, BoxWide>();
        var voxels = world.Create(16, 16, 16, 1, new Vector3(-8), (x, y, z) => x + y + z == 0);
        world.Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, world.Own(world.Shapes.Add(new OddVoxels(voxels)))));
        int Searches(float maximumT)
        {
            OddVoxels.SearchCount = 0;
            Assert.False(world.Simulation.RayCast(new Vector3(-50, .5f, .5f), Vector3.UnitX, maximumT, world.Pool, out _));
            return OddVoxels.SearchCount;
        }
        var searches = Searches(100);
        Assert.InRange(searches, 1, 32);
        Assert.Equal(searches, Searches(float.MaxValue));
    }

    /// <summary>Types may be registered after steps, for shapes that are added from then on.</summary>
    [Fact]
    public void Types_may_be_registered_between_steps()
    {
        using var world = new VoxelWorld();
        world.AddStatic(world.Create(16, 1, 16, 1, new Vector3(-8, -1, -8), (_, _, _) => true), RigidPose.Identity);
        world.AddBody(new Sphere(.5f), new RigidPose(new Vector3(0, .5f, 0)));
        for (int i = 0; i < 5; ++i)
            world.Step();
        var registry = world.Simulation.NarrowPhase.CollisionTaskRegistry;
        registry.RegisterHomogeneousCompound<OddVoxels, Box, BoxWide>();
        registry.RegisterConvex<Ellipsoid, EllipsoidWide, EllipsoidSupport, PointFeature<EllipsoidWide, EllipsoidSupport>>();
        var land = world.Create(16, 1, 16, 1, new Vector3(-8, -1, -8), (_, _, _) => true);
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(20, 0, 0), world.Own(world.Shapes.Add(new OddVoxels(land)))));
        var ball = world.AddBody(new Ellipsoid(.5f, .5f, .5f), new RigidPose(new Vector3(20, .5f, 0)));
        for (int i = 0; i < 60; ++i)
            world.Step(validate: i % 20 == 0);
        Assert.Equal(.5f, world.Simulation.Bodies[ball].Pose.Position.Y, 1e-3f);
    }

    // Land, or the bodies made of cubes.
    static void SetAll(VoxelWorld world, bool areBodies, Oddity oddity)
    {
        for (int i = areBodies ? 1 : 0; i < (areBodies ? 6 : 1); ++i)
            world.Shapes.GetShape<OddVoxels>(i).Oddity = oddity;
    }

    static void AssertRefused(Oddity oddity, Action action)
    {
        var exception = Record.Exception(action);
        if (exception is AggregateException { InnerException: { } inner })
            exception = inner;
        if (oddity is Oddity.NaNBounds or Oddity.InfiniteBounds or Oddity.TurnedBounds)
            Assert.Contains(nameof(OddVoxels), Assert.IsType<InvalidOperationException>(exception).Message, StringComparison.Ordinal);
        else
            Assert.IsType<TimeZoneNotFoundException>(exception);
    }
}
