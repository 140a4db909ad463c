using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using DemoTests.Quality;
using DemoTests.Queries;
using DemoTests.Support;
using Xunit;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>Mistakes with shapes of a game's own are refused by an exception that says what to do.</summary>
public sealed class OwnShapeErrorTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly Simulation simulation;

    public OwnShapeErrorTests() => simulation = EmptySimulation.Create(pool);

    public void Dispose()
    {
        simulation.Dispose();
        pool.Clear();
    }

    CollisionTaskRegistry Registry => simulation.NarrowPhase.CollisionTaskRegistry;

    interface INumber
    {
        static abstract int Value { get; }
    }

    readonly struct Seven : INumber
    {
        public static int Value => 7;
    }

    readonly struct TooMany : INumber
    {
        public static int Value => 128;
    }

    readonly struct Negative : INumber
    {
        public static int Value => -1;
    }

    readonly struct ThatOfVoxels : INumber
    {
        public static int Value => Voxels.TypeId;
    }

    readonly struct Free : INumber
    {
        public static int Value => 90;
    }

    // One child, whatever it is, and mistakes that are asked for.
    struct Lone<TChild, TChildWide, TNumber> : IHomogeneousCompoundShape<TChild, TChildWide>
        where TChild : unmanaged, IConvexShape where TChildWide : unmanaged, IShapeWide<TChild> where TNumber : INumber
    {
        public TChild Child;
        public int TellsOf;
        public bool Takes;

        public static int TypeId => TNumber.Value;

        public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
            new HomogeneousCompoundShapeBatch<Lone<TChild, TChildWide, TNumber>, TChild, TChildWide>(pool, initialCapacity);

        public readonly int ChildCount => 1;

        public readonly void Validate() { }

        public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) => Child.ComputeBounds(orientation, out min, out max);

        public readonly void GetPosedLocalChild(int childIndex, out TChild childShape, out RigidPose childPose)
        {
            childShape = Child;
            childPose = RigidPose.Identity;
        }

        public readonly void FindLocalOverlaps(Vector3 min, Vector3 max, ref QuickList<int> overlaps, BufferPool pool)
        {
            overlaps.Add(TellsOf, pool);
            if (Takes)
                overlaps.Count = -1;
        }

        public readonly void RayTest<TRayHitHandler>(
            in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
            where TRayHitHandler : struct, IShapeRayHitHandler =>
            HomogeneousCompound.RayTest<Lone<TChild, TChildWide, TNumber>, TChild, TChildWide, TRayHitHandler>(
                this, pose, ray, ref maximumT, pool, ref hitHandler);

        public readonly void Dispose(BufferPool pool) { }
    }

    // Larger than what there is room for.
    [StructLayout(LayoutKind.Sequential, Size = 132)]
    struct Large : IConvexShape
    {
        public static int TypeId => 91;

        public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) => throw new NotSupportedException();

        public readonly void Validate() { }

        public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) => throw new NotSupportedException();

        public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion) => throw new NotSupportedException();

        public readonly BodyInertia ComputeInertia(float mass) => throw new NotSupportedException();

        public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
            throw new NotSupportedException();
    }

    struct LargeWide : IShapeWide<Large>
    {
        public readonly void GetBounds(in BepuUtilities.QuaternionWide orientation, out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion,
            out BepuUtilities.Vector3Wide min, out BepuUtilities.Vector3Wide max) => throw new NotSupportedException();

        public readonly void RayTest(
            in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out BepuUtilities.Vector3Wide normal) =>
            throw new NotSupportedException();
    }

    static string Refused<TException>(Action action) where TException : Exception => Assert.Throws<TException>(action).Message;

    [Fact]
    public void A_type_that_is_not_registered_is_named_when_it_is_met()
    {
        var voxels = new Voxels(1, 1, 1, 1, default, pool);
        voxels.Cells[0] = true;
        simulation.Statics.Add(new StaticDescription(RigidPose.Identity, simulation.Shapes.Add(voxels)));
        var ball = new Sphere(.5f);
        simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(.5f, 1.4f, .5f), ball.ComputeInertia(1), simulation.Shapes.Add(ball), -1f));
        var message = Refused<InvalidOperationException>(() => simulation.Timestep(1 / 60f));
        Assert.Contains("Sphere", message, StringComparison.Ordinal);
        Assert.Contains("shape type 20", message, StringComparison.Ordinal);
        Assert.Contains(nameof(CollisionTaskRegistry.RegisterHomogeneousCompound), message, StringComparison.Ordinal);
        simulation.Statics.Clear();
        voxels.Dispose(pool);
    }

    [Fact]
    public void Ids_are_those_that_no_other_type_has()
    {
        var library = Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<Box, BoxWide, Seven>, Box, BoxWide>);
        Assert.Contains("from 11 to 127", library, StringComparison.Ordinal);
        Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<Box, BoxWide, TooMany>, Box, BoxWide>);
        Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<Box, BoxWide, Negative>, Box, BoxWide>);
        Refused<InvalidOperationException>(() => simulation.Shapes.Add(new Lone<Box, BoxWide, Seven> { Child = new(1, 1, 1) }));
        var taskCount = Registry.TaskCount;
        Registry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>();
        var more = Registry.TaskCount;
        Assert.Equal(taskCount + 12, more);
        // Once more changes nothing.
        Registry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>();
        Assert.Equal(more, Registry.TaskCount);
        var taken = Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<Box, BoxWide, ThatOfVoxels>, Box, BoxWide>);
        Assert.Contains(nameof(Voxels), taken, StringComparison.Ordinal);
        Assert.Equal(more, Registry.TaskCount);
    }

    [Fact]
    public void Children_are_of_a_size_that_there_is_room_for_and_have_an_end()
    {
        Assert.Contains("128", Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<Large, LargeWide, Free>, Large, LargeWide>),
            StringComparison.Ordinal);
        Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<HalfSpace, HalfSpaceWide, Free>, HalfSpace, HalfSpaceWide>);
    }

    // A ball by another name, of the id of cones.
    struct Impostor : IConvexShape
    {
        public Sphere Ball;

        public static int TypeId => Cone.TypeId;

        public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
            new ConvexShapeBatch<Impostor, ImpostorWide>(pool, initialCapacity);

        public readonly void Validate() => Ball.Validate();

        public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) => Ball.ComputeBounds(orientation, out min, out max);

        public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion) =>
            Ball.ComputeAngularExpansionData(out maximumRadius, out maximumAngularExpansion);

        public readonly BodyInertia ComputeInertia(float mass) => Ball.ComputeInertia(mass);

        public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
            Ball.RayTest(pose, origin, direction, out t, out normal);
    }

    struct ImpostorWide(SphereWide balls) : IShapeWide<Impostor>
    {
        public SphereWide Balls = balls;

        public readonly void GetBounds(in BepuUtilities.QuaternionWide orientation, out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion,
            out BepuUtilities.Vector3Wide min, out BepuUtilities.Vector3Wide max) =>
            Balls.GetBounds(orientation, out maximumRadius, out maximumAngularExpansion, out min, out max);

        public readonly void RayTest(
            in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out BepuUtilities.Vector3Wide normal) =>
            Balls.RayTest(pose, ray, out hitMask, out t, out normal);
    }

    /// <summary>One would be read as the other.</summary>
    [Fact]
    public void Shapes_of_another_type_than_was_registered_by_their_id_are_refused()
    {
        Registry.RegisterConvex<Cone, ConeWide, ConeSupport, ConeFeature>();
        Refused<InvalidOperationException>(Registry.RegisterHomogeneousCompound<Lone<Impostor, ImpostorWide, Free>, Impostor, ImpostorWide>);
        var impostor = new Impostor { Ball = new(.5f) };
        simulation.Bodies.Add(BodyDescription.CreateDynamic(default(Vector3), impostor.ComputeInertia(1), simulation.Shapes.Add(impostor), -1f));
        var message = Refused<InvalidOperationException>(() => simulation.Timestep(1 / 60f));
        Assert.Contains(nameof(Cone), message, StringComparison.Ordinal);
        Assert.Contains(nameof(Impostor), message, StringComparison.Ordinal);
    }

    [Theory, InlineData(1, false), InlineData(-1, false), InlineData(0, true)]
    public void Children_that_there_are_not_are_refused(int child, bool takes)
    {
        Registry.RegisterHomogeneousCompound<Lone<Box, BoxWide, Free>, Box, BoxWide>();
        var shape = new Lone<Box, BoxWide, Free> { Child = new(1, 1, 1), TellsOf = child, Takes = takes };
        simulation.Statics.Add(new StaticDescription(RigidPose.Identity, simulation.Shapes.Add(shape)));
        var ball = new Sphere(.5f);
        simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0, .9f, 0), ball.ComputeInertia(1), simulation.Shapes.Add(ball), -1f));
        Assert.Contains("FindLocalOverlaps", Refused<InvalidOperationException>(() => simulation.Timestep(1 / 60f)), StringComparison.Ordinal);
    }

    [Fact]
    public void They_are_no_children_of_compounds_but_convex_ones_are()
    {
        var voxels = simulation.Shapes.Add(new Lone<Box, BoxWide, Free> { Child = new(1, 1, 1) });
        pool.Take(1, out Buffer<CompoundChild> children);
        children[0] = new(RigidPose.Identity, voxels);
        Assert.Contains("add its children instead", Refused<ArgumentException>(() => simulation.Shapes.Add(new Compound(children))), StringComparison.Ordinal);
        children[0] = new(RigidPose.Identity, simulation.Shapes.Add(new Cone(1, 1)));
        simulation.Shapes.RemoveAndDispose(simulation.Shapes.Add(new Compound(children)), pool);
    }

    /// <summary>Cones that are children only: none was ever added.</summary>
    [Fact]
    public void Children_of_a_type_of_the_games_own_are_met_by_sweeps()
    {
        simulation.Statics.Add(new StaticDescription(RigidPose.Identity, simulation.Shapes.Add(new Lone<Cone, ConeWide, Free> { Child = new(1, 2) })));
        List<SweptHit> found = [];
        var hits = new SweepHits(found);
        simulation.Sweep(new Sphere(.5f), new RigidPose(new Vector3(0, 5, 0)), new BodyVelocity(-Vector3.UnitY), 10, pool, ref hits);
        // Its tip is 1.5 m above its centre.
        Assert.Equal(3, Assert.Single(found).T, 1e-4f);
    }

    [Fact]
    public void What_is_swept_was_added_before()
    {
        var hits = new SweepHits([]);
        void Sweep() => simulation.Sweep(new Cone(1, 1), RigidPose.Identity, new BodyVelocity(Vector3.UnitX), 1, pool, ref hits);
        Assert.Contains("SupportShapeBatch", Refused<ArgumentException>(Sweep), StringComparison.Ordinal);
        simulation.Shapes.Add(new Cone(1, 1));
        Sweep();
    }
}
