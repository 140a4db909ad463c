using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace DemoTests.CollisionDetection.Children;

/// <summary>A convex shape in a cluster.</summary>
readonly record struct ClusterChild(TypedIndex Shape, RigidPose Pose);

/// <summary>A made-up shape of children, which its tests own.</summary>
struct Cluster : IShape
{
    public Buffer<ClusterChild> Children;

    public const int Id = 100;

    public static int TypeId => Id;

    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) => new ClusterBatch(pool, initialCapacity, shapes);

    public readonly void Validate() { }
}

sealed class ClusterBatch(BufferPool pool, int initialCapacity, Shapes all) : ShapeBatch<Cluster>(pool, initialCapacity)
{
    public override bool Compound => true;

    public override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        min = new(float.MaxValue);
        max = new(float.MinValue);
        ref var cluster = ref this[shapeIndex];
        for (int i = 0; i < cluster.Children.Length; ++i)
        {
            ref var child = ref cluster.Children[i];
            all.UpdateBounds(ClusterPose.Place(child.Pose, orientation), child.Shape, out var bounds);
            min = Vector3.Min(min, bounds.Min);
            max = Vector3.Max(max, bounds.Max);
        }
    }

    public override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
    { }

    internal override float MaximumRadius(int shapeIndex)
    {
        var radius = 0f;
        ref var cluster = ref this[shapeIndex];
        for (int i = 0; i < cluster.Children.Length; ++i)
        {
            ref var child = ref cluster.Children[i];
            radius = Math.Max(radius, child.Pose.Position.Length() + all.GetBatch(child.Shape.Type).MaximumRadius(child.Shape.Index));
        }
        return radius;
    }

    internal override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations, out Vector<float> maximumRadius,
        out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = maximumAngularExpansion = default;
        min = max = default;
        for (int lane = 0; lane < shapeIndices.Length; ++lane)
        {
            if (shapeIndices[lane] < 0)
                continue;
            var radius = MaximumRadius(shapeIndices[lane]);
            maximumRadius = maximumRadius.WithElement(lane, radius);
            maximumAngularExpansion = maximumRadius;
            var orientation = new Quaternion(orientations.X[lane], orientations.Y[lane], orientations.Z[lane], orientations.W[lane]);
            ComputeBounds(shapeIndices[lane], orientation, out var laneMin, out var laneMax);
            min = new() { X = min.X.WithElement(lane, laneMin.X), Y = min.Y.WithElement(lane, laneMin.Y), Z = min.Z.WithElement(lane, laneMin.Z) };
            max = new() { X = max.X.WithElement(lane, laneMax.X), Y = max.Y.WithElement(lane, laneMax.Y), Z = max.Z.WithElement(lane, laneMax.Z) };
        }
    }
}

static class ClusterPose
{
    /// <summary>Pose of a child relative to a cluster's centre, in world axes; without rounding where the cluster is not turned.</summary>
    public static RigidPose Place(in RigidPose child, Quaternion orientation) => orientation == Quaternion.Identity
        ? child
        : new(Exact.Rotate(child.Position, orientation), Exact.Concatenate(child.Orientation, orientation));

    /// <summary>Puts a child of A where A is.</summary>
    public static unsafe void SetA(ref ChildShapes children, in Cluster cluster, int index, Shapes shapes)
    {
        var child = Get(cluster, index, shapes, children.OrientationA, out children.NameA, out children.ShapeA);
        (children.TypeA, children.OffsetA, children.OrientationA) = (children.NameA.Type, child.Position, child.Orientation);
    }

    /// <summary>Puts a child of B where B is.</summary>
    public static unsafe void SetB(ref ChildShapes children, in Cluster cluster, int index, Shapes shapes)
    {
        var child = Get(cluster, index, shapes, children.OrientationB, out children.NameB, out children.ShapeB);
        (children.TypeB, children.OffsetB, children.OrientationB) = (children.NameB.Type, children.OffsetB + child.Position, child.Orientation);
    }

    static unsafe RigidPose Get(in Cluster cluster, int index, Shapes shapes, Quaternion orientation, out TypedIndex name, out void* shape)
    {
        ref var child = ref cluster.Children[index];
        name = child.Shape;
        shapes[name.Type]!.GetShapeData(name.Index, out shape, out _);
        return Place(child.Pose, orientation);
    }
}

/// <summary>The order in which a task finds children.</summary>
public enum ClusterOrder
{
    Rising,
    Falling,
    Shuffled,
}

/// <summary>Which children a task finds, and in which order.</summary>
sealed class ClusterRules
{
    public ClusterOrder Order;
    /// <summary>Children that are found; all where nothing is said.</summary>
    public Func<int, bool> Finds = _ => true;
    /// <summary>Whether the contacts of children become patches.</summary>
    public bool Joins = true;
    /// <summary>What is next to a child of a static that is a triangle.</summary>
    public Func<int, TriangleCone>? Cones;

    public int At(int index, int count) => Order switch
    {
        ClusterOrder.Rising => index,
        ClusterOrder.Falling => count - 1 - index,
        // Coprime with the counts of the tests.
        _ => (index * 11 + 3) % count,
    };
}

/// <summary>Expands a convex shape and a cluster into pairs of the shape and each child.</summary>
sealed unsafe class ClusterTask<TShape>(ClusterRules rules) : ExpandingTask<TShape, Cluster> where TShape : unmanaged, IConvexShape
{
    internal override bool JoinsChildren => rules.Joins;

    internal override void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        for (int i = 0; i < batch.Count; ++i)
        {
            ref var entry = ref Entries(batch)[i];
            for (int j = 0; j < entry.B.Children.Length; ++j)
            {
                var child = rules.At(j, entry.B.Children.Length);
                if (rules.Finds(child))
                    found.Add(new(i, entry.Pair.Flipped ? new(child, 0) : new(0, child)), pool);
            }
        }
    }

    internal override void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, bool hasA, ref ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        ref var pair = ref entry.Pair;
        children = new() { OffsetB = pair.OffsetB, OrientationA = pair.OrientationA, OrientationB = pair.OrientationB };
        if (pair.Flipped)
        {
            ClusterPose.SetA(ref children, entry.B, found.Children.A, shapes);
            (children.TypeB, children.NameB) = (TShape.TypeId, pair.NameB);
            children.ShapeB = Unsafe.AsPointer(ref entry.A);
        }
        else
        {
            ClusterPose.SetB(ref children, entry.B, found.Children.B, shapes);
            (children.TypeA, children.NameA) = (TShape.TypeId, pair.NameA);
            children.ShapeA = Unsafe.AsPointer(ref entry.A);
            children.ConeB = rules.Cones?.Invoke(found.Children.B) ?? default;
        }
    }
}

/// <summary>Expands two clusters into all pairs of their children.</summary>
sealed class ClusterPairTask(ClusterRules rules) : ExpandingTask<Cluster, Cluster>
{
    internal override bool JoinsChildren => rules.Joins;

    internal override unsafe void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        for (int i = 0; i < batch.Count; ++i)
        {
            ref var entry = ref Entries(batch)[i];
            var countB = entry.B.Children.Length;
            for (int j = 0; j < entry.A.Children.Length * countB; ++j)
            {
                var child = rules.At(j, entry.A.Children.Length * countB);
                found.Add(new(i, new(child / countB, child % countB)), pool);
            }
        }
    }

    internal override unsafe void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, bool hasA, ref ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        children = new() { OffsetB = entry.Pair.OffsetB, OrientationA = entry.Pair.OrientationA, OrientationB = entry.Pair.OrientationB };
        ClusterPose.SetA(ref children, entry.A, found.Children.A, shapes);
        ClusterPose.SetB(ref children, entry.B, found.Children.B, shapes);
    }
}
