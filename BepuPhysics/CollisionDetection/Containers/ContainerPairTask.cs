using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Expands two containers into pairs of their children that may touch.</summary>
/// <typeparam name="TContainerA">First container; its type id is no greater than that of the second.</typeparam>
/// <typeparam name="TContainerB">Second container.</typeparam>
sealed unsafe class ContainerPairTask<TContainerA, TContainerB> : ExpandingTask<TContainerA, TContainerB>
    where TContainerA : unmanaged, IContainer where TContainerB : unmanaged, IContainer
{
    // Behind the pairs is room for two children that are made on the way.
    internal override int BatchByteCount => ScratchStart + 2 * IContainer.ScratchByteCount;

    int ScratchStart => (base.BatchByteCount + 15) & ~15;

    internal override void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var entries = Entries(batch);
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            var count = Math.Min(Vector<float>.Count, batch.Count - start);
            var parents = default(ParentMotionWide);
            for (int i = 0; i < count; ++i)
                parents.Write(entries[start + i].Pair, moverIsA: entries[start + i].Pair.Flipped, i);
            var motion = new RelativeMotionWide(parents, dt);
            for (int i = 0; i < count; ++i)
            {
                ref var entry = ref entries[start + i];
                ContainerDescent<TContainerA, TContainerB>.Find(entry.A, entry.B, new(ref motion, i), start + i, entry.Pair.Flipped, shapes, ref found, pool);
            }
        }
    }

    internal override void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, out ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        var scratch = batch.Bundles.Memory + ScratchStart;
        ContainerPlaces.SetParents(entry.Pair, out children);
        if (entry.Pair.Flipped)
        {
            ContainerPlaces.SetA(ref children, entry.B, found.Children.A, shapes, scratch);
            ContainerPlaces.SetB(ref children, entry.A, found.Children.B, shapes, scratch + IContainer.ScratchByteCount);
        }
        else
        {
            ContainerPlaces.SetA(ref children, entry.A, found.Children.A, shapes, scratch);
            ContainerPlaces.SetB(ref children, entry.B, found.Children.B, shapes, scratch + IContainer.ScratchByteCount);
        }
    }
}
