using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Expands a convex shape and a container into pairs of the shape and each child that it may touch.</summary>
/// <typeparam name="TConvex">The convex shape.</typeparam>
/// <typeparam name="TConvexWide">Wide form of the convex shape.</typeparam>
/// <typeparam name="TContainer">The shape made of children; its type id is greater than that of the convex shape.</typeparam>
sealed unsafe class ConvexContainerTask<TConvex, TConvexWide, TContainer> : ExpandingTask<TConvex, TContainer>
    where TConvex : unmanaged, IConvexShape where TConvexWide : unmanaged, IShapeWide<TConvex> where TContainer : unmanaged, IContainer
{
    const int InitialCapacity = 64;

    // Behind the pairs is room for a child that is made on the way.
    internal override int BatchByteCount => ScratchStart + IContainer.ScratchByteCount;

    int ScratchStart => (base.BatchByteCount + 15) & ~15;

    internal override void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var entries = Entries(batch);
        var children = new QuickList<int>(InitialCapacity, pool);
        var list = default(Buffer<NodeChild>);
        var listed = default(TypedIndex);
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            var count = Math.Min(Vector<float>.Count, batch.Count - start);
            FindBoxes(entries + start, count, dt, out var min, out var max);
            for (int i = 0; i < count; ++i)
            {
                ref var entry = ref entries[start + i];
                // A triangle has no middle: that of one which is a floor would be inside of whatever lies on it there.
                if (TContainer.MayBeSolid && typeof(TConvex) != typeof(Triangle) && entry.B.IsSolid &&
                    WaysOut.Find(entry.Pair, entry.Pair.Flipped, entry.B, out var way))
                {
                    found.Add(new(start + i, Ids(entry.Pair, way.Child)) { LeadsOut = true }, pool);
                    continue;
                }
                children.Count = 0;
                if (TContainer.IsList)
                    List(entry, shapes, ref list, ref listed, pool);
                entry.B.FindOverlaps(
                    Lanes.Read<Vector3, Vector3Wide>(ref min, i), Lanes.Read<Vector3, Vector3Wide>(ref max, i), shapes, list.Memory, ref children, pool);
                for (int j = 0; j < children.Count; ++j)
                    found.Add(new(start + i, Ids(entry.Pair, children[j])), pool);
            }
        }
        children.Dispose(pool);
        if (list.Allocated)
            pool.Return(ref list);
    }

    static ChildIds Ids(in ParentPair pair, int child) => pair.Flipped ? new(child, 0) : new(0, child);

    // Measures the children of a container, unless they are those that were measured last.
    static void List(in Entry entry, Shapes shapes, ref Buffer<NodeChild> list, ref TypedIndex listed, BufferPool pool)
    {
        var name = entry.Pair.Flipped ? entry.Pair.NameA : entry.Pair.NameB;
        if (name.Exists && name.Packed == listed.Packed)
            return;
        listed = name;
        ContainerPlaces.Open(entry.B, 0, shapes, ref list, pool);
    }

    static void FindBoxes(Entry* entries, int count, float dt, out Vector3Wide min, out Vector3Wide max)
    {
        var parents = default(ParentMotionWide);
        var convex = default(TConvexWide);
        for (int i = 0; i < count; ++i)
        {
            parents.Write(entries[i].Pair, moverIsA: !entries[i].Pair.Flipped, i);
            Lanes.Write(entries[i].A, ref convex, i);
        }
        var motion = new RelativeMotionWide(parents, dt);
        convex.GetBounds(motion.Orientation, out var maximumRadius, out var maximumAngularExpansion, out min, out max);
        motion.Widen(maximumRadius, maximumAngularExpansion, ref min, ref max);
    }

    internal override void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, out ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        if (found.LeadsOut)
        {
            SetWayOut(ref entry, batch.Bundles.Memory + ScratchStart, out children);
            return;
        }
        ContainerPlaces.Set(
            entry.Pair, containerIsA: entry.Pair.Flipped, entry.B, found.Children, TConvex.TypeId, Unsafe.AsPointer(ref entry.A), shapes,
            batch.Bundles.Memory + ScratchStart, out children);
    }

    static void SetWayOut(ref Entry entry, void* scratch, out ChildShapes children)
    {
        ref var pair = ref entry.Pair;
        ContainerPlaces.SetParents(pair, out children);
        ContainerPlaces.SetShape(ref children, isA: !pair.Flipped, TConvex.TypeId, Unsafe.AsPointer(ref entry.A));
        WaysOut.Find(pair, pair.Flipped, entry.B, out var way);
        WaysOut.Set(ref children, pair.Flipped, way, scratch);
    }
}
