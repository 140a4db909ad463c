using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Expands two containers into pairs of their children that may touch.</summary>
/// <typeparam name="TContainerA">First container; its type id is no greater than that of the second.</typeparam>
/// <typeparam name="TContainerB">Second container.</typeparam>
sealed unsafe class ContainerPairTask<TContainerA, TContainerB> : ExpandingTask<TContainerA, TContainerB>
    where TContainerA : unmanaged, IContainer where TContainerB : unmanaged, IContainer
{
    const int InitialCapacity = 16;

    // Behind the pairs is room for two children that are made on the way.
    internal override int BatchByteCount => ScratchStart + 2 * IContainer.ScratchByteCount;

    int ScratchStart => (base.BatchByteCount + 15) & ~15;

    internal override void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var entries = Entries(batch);
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            var count = Math.Min(Vector<float>.Count, batch.Count - start);
            var motionsB = Motions(entries + start, count, ofA: false, dt);
            var motionsA = ContainerDescent<TContainerA, TContainerB>.IsAsked ? Motions(entries + start, count, ofA: true, dt) : default;
            for (int i = 0; i < count; ++i)
            {
                ref var entry = ref entries[start + i];
                var flipped = entry.Pair.Flipped;
                var placementB = new NodePlacement(ref motionsB, i, entry.Pair, moverIsA: flipped, dt);
                var placementA = ContainerDescent<TContainerA, TContainerB>.IsAsked
                    ? new NodePlacement(ref motionsA, i, entry.Pair, moverIsA: !flipped, dt)
                    : default;
                var first = found.Count;
                ContainerDescent<TContainerA, TContainerB>.Find(
                    entry.A, entry.B, placementB, placementA, start + i, flipped, shapes, ref found, pool);
                if (!TContainerA.IsSurface && TContainerB.MayBeSolid && entry.B.IsSolid)
                    FindWaysOut(entry, placementB, start + i, first, shapes, ref found, pool);
            }
        }
    }

    // How one of the two containers moves in the frame of the other.
    static RelativeMotionWide Motions(Entry* entries, int count, bool ofA, float dt)
    {
        var parents = default(ParentMotionWide);
        for (int i = 0; i < count; ++i)
            parents.Write(entries[i].Pair, moverIsA: entries[i].Pair.Flipped != ofA, i);
        return new RelativeMotionWide(parents, dt);
    }

    // A child of A that is inside of B meets nothing of B but the way out.
    static void FindWaysOut(in Entry entry, in NodePlacement placement, int parent, int first, Shapes shapes, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var below = default(Buffer<NodeChild>);
        Vector3 min = new(float.MaxValue), max = new(-float.MaxValue);
        for (int i = ContainerPlaces.Open(entry.B, 0, shapes, ref below, pool) - 1; i >= 0; --i)
        {
            var box = placement.Place(below[i]);
            min = Exact.Min(min, box.Min);
            max = Exact.Max(max, box.Max);
        }
        if (TContainerA.IsList)
            ContainerPlaces.Open(entry.A, 0, shapes, ref below, pool);
        var near = new QuickList<int>(InitialCapacity, pool);
        entry.A.FindOverlaps(min, max, default, shapes, below.Memory, ref near, pool);
        var scratch = stackalloc Vector4[IContainer.ScratchByteCount / 16];
        foreach (int child in near.AsSpan())
        {
            if (!WaysOut.Find(entry.Pair, entry.Pair.Flipped, entry.A, child, entry.B, shapes, scratch, out var way))
                continue;
            var count = first;
            for (int i = first; i < found.Count; ++i)
            {
                if (ChildOfA(found[i], entry.Pair) != child)
                    found[count++] = found[i];
            }
            found.Count = count;
            found.Add(new(parent, entry.Pair.Flipped ? new(way.Child, child) : new(child, way.Child)) { LeadsOut = true }, pool);
        }
        near.Dispose(pool);
        pool.Return(ref below);
    }

    static int ChildOfA(in FoundChild found, in ParentPair pair) => pair.Flipped ? found.Children.B : found.Children.A;

    // In their order, each child of A comes with all that it meets: it is placed once for these. One that is made on the way stays, as B's has its own room.
    internal override void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, bool hasA, ref ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        ref readonly var pair = ref entry.Pair;
        var scratch = batch.Bundles.Memory + ScratchStart;
        if (found.LeadsOut)
        {
            ContainerPlaces.SetParents(pair, out children);
            SetWayOut(entry, ChildOfA(found, pair), shapes, scratch, ref children);
            return;
        }
        if (hasA)
            ContainerPlaces.SetParentB(pair, ref children);
        else
        {
            ContainerPlaces.SetParents(pair, out children);
            if (pair.Flipped)
                ContainerPlaces.SetA(ref children, entry.B, found.Children.A, shapes, scratch);
            else
                ContainerPlaces.SetA(ref children, entry.A, found.Children.A, shapes, scratch);
        }
        if (pair.Flipped)
            ContainerPlaces.SetB(ref children, entry.A, found.Children.B, shapes, scratch + IContainer.ScratchByteCount);
        else
            ContainerPlaces.SetB(ref children, entry.B, found.Children.B, shapes, scratch + IContainer.ScratchByteCount);
    }

    static void SetWayOut(in Entry entry, int child, Shapes shapes, byte* scratch, ref ChildShapes children)
    {
        ref readonly var pair = ref entry.Pair;
        WaysOut.Find(pair, pair.Flipped, entry.A, child, entry.B, shapes, scratch, out var way);
        WaysOut.Set(ref children, pair.Flipped, way, scratch);
        if (pair.Flipped)
            ContainerPlaces.SetB(ref children, entry.A, child, shapes, scratch + IContainer.ScratchByteCount);
        else
            ContainerPlaces.SetA(ref children, entry.A, child, shapes, scratch + IContainer.ScratchByteCount);
    }
}
