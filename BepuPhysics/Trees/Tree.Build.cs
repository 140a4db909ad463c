using System;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>Builds the tree anew over its present leaves, which keep their indices. Leaves the nodes in depth-first order.</summary>
    public void BinnedBuild(BufferPool pool) => BinnedBuild(pool, null);

    /// <summary>As <see cref="BinnedBuild(BufferPool)"/>, on many threads if the tree is large: the same tree.</summary>
    internal void BinnedBuild(BufferPool pool, IThreadDispatcher? dispatcher)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (LeafCount <= 2)
            return;
        using var scratch = new BuildScratch(LeafCount, pool);
        BuildAll(scratch, pool, dispatcher);
    }

    /// <summary>Replaces the content of the tree: leaf i gets box i. Leaves the nodes in depth-first order.</summary>
    public void BinnedBuild(ReadOnlySpan<BoundingBox> leafBounds, BufferPool pool) => BinnedBuild(leafBounds, pool, null);

    /// <summary>As <see cref="BinnedBuild(ReadOnlySpan{BoundingBox}, BufferPool)"/>: there is one way to build a tree.</summary>
    /// <param name="pool">Source of memory.</param>
    /// <param name="leafBounds">Boxes of the leaves.</param>
    public void SweepBuild(BufferPool pool, Buffer<BoundingBox> leafBounds) =>
        BinnedBuild(new ReadOnlySpan<BoundingBox>(leafBounds.Memory, leafBounds.Length), pool);

    /// <summary>As <see cref="BinnedBuild(ReadOnlySpan{BoundingBox}, BufferPool)"/>, on many threads if the tree is large: the same tree.</summary>
    internal void BinnedBuild(ReadOnlySpan<BoundingBox> leafBounds, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (leafBounds.Length > MaximumLeafCount)
            throw new ArgumentException($"A tree holds at most {MaximumLeafCount} leaves, got {leafBounds.Length}.", nameof(leafBounds));
        foreach (ref readonly var box in leafBounds)
            BoxMath.RequireBox(box.Min, box.Max);

        // All memory before the first change.
        EnsureCapacity(leafBounds.Length, pool);
        using var scratch = new BuildScratch(leafBounds.Length, pool);
        Clear();
        if (leafBounds.Length < 3)
        {
            foreach (ref readonly var box in leafBounds)
                Add(box, pool);
            return;
        }
        LeafCount = leafBounds.Length;
        // Anywhere: there are as many slots as leaves and more.
        for (var leaf = 0; leaf < LeafCount; ++leaf)
        {
            Children[leaf] = new NodeChild { Min = leafBounds[leaf].Min, Max = leafBounds[leaf].Max, Index = ~leaf, LeafCount = 1 };
            Leaves[leaf].Slot = leaf;
        }
        BuildAll(scratch, pool, dispatcher);
    }

    void BuildAll(in BuildScratch scratch, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        if (IsWorthThreads(dispatcher))
        {
            Metanodes[0].ParentSlot = -1;
            TreeBuildWork.Run(this, scratch.Items, scratch.Spare, scratch.NodeIndices, MaximumHeight, pool, dispatcher!);
            isDepthFirst = true;
            return;
        }
        for (var leaf = 0; leaf < LeafCount; ++leaf)
            scratch.Items[leaf] = Children[Leaves[leaf].Slot];
        var nodeCount = NodeCount;
        for (var node = 0; node < nodeCount; ++node)
            scratch.NodeIndices[node] = node;
        Metanodes[0].ParentSlot = -1;
        TreeBuilder.Build(this, scratch.Items, scratch.Spare, LeafCount, scratch.NodeIndices, MaximumHeight);
        isDepthFirst = true;
    }

    /// <summary>Builds the subtree of a node anew out of its leaves, in the places that its nodes have: a tree in depth-first order stays
    /// so.</summary>
    readonly void RebuildSubtree(int node, int allowedHeight, BufferPool pool)
    {
        var count = Children[2 * node].LeafCount + Children[2 * node + 1].LeafCount;
        if (count < 3)
            return;
        using var scratch = new BuildScratch(count, pool);
        Gather(node, 1, scratch, out var itemCount, out _);
        TreeBuilder.Build(this, scratch.Items, scratch.Spare, itemCount, scratch.NodeIndices, allowedHeight);
    }

    /// <summary>
    /// Collects, in depth-first order, the nodes below and including one that have more leaves than a limit, and as items the largest
    /// subtrees that have not.
    /// </summary>
    readonly void Gather(int top, int itemLeafLimit, in BuildScratch scratch, out int itemCount, out int highestItem)
    {
        var stack = stackalloc int[TraversalStackSize];
        var children = Children;
        var stackCount = 1;
        var nodeCount = 0;
        stack[0] = top;
        itemCount = 0;
        highestItem = 0;
        while (stackCount > 0)
        {
            var node = stack[--stackCount];
            scratch.NodeIndices[nodeCount++] = node;
            // B first, so that A is the next to be taken.
            for (var slot = 2 * node + 1; slot >= 2 * node; --slot)
            {
                if (children[slot].LeafCount > itemLeafLimit)
                {
                    stack[stackCount++] = children[slot].Index;
                    continue;
                }
                scratch.Items[itemCount++] = children[slot];
                var height = HeightOf(children + slot);
                if (height > highestItem)
                    highestItem = height;
            }
        }
    }

    /// <summary>Memory of one build, in one piece from the pool.</summary>
    readonly ref struct BuildScratch
    {
        readonly Buffer<byte> memory;
        readonly BufferPool pool;

        public BuildScratch(int itemCapacity, BufferPool pool)
        {
            this.pool = pool;
            pool.TakeAtLeast(checked(itemCapacity * (2 * sizeof(NodeChild) + sizeof(int))), out memory);
            Items = (NodeChild*)memory.Memory;
            Spare = Items + itemCapacity;
            NodeIndices = (int*)(Spare + itemCapacity);
        }

        public NodeChild* Items { get; }

        public NodeChild* Spare { get; }

        public int* NodeIndices { get; }

        public void Dispose()
        {
            var copy = memory;
            pool.Return(ref copy);
        }
    }
}
