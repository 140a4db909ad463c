using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Collidables;

public sealed class ShapesTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly Shapes shapes;

    public ShapesTests() => shapes = new(pool, 4);

    public void Dispose()
    {
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    [Fact]
    public void AddedShapesAreFoundByNameAndIndex()
    {
        var sphere = shapes.Add(new Sphere(2));
        var box = shapes.Add(new Box(1, 2, 3));
        Assert.Equal((Sphere.Id, 0), (sphere.Type, sphere.Index));
        Assert.Equal((Box.Id, 0), (box.Type, box.Index));
        Assert.Equal(3, shapes.RegisteredTypeSpan);
        Assert.Null(shapes[Capsule.Id]);
        Assert.Equal(1.5f, shapes.GetShape<Box>(box.Index).HalfLength);
        shapes.GetShape<Sphere>(sphere.Index).Radius = 5;
        shapes.UpdateBounds(new(1, 0, 0), Quaternion.Identity, sphere, out var bounds);
        Assert.Equal(new(6, 5, 5), bounds.Max);
        shapes.UpdateBounds(new Vector3(0, 1, 0), box, out bounds);
        Assert.Equal(new(-0.5f, 0, -1.5f), bounds.Min);
    }

    [Fact]
    public void RemovedSlotsAreReusedAndStaleNamesRefused()
    {
        var first = shapes.Add(new Sphere(1));
        var second = shapes.Add(new Sphere(2));
        shapes.Remove(first);
        Assert.False(shapes.Exists(first));
        Assert.True(shapes.Exists(second));
        Assert.Throws<ArgumentException>(() => shapes.Remove(first));
        Assert.Throws<ArgumentException>(() => shapes.UpdateBounds(RigidPose.Identity, first, out _));
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.GetShape<Sphere>(first.Index).Radius);
        Assert.Equal(1, shapes[Sphere.Id]!.Count);
        Assert.Equal(first, shapes.Add(new Sphere(3)));
        Assert.Equal(3, shapes.GetShape<Sphere>(first.Index).Radius);
        Assert.Equal(2, shapes.GetShape<Sphere>(second.Index).Radius);
    }

    [Fact]
    public void NamesOfNothingAreRefused()
    {
        shapes.Add(new Sphere(1));
        var last = TypedIndex.MaximumIndexCount - 1;
        foreach (var name in (ReadOnlySpan<TypedIndex>)[new(Sphere.Id, 1), new(Sphere.Id, last), new(Box.Id, 0), new(127, 0)])
        {
            Assert.False(shapes.Exists(name));
            Assert.Throws<ArgumentException>(() => shapes.Remove(name));
            Assert.Throws<ArgumentException>(() => shapes.RemoveAndDispose(name, pool));
            Assert.Throws<ArgumentException>(() => shapes.RecursivelyRemoveAndDispose(name, pool));
            Assert.Equal("shape", Assert.Throws<ArgumentException>(() => shapes.CheckExists(name, "shape")).ParamName);
        }
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes[-1]);
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes[1]);
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.GetShape<Sphere>(-1).Radius);
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.GetShape<Sphere>(1).Radius);
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.GetShape<Box>(0).HalfWidth);
        Assert.Equal(1, shapes[Sphere.Id]!.Count);
    }

    /// <summary>Bodies that have no shape have the default, and a game that removes the shapes of what it removes need not ask.</summary>
    [Fact]
    public void The_default_name_is_of_no_shape_and_removing_it_does_nothing()
    {
        shapes.Add(new Sphere(1));
        shapes.Remove(default);
        shapes.RemoveAndDispose(default, pool);
        shapes.RecursivelyRemoveAndDispose(default, pool);
        Assert.False(shapes.Exists(default));
        Assert.Throws<ArgumentException>(() => shapes.UpdateBounds(RigidPose.Identity, default, out _));
        Assert.Throws<ArgumentException>(() => shapes.CheckExists(default, "shape"));
        Assert.Equal(1, shapes[Sphere.Id]!.Count);
    }

    public static TheoryData<float> BadSizes => [0, -1, 1e-7f, 1e8f, float.NaN, float.PositiveInfinity, float.NegativeInfinity];

    [Theory]
    [MemberData(nameof(BadSizes))]
    public void BadSizesAreRefusedByFieldAndValue(float size)
    {
        Refuses(new Sphere(size), nameof(Sphere.Radius), size);
        Refuses(new Capsule { Radius = size, HalfLength = 1 }, nameof(Capsule.Radius), size);
        if (size is not 0 and not 1e-7f)
            Refuses(new Capsule { Radius = 1, HalfLength = size }, nameof(Capsule.HalfLength), size);
        Refuses(new Box { HalfWidth = size, HalfHeight = 1, HalfLength = 1 }, nameof(Box.HalfWidth), size);
        Refuses(new Box { HalfWidth = 1, HalfHeight = size, HalfLength = 1 }, nameof(Box.HalfHeight), size);
        Refuses(new Box { HalfWidth = 1, HalfHeight = 1, HalfLength = size }, nameof(Box.HalfLength), size);
        Assert.Equal(0, shapes.RegisteredTypeSpan);

        void Refuses<TShape>(TShape shape, string field, float value) where TShape : unmanaged, IShape
        {
            var exception = Assert.Throws<ArgumentOutOfRangeException>(() => shapes.Add(shape));
            Assert.Equal(field, exception.ParamName);
            Assert.Equal(value, exception.ActualValue);
        }
    }

    [Fact]
    public void ACapsuleMayHaveNoLength() => Assert.True(shapes.Exists(shapes.Add(new Capsule(1, 0))));

    [Fact]
    public void ScrambledAddsAndRemovesKeepEveryShape()
    {
        var expected = new Dictionary<TypedIndex, float>();
        var names = new List<TypedIndex>();
        uint state = 12345;
        for (int i = 0; i < 3000; ++i)
        {
            state = state * 1664525 + 1013904223;
            var choice = (int)(state >> 8);
            if (names.Count == 0 || choice % 5 < 3 && i < 2000)
            {
                var name = choice % 2 == 0 ? shapes.Add(new Sphere(1 + i)) : shapes.Add(new Capsule(1 + i, 2));
                Assert.True(expected.TryAdd(name, 1 + i));
                names.Add(name);
            }
            else
            {
                var victim = choice % names.Count;
                shapes.Remove(names[victim]);
                expected.Remove(names[victim]);
                names.RemoveAt(victim);
            }
            if (i % 500 == 250)
                shapes.ResizeBatches(0);
            if (i % 500 == 400)
                shapes.EnsureBatchCapacities(300);
        }
        foreach (var (name, size) in expected)
        {
            var isSphere = name.Type == Sphere.Id;
            Assert.Equal(size, isSphere ? shapes.GetShape<Sphere>(name.Index).Radius : shapes.GetShape<Capsule>(name.Index).Radius);
        }
        Assert.Equal(expected.Count, shapes[Sphere.Id]!.Count + shapes[Capsule.Id]!.Count);
        for (int type = 0; type < 2; ++type)
            for (int i = 0; i < shapes[type]!.Capacity; ++i)
                Assert.Equal(expected.ContainsKey(new(type, i)), shapes.Exists(new(type, i)));
    }

    [Fact]
    public void AShapeOfTheBatchCanBeAddedAgain()
    {
        shapes.Add(new Sphere(7));
        // By reference to a slot that moves when the batch grows.
        for (int i = 0; i < 100; ++i)
            shapes.Add(shapes.GetShape<Sphere>(0));
        Assert.Equal(7, shapes.GetShape<Sphere>(100).Radius);
    }

    [Fact]
    public void CapacityGrowsShrinksAndClears()
    {
        for (int i = 0; i < 100; ++i)
            shapes.Add(new Sphere(1 + i));
        shapes.EnsureBatchCapacities(1000);
        Assert.True(shapes[Sphere.Id]!.Capacity >= 1000);
        shapes.ResizeBatches(0);
        Assert.InRange(shapes[Sphere.Id]!.Capacity, 100, 999);
        Assert.Equal(100, shapes.GetShape<Sphere>(99).Radius);
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.EnsureBatchCapacities(-1));
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.ResizeBatches(TypedIndex.MaximumIndexCount + 1));
        shapes.Clear();
        Assert.Equal(0, shapes[Sphere.Id]!.Count);
        Assert.False(shapes.Exists(new(Sphere.Id, 0)));
        Assert.Equal(0, shapes.Add(new Sphere(1)).Index);
        Assert.False(shapes.Exists(new(Sphere.Id, 1)));
    }

    [Fact]
    public void DisposedCollectionsCanBeFilledAgain()
    {
        var old = shapes.Add(new Sphere(1));
        shapes.Dispose();
        pool.AssertEmpty();
        Assert.False(shapes.Exists(old));
        Assert.Equal(0, shapes.Add(new Sphere(2)).Index);
    }

    [Fact]
    public void TwoTypesCannotShareAnId()
    {
        shapes.Add(new Sphere(1));
        Assert.Throws<InvalidOperationException>(() => shapes.Add(new Impostor()));
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes.GetShape<Impostor>(0));
        Assert.True(shapes.Exists(new(Sphere.Id, 0)));
    }

    [Fact]
    public unsafe void RawDataIsTheShape()
    {
        var name = shapes.Add(new Capsule(3, 4));
        shapes[Capsule.Id]!.GetShapeData(name.Index, out var data, out var size);
        Assert.Equal(sizeof(Capsule), size);
        Assert.Equal(new Capsule(3, 4), *(Capsule*)data);
        Assert.Throws<ArgumentOutOfRangeException>(() => shapes[Capsule.Id]!.GetShapeData(1, out _, out _));
    }

    [Fact]
    public void BatchedBoundsAreThoseOfEachShape()
    {
        var indices = new int[Vector<float>.Count - 1];
        QuaternionWide orientations = default;
        for (int i = 0; i < indices.Length; ++i)
        {
            indices[indices.Length - 1 - i] = shapes.Add(new Box(1 + i, 2, 0.5f)).Index;
            Lanes.Write(Quaternion.CreateFromAxisAngle(Vector3.UnitX, i), ref orientations, i);
        }
        var batch = shapes[Box.Id]!;
        batch.GetBounds(indices, orientations, out var radius, out _, out var min, out var max);
        for (int i = 0; i < indices.Length; ++i)
        {
            batch.ComputeBounds(indices[i], Quaternion.CreateFromAxisAngle(Vector3.UnitX, i), out var expectedMin, out var expectedMax);
            Assert.Equal(expectedMin, Lanes.Read<Vector3, Vector3Wide>(ref min, i));
            Assert.Equal(expectedMax, Lanes.Read<Vector3, Vector3Wide>(ref max, i));
            Assert.Equal(batch.MaximumRadius(indices[i]), radius[i]);
        }
        Assert.Equal(new Box(1, 2, 0.5f).ComputeInertia(2), ((IConvexShapeBatch)batch).ComputeInertia(indices[^1], 2));
    }

    [Fact]
    public void RaysReportHitsNoFartherThanTheMaximum()
    {
        var name = shapes.Add(new Sphere(1));
        var ray = new RayData { Origin = new(0, 5, 0), Direction = new(0, -1, 0), Id = 9 };
        var handler = new HitRecorder();
        var maximumT = 3.9f;
        shapes[Sphere.Id]!.RayTest(name.Index, RigidPose.Identity, ray, ref maximumT, pool, ref handler);
        Assert.Equal(0, handler.Count);
        maximumT = 4.1f;
        shapes[Sphere.Id]!.RayTest(name.Index, RigidPose.Identity, ray, ref maximumT, pool, ref handler);
        Assert.Equal((1, 9, 0), (handler.Count, handler.RayId, handler.ChildIndex));
        Assert.Equal(4, maximumT, 1e-5f);
        Assert.Equal(Vector3.UnitY, handler.Normal);
    }

    [Fact]
    public void AWarmCollectionTakesNoMemory()
    {
        for (int i = 0; i < 50; ++i)
            shapes.Add(new Box(1, 1, 1));
        for (int i = 0; i < 50; ++i)
            shapes.Remove(new(Box.Id, i));
        var managed = GC.GetAllocatedBytesForCurrentThread();
        var unmanaged = pool.GetTotalAllocatedByteCount();
        for (int i = 0; i < 50; ++i)
            shapes.Add(new Box(1, 1, 1));
        for (int i = 0; i < 50; ++i)
            shapes.UpdateBounds(RigidPose.Identity, new(Box.Id, i), out _);
        for (int i = 0; i < 50; ++i)
            shapes.Remove(new(Box.Id, i));
        Assert.Equal(managed, GC.GetAllocatedBytesForCurrentThread());
        Assert.Equal(unmanaged, pool.GetTotalAllocatedByteCount());
    }

    struct HitRecorder : IShapeRayHitHandler
    {
        public int Count;
        public int RayId;
        public int ChildIndex;
        public Vector3 Normal;

        public readonly bool AllowTest(int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex)
        {
            ++Count;
            RayId = ray.Id;
            ChildIndex = childIndex;
            Normal = normal;
            maximumT = t;
        }
    }

    struct Impostor : IShape
    {
        public static int TypeId => Sphere.Id;

        public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) => throw new NotSupportedException();

        public readonly void Validate() { }
    }
}
