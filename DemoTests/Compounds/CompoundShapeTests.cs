using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>Bounds and rays of compounds against those of their children, and what becomes of the children.</summary>
public sealed class CompoundShapeTests : IDisposable
{
    readonly CompoundWorkshop workshop = new(11);

    Shapes Shapes => workshop.Shapes;

    public void Dispose() => workshop.Dispose();

    [Theory, InlineData(1, false), InlineData(7, false), InlineData(1, true), InlineData(33, true)]
    public void Bounds_are_the_union_of_those_of_the_children(int count, bool isBig)
    {
        var name = workshop.AddCompound(count, 2, isBig);
        for (int i = 0; i < 20; ++i)
        {
            var turn = workshop.NextTurn();
            var expected = BoundingBox.Empty;
            foreach (var child in workshop.ChildrenOf(name))
            {
                Shapes.UpdateBounds(CompoundWorkshop.Place(child, turn), child.ShapeIndex, out var bounds);
                expected = BoundingBox.CreateMerged(expected, bounds);
            }
            Shapes.UpdateBounds(default, turn, name, out var actual);
            Assert.InRange((expected.Min - actual.Min).Length() + (expected.Max - actual.Max).Length(), 0, 1e-6f);
            CheckReach(name, turn, actual);
        }
    }

    // The wide bounds are the same, and no turn carries the compound farther than they say.
    void CheckReach(TypedIndex name, Quaternion turn, in BoundingBox bounds)
    {
        Span<int> indices = stackalloc int[Vector<float>.Count];
        indices.Fill(-1);
        indices[^1] = name.Index;
        var turns = Lanes.Broadcast<Quaternion, QuaternionWide>(turn);
        Shapes.GetBatch(name.Type).GetBounds(indices, turns, out var radii, out var expansions, out var min, out var max);
        var lane = Vector<float>.Count - 1;
        Assert.Equal((bounds.Min, bounds.Max), (Lanes.Read<Vector3, Vector3Wide>(ref min, lane), Lanes.Read<Vector3, Vector3Wide>(ref max, lane)));
        Assert.Equal(1, Shapes.GetBatch(name.Type).MaximumRadius(name.Index) / radii[lane], 1e-6f);
        for (int i = 0; i < 30; ++i)
        {
            Shapes.UpdateBounds(default, workshop.NextTurn(), name, out var other);
            var farthest = Math.Max(Greatest(other.Max), Greatest(-other.Min));
            Assert.InRange(farthest, 0, radii[lane] * 1.000001f);
            var beyond = Math.Max(Greatest(other.Max - bounds.Max), Greatest(bounds.Min - other.Min));
            Assert.InRange(beyond, float.MinValue, expansions[lane] * 1.000001f + 1e-6f);
        }
    }

    static float Greatest(Vector3 v) => Math.Max(v.X, Math.Max(v.Y, v.Z));

    struct Hits : IShapeRayHitHandler
    {
        public List<(int Child, float T, Vector3 Normal)> All;
        public bool OnlyNearest;
        public int Forbidden;

        public readonly bool AllowTest(int childIndex) => childIndex != Forbidden;

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex)
        {
            All.Add((childIndex, t, normal));
            if (OnlyNearest)
                maximumT = t;
        }
    }

    [Theory, InlineData(6, false), InlineData(1, true), InlineData(40, true)]
    public void Rays_hit_what_children_hit(int count, bool isBig)
    {
        var name = workshop.AddCompound(count, 2, isBig);
        var children = workshop.ChildrenOf(name);
        int hitCount = 0;
        // Hardly one in a hundred hits what is made of one small child.
        var rayCount = count == 1 ? 5000 : 500;
        for (int i = 0; i < rayCount; ++i)
        {
            var pose = new RigidPose(workshop.NextVector(5), workshop.NextTurn());
            var start = workshop.NextVector(4);
            var ray = new RayData { Origin = pose.Position + start, Direction = workshop.NextVector(1) - start * .4f, Id = i };
            var forbidden = i % 3 == 0 ? i % count : -1;
            var expected = new Hits { All = [], Forbidden = -1 };
            for (int j = 0; j < count; ++j)
            {
                if (j == forbidden)
                    continue;
                var place = CompoundWorkshop.Place(children[j], pose.Orientation);
                place.Position += pose.Position;
                var one = new Hits { All = [], Forbidden = -1 };
                var whole = 8f;
                Shapes.GetBatch(children[j].ShapeIndex.Type).RayTest(children[j].ShapeIndex.Index, place, ray, ref whole, workshop.Pool, ref one);
                expected.All.AddRange(one.All.Select(hit => (j, hit.T, hit.Normal)));
            }
            var all = new Hits { All = [], Forbidden = forbidden };
            var maximumT = 8f;
            Shapes.GetBatch(name.Type).RayTest(name.Index, pose, ray, ref maximumT, workshop.Pool, ref all);
            Assert.Equal(expected.All.OrderBy(hit => hit.Child), all.All.OrderBy(hit => hit.Child));
            var nearest = new Hits { All = [], Forbidden = forbidden, OnlyNearest = true };
            Shapes.GetBatch(name.Type).RayTest(name.Index, pose, ray, ref maximumT, workshop.Pool, ref nearest);
            if (expected.All.Count > 0)
                Assert.Equal(expected.All.Min(hit => hit.T), nearest.All[^1].T);
            hitCount += all.All.Count;
        }
        Assert.InRange(hitCount, 10, int.MaxValue);
    }

    /// <summary>The least piece of a pool's memory holds several small shapes, and no big compound.</summary>
    [Fact]
    public void A_batch_that_was_made_for_no_shapes_has_room_for_large_ones()
    {
        var shapes = new Shapes(workshop.Pool, 0);
        var sphere = shapes.Add(new Sphere(1));
        var names = new List<TypedIndex>();
        for (int i = 0; i < 5; ++i)
        {
            names.Add(shapes.Add(new BigCompound(Children(sphere, sphere), shapes, workshop.Pool)));
            Assert.InRange(shapes[BigCompound.Id]!.Capacity, i + 1, int.MaxValue);
        }
        foreach (var name in names)
        {
            Assert.Equal(2, shapes.GetShape<BigCompound>(name.Index).ChildCount);
            shapes.RemoveAndDispose(name, workshop.Pool);
        }
        shapes.Dispose();
    }

    [Fact]
    public void A_child_stays_as_long_as_a_compound_has_it()
    {
        var sphere = Shapes.Add(new Sphere(1));
        var box = Shapes.Add(new Box(1, 1, 1));
        var first = workshop.Add(Children(sphere, sphere, box), isBig: false);
        var second = workshop.Add(Children(sphere, box), isBig: true);
        Assert.Throws<InvalidOperationException>(() => Shapes.Remove(sphere));
        Assert.Throws<InvalidOperationException>(() => Shapes.RemoveAndDispose(box, workshop.Pool));
        Assert.Throws<InvalidOperationException>(() => Shapes[Sphere.Id]!.Clear());
        // The other one has them too.
        Assert.Throws<InvalidOperationException>(() => Shapes.RecursivelyRemoveAndDispose(first, workshop.Pool));
        Assert.True(Shapes.Exists(first) && Shapes.Exists(sphere) && Shapes.Exists(box));
        Assert.Throws<InvalidOperationException>(() => Shapes.Remove(sphere));
        Shapes.RemoveAndDispose(second, workshop.Pool);
        Assert.Throws<InvalidOperationException>(() => Shapes.Remove(box));
        Shapes.RecursivelyRemoveAndDispose(first, workshop.Pool);
        Assert.False(Shapes.Exists(first) || Shapes.Exists(sphere) || Shapes.Exists(box));
    }

    [Fact]
    public void A_compound_in_use_stays_with_its_children()
    {
        var sphere = Shapes.Add(new Sphere(1));
        var name = workshop.Add(Children(sphere), isBig: true);
        Shapes.BeginUse(name);
        Assert.Throws<InvalidOperationException>(() => Shapes.RecursivelyRemoveAndDispose(name, workshop.Pool));
        Assert.Throws<InvalidOperationException>(() => Shapes.Clear());
        Shapes.EndUse(name);
        Assert.True(Shapes.Exists(name) && Shapes.Exists(sphere));
    }

    [Fact]
    public void All_shapes_can_be_cleared_at_once()
    {
        var children = Children(Shapes.Add(new Sphere(1)));
        workshop.Add(children, isBig: false);
        Shapes.Clear();
        workshop.Pool.Return(ref children);
        var again = Shapes.Add(new Sphere(2));
        Shapes.Remove(again);
        Assert.Equal(0, Shapes[Sphere.Id]!.Count);
    }

    Buffer<CompoundChild> Children(params TypedIndex[] names)
    {
        workshop.Pool.Take(names.Length, out Buffer<CompoundChild> children);
        for (int i = 0; i < names.Length; ++i)
            children[i] = new(new RigidPose(new Vector3(i, 0, 0)), names[i]);
        return children;
    }

    [Fact]
    public void Children_come_and_go()
    {
        var sphere = Shapes.Add(new Sphere(1));
        var box = Shapes.Add(new Box(1, 1, 1));
        var compound = new Compound(Children(sphere, box));
        compound.Add(new(new RigidPose(new Vector3(5, 0, 0)), sphere), workshop.Pool);
        Assert.Equal(3, compound.ChildCount);
        compound.RemoveAt(0, workshop.Pool);
        Assert.Equal((2, new Vector3(5, 0, 0), box), (compound.ChildCount, compound.GetChild(0).LocalPosition, compound.GetChild(1).ShapeIndex));
        compound.RemoveAt(1, workshop.Pool);
        Assert.Throws<InvalidOperationException>(() => compound.RemoveAt(0, workshop.Pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => compound.GetChild(1).LocalPosition);
        compound.Dispose(workshop.Pool);

        var big = new BigCompound(Children(sphere, box), Shapes, workshop.Pool);
        for (int i = 2; i < 9; ++i)
            big.Add(new(new RigidPose(new Vector3(i, 0, 0)), sphere), workshop.Pool, Shapes);
        big.RemoveAt(1, workshop.Pool);
        big.Tree.Validate();
        big.Validate();
        for (int i = 0; i < big.ChildCount; ++i)
        {
            Shapes.UpdateBounds(big.GetChild(i).AsPose(), big.GetChild(i).ShapeIndex, out var bounds);
            Assert.Equal((bounds.Min, bounds.Max), (big.Tree.GetBounds(i).Min, big.Tree.GetBounds(i).Max));
        }
        big.Dispose(workshop.Pool);
    }

    public enum Fault
    {
        NoChildren,
        MissingShape,
        NoShape,
        NestedTwice,
        HalfSpace,
        NaNPosition,
        FarPosition,
        LongOrientation,
    }

    [Theory]
    [InlineData(Fault.NoChildren)]
    [InlineData(Fault.MissingShape)]
    [InlineData(Fault.NoShape)]
    [InlineData(Fault.NestedTwice)]
    [InlineData(Fault.HalfSpace)]
    [InlineData(Fault.NaNPosition)]
    [InlineData(Fault.FarPosition)]
    [InlineData(Fault.LongOrientation)]
    public void What_is_no_compound_is_refused(Fault fault)
    {
        var sphere = Shapes.Add(new Sphere(1));
        var good = fault == Fault.NestedTwice ? workshop.Add(Children(workshop.Add(Children(sphere), isBig: false)), isBig: false) : default;
        var children = Children(sphere, sphere);
        ref var child = ref children[1];
        switch (fault)
        {
            case Fault.MissingShape: child.ShapeIndex = new(Box.Id, 3); break;
            case Fault.NoShape: child.ShapeIndex = default; break;
            case Fault.NestedTwice: child.ShapeIndex = good; break;
            case Fault.HalfSpace: child.ShapeIndex = Shapes.Add(new HalfSpace(Vector3.UnitY)); break;
            case Fault.NaNPosition: child.LocalPosition.Y = float.NaN; break;
            case Fault.FarPosition: child.LocalPosition.Z = 2e7f; break;
            case Fault.LongOrientation: child.LocalOrientation *= 1.1f; break;
        }
        var given = fault == Fault.NoChildren ? default : children;
        var before = workshop.Pool.GetTotalAllocatedByteCount();
        Assert.ThrowsAny<ArgumentException>(() => Shapes.Add(new Compound(given)));
        Assert.ThrowsAny<ArgumentException>(() => new BigCompound(given, Shapes, workshop.Pool));
        Assert.ThrowsAny<ArgumentException>(() => Shapes.Add(new BigCompound { Children = given }));
        Assert.Equal(before, workshop.Pool.GetTotalAllocatedByteCount());
        Assert.Equal(fault == Fault.NestedTwice ? 2 : 0, Shapes.RegisteredTypeSpan > Compound.Id ? Shapes[Compound.Id]?.Count ?? 0 : 0);
        workshop.Pool.Return(ref children);
    }
}
