using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.Trees;

/// <summary>Builds a whole tree on many threads: the same as <see cref="TreeBuilder"/> builds on one.</summary>
/// <remarks>
/// Leaves are copied, then the nodes of each level are split side by side, for some levels; what is below these is built by one thread each, and last the
/// few nodes above are told what is below them. The first split is one thread's alone: of n leaves the levels of one thread take n, n / 2, n / 4 and so on,
/// 2 n in all, of n log n.
/// </remarks>
unsafe struct TreeBuildWork : IStagedWork
{
    const int Levels = 6;
    // Built by one thread below this many leaves.
    const int LeastSplitCount = 256;
    const int CopiesPerBlock = 1024;

    const int CopyStage = 0;
    const int FirstSplitStage = 1;
    const int BuildStage = FirstSplitStage + Levels;
    const int FitStage = BuildStage + 1;

    // A subtree: its items, and where it hangs. Its halves are at 2 i + 1 and 2 i + 2.
    struct Subtree
    {
        public NodeChild* Items;
        public NodeChild* Spare;
        // Zero for one that is part of another.
        public int Count;
        public int Slot;
        public int Order;
        public int AllowedHeight;
        public bool IsSplit;
    }

    Tree tree;
    NodeChild* items;
    int* nodeIndices;
    Buffer<Subtree> subtrees;

    /// <summary>Builds a tree over its present leaves, which it has some thousands of.</summary>
    /// <param name="tree">The tree.</param>
    /// <param name="items">Room for all leaves.</param>
    /// <param name="spare">The same once more.</param>
    /// <param name="nodeIndices">Room for the indices of all nodes.</param>
    /// <param name="allowedHeight">Height that the tree must not exceed.</param>
    /// <param name="pool">Source of memory for the time of the call.</param>
    /// <param name="dispatcher">The threads.</param>
    public static void Run(
        in Tree tree, NodeChild* items, NodeChild* spare, int* nodeIndices, int allowedHeight, BufferPool pool, IThreadDispatcher dispatcher)
    {
        var work = new TreeBuildWork { tree = tree, items = items, nodeIndices = nodeIndices };
        pool.TakeAtLeast((2 << Levels) - 1, out work.subtrees);
        work.subtrees.Clear(0, work.subtrees.Length);
        work.subtrees[0] = new() { Items = items, Spare = spare, Count = tree.LeafCount, Slot = -1, AllowedHeight = allowedHeight };
        try
        {
            StagedWork.Run(ref work, dispatcher);
        }
        finally
        {
            pool.Return(ref work.subtrees);
        }
    }

    public readonly int StageCount => FitStage + 1;

    public readonly int GetBlockCount(int stage) => stage switch
    {
        CopyStage => (tree.LeafCount + CopiesPerBlock - 1) / CopiesPerBlock,
        BuildStage => (2 << Levels) - 1,
        FitStage => 1,
        _ => 1 << stage - FirstSplitStage,
    };

    public readonly void Execute(int stage, int block, int workerIndex)
    {
        switch (stage)
        {
            case CopyStage:
                Copy(block * CopiesPerBlock, MathHelper.Min((block + 1) * CopiesPerBlock, tree.LeafCount));
                break;
            case BuildStage:
                Build(ref subtrees[block]);
                break;
            case FitStage:
                Fit();
                break;
            default:
                Split((1 << stage - FirstSplitStage) - 1 + block);
                break;
        }
    }

    readonly void Copy(int start, int end)
    {
        for (var leaf = start; leaf < end; ++leaf)
        {
            items[leaf] = tree.Children[tree.Leaves[leaf].Slot];
            // One more than there are nodes.
            nodeIndices[leaf] = leaf;
        }
    }

    readonly void Split(int index)
    {
        ref var subtree = ref subtrees[index];
        if (subtree.Count < LeastSplitCount)
            return;
        var node = nodeIndices[subtree.Order];
        if (subtree.Slot >= 0)
            tree.Metanodes[node].ParentSlot = subtree.Slot;
        var leftCount = TreeBuilder.Split(subtree.Items, subtree.Spare, subtree.Count, subtree.AllowedHeight, out var moved);
        var source = moved ? subtree.Spare : subtree.Items;
        var other = moved ? subtree.Items : subtree.Spare;
        subtree.IsSplit = true;
        subtrees[2 * index + 1] = new()
        {
            Items = source,
            Spare = other,
            Count = leftCount,
            Slot = 2 * node,
            Order = subtree.Order + 1,
            AllowedHeight = subtree.AllowedHeight - 1,
        };
        subtrees[2 * index + 2] = new()
        {
            Items = source + leftCount,
            Spare = other + leftCount,
            Count = subtree.Count - leftCount,
            Slot = 2 * node + 1,
            Order = subtree.Order + leftCount,
            AllowedHeight = subtree.AllowedHeight - 1,
        };
    }

    readonly void Build(ref Subtree subtree)
    {
        if (subtree.Count > 0 && !subtree.IsSplit)
        {
            TreeBuilder.BuildBelow(
                tree, subtree.Slot, subtree.Items, subtree.Spare, subtree.Count, nodeIndices, subtree.Order, subtree.AllowedHeight);
        }
    }

    readonly void Fit()
    {
        for (var i = (1 << Levels) - 2; i >= 0; --i)
        {
            if (!subtrees[i].IsSplit)
                continue;
            var node = nodeIndices[subtrees[i].Order];
            tree.Metanodes[node].Height = 1 + MathHelper.Max(tree.HeightOf(tree.Children + 2 * node), tree.HeightOf(tree.Children + 2 * node + 1));
            if (subtrees[i].Slot >= 0)
                tree.FitSlotToNode(node);
        }
    }
}
