using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Expands a container and a half-space into pairs of the half-space and each child that it may touch.</summary>
/// <remarks>A plane that is not across an axis is in the box of everything: nodes are compared with the plane itself.</remarks>
/// <typeparam name="TContainer">The shape made of children; its type id is less than that of half-spaces.</typeparam>
sealed unsafe class ContainerPlaneTask<TContainer> : ExpandingTask<TContainer, HalfSpace> where TContainer : unmanaged, IContainer
{
    const int InitialCapacity = 64;

    // Behind the pairs is room for a child that is made on the way.
    internal override int BatchByteCount => ScratchStart + IContainer.ScratchByteCount;

    int ScratchStart => (base.BatchByteCount + 15) & ~15;

    // Tests look at the container as it is, so nothing is needed but what is within the margin now.
    internal override void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var entries = Entries(batch);
        var nodes = new QuickList<int>(InitialCapacity, pool);
        for (int i = 0; i < batch.Count; ++i)
        {
            ref var pair = ref entries[i].Pair;
            var (offset, container, plane) = pair.Flipped
                ? (-pair.OffsetB, pair.OrientationB, pair.OrientationA)
                : (pair.OffsetB, pair.OrientationA, pair.OrientationB);
            var normal = Exact.Rotate(entries[i].B.Normal, plane);
            // Of what touches, over the container's centre.
            var height = Exact.Dot(normal, offset) + pair.SpeculativeMargin + Exact.Length(offset) * RelativeMotionWide.Rounding;
            Find(entries[i].A, Exact.Rotate(normal, Exact.Conjugate(container)), height, i, pair.Flipped, shapes, ref nodes, ref found, pool);
        }
        nodes.Dispose(pool);
    }

    static void Find(in TContainer container, in Vector3 normal, float height, int parent, bool flipped, Shapes shapes, ref QuickList<int> nodes,
        ref QuickList<FoundChild> found, BufferPool pool)
    {
        var below = default(Buffer<NodeChild>);
        var size = Vector3.Abs(normal);
        nodes.Count = 0;
        if (TContainer.HasNodes)
        {
            nodes.Add(0, pool);
        }
        else
        {
            var count = ListBelow(container, normal, height, shapes, ref below, pool);
            Test(below, count, normal, size, height, parent, flipped, ref nodes, ref found, pool);
        }
        while (nodes.Count > 0)
        {
            var count = ContainerPlaces.Open(container, nodes.Pop(), shapes, ref below, pool);
            Test(below, count, normal, size, height, parent, flipped, ref nodes, ref found, pool);
        }
        pool.ReturnIfTaken(ref below);
    }

    static void Test(Buffer<NodeChild> below, int count, in Vector3 normal, in Vector3 size, float height, int parent, bool flipped,
        ref QuickList<int> nodes, ref QuickList<FoundChild> found, BufferPool pool)
    {
        for (int i = 0; i < count; ++i)
        {
            var center = (below[i].Min + below[i].Max) * .5f;
            var half = below[i].Max - center;
            if (Exact.Dot(normal, center) - Exact.Dot(size, half) > height + Rounding(center, half))
                continue;
            if (below[i].Index >= 0)
                nodes.Add(below[i].Index, pool);
            else
                found.Add(new(parent, flipped ? new(0, ~below[i].Index) : new(~below[i].Index, 0)), pool);
        }
    }

    static float Rounding(in Vector3 center, in Vector3 half) => (Exact.Length(center) + Exact.Length(half)) * RelativeMotionWide.Rounding;

    // Those in the box around what of the container's own box is below the plane: along each axis, as far as the plane goes where the other two
    // coordinates are the lowest.
    static int ListBelow(in TContainer container, in Vector3 normal, float height, Shapes shapes, ref Buffer<NodeChild> below, BufferPool pool)
    {
        if (ContainerPlaces.Open(container, 0, shapes, ref below, pool) == 0)
            return 0;
        var (min, max) = (below[0].Min, below[0].Max);
        var lowest = Exact.Min(normal * min, normal * max);
        var room = height + 2 * Rounding((min + max) * .5f, (max - min) * .5f) - (lowest.X + lowest.Y + lowest.Z);
        if (room < 0)
            return 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            if (normal[axis] > 0)
                max[axis] = MathHelper.Min(max[axis], min[axis] + room / normal[axis]);
            else if (normal[axis] < 0)
                min[axis] = MathHelper.Max(min[axis], max[axis] + room / normal[axis]);
        }
        return ContainerReach.ListOverlaps(container, min, max, shapes, ref below, pool);
    }

    internal override void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, bool hasA, ref ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        ContainerPlaces.Set(
            entry.Pair, containerIsA: !entry.Pair.Flipped, entry.A, found.Children, HalfSpace.Id, Unsafe.AsPointer(ref entry.B), shapes,
            batch.Bundles.Memory + ScratchStart, out children);
    }
}
