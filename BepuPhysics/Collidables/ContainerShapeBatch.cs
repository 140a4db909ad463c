using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>What can be asked of a batch of shapes made of children without knowing their type; see <see cref="IContainer"/>.</summary>
unsafe interface IContainerBatch
{
    /// <inheritdoc cref="IContainer.ChildCount"/>
    int ChildCount(int shapeIndex);

    /// <inheritdoc cref="IContainer.FanOut"/>
    int FanOut(int shapeIndex, int node);

    /// <inheritdoc cref="IContainer.Open"/>
    int Open(int shapeIndex, int node, NodeChild* below);

    /// <inheritdoc cref="IContainer.FindOverlaps"/>
    void FindOverlaps(int shapeIndex, Vector3 min, Vector3 max, ref QuickList<int> found, BufferPool pool);

    /// <inheritdoc cref="IContainer.GetChild"/>
    void GetChild(int shapeIndex, int index, void* scratch, out ContainerChild child);
}

/// <summary>Shapes of one type that are made of children.</summary>
abstract unsafe class ContainerShapeBatch<TContainer>(BufferPool source, int initialCapacity, Shapes all)
    : ShapeBatch<TContainer>(source, initialCapacity), IContainerBatch where TContainer : unmanaged, IContainer
{
    /// <summary>Shapes that children refer to.</summary>
    private protected readonly Shapes all = all;

    public sealed override bool Compound => true;

    internal override float MaximumRadius(int shapeIndex) => Measure(shapeIndex, Quaternion.Identity).MaximumRadius;

    internal sealed override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations, out Vector<float> maximumRadius,
        out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max) =>
        GetBoundsOneByOne(shapeIndices, orientations, out maximumRadius, out maximumAngularExpansion, out min, out max);

    int IContainerBatch.ChildCount(int shapeIndex) => Get(shapeIndex).ChildCount;

    int IContainerBatch.FanOut(int shapeIndex, int node) => Get(shapeIndex).FanOut(node, all);

    int IContainerBatch.Open(int shapeIndex, int node, NodeChild* below) => Get(shapeIndex).Open(node, all, below);

    void IContainerBatch.FindOverlaps(int shapeIndex, Vector3 min, Vector3 max, ref QuickList<int> found, BufferPool pool)
    {
        ref var container = ref Get(shapeIndex);
        var list = default(Buffer<NodeChild>);
        if (TContainer.IsList)
        {
            pool.TakeAtLeast(container.FanOut(0, all), out list);
            container.Open(0, all, list.Memory);
        }
        container.FindOverlaps(min, max, default, all, list.Memory, ref found, pool);
        pool.ReturnIfTaken(ref list);
    }

    void IContainerBatch.GetChild(int shapeIndex, int index, void* scratch, out ContainerChild child) =>
        Get(shapeIndex).GetChild(index, all, scratch, out child);
}
