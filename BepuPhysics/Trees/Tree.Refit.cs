using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>Below this many leaves a dispatch costs as much as a pass over all nodes.</summary>
    const int MinimumLeafCountForThreads = 2048;

    /// <summary>Fits the box of every node to its children, from the leaves up; the shape of the tree and the places of its nodes
    /// stay.</summary>
    public readonly void Refit()
    {
        if (LeafCount <= 2)
            return;
        if (isDepthFirst)
            SweepBounds();
        else
            RefitByLinks();
    }

    /// <summary>Fits the box of every node to its children and brings the nodes into depth-first order if they are not. The shape of the
    /// tree stays.</summary>
    public void Refit(BufferPool pool) => Refit(pool, null);

    /// <summary>As <see cref="Refit(BufferPool)"/>, on many threads if the tree is large.</summary>
    internal void Refit(BufferPool pool, IThreadDispatcher? dispatcher)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (IsWorthThreads(dispatcher))
        {
            FitParts(pool, dispatcher!, fitsBounds: true);
            return;
        }
        if (!IsDepthFirst)
            SortNodes(pool);
        if (LeafCount > 2)
            SweepBounds();
    }

    /// <summary>Brings the nodes into depth-first order if they are not, on many threads if the tree is large. Boxes stay what they are.</summary>
    void SortNodes(BufferPool pool, IThreadDispatcher? dispatcher)
    {
        if (IsWorthThreads(dispatcher))
            FitParts(pool, dispatcher!, fitsBounds: false);
        else
            SortNodes(pool);
    }

    /// <summary>Whether going over all nodes takes so long that threads are worth waking.</summary>
    readonly bool IsWorthThreads(IThreadDispatcher? dispatcher) => dispatcher is { ThreadCount: > 1 } && LeafCount >= MinimumLeafCountForThreads;

    // Sorting and fitting are one pass over each part: its nodes are in the cache in between.
    void FitParts(BufferPool pool, IThreadDispatcher dispatcher, bool fitsBounds)
    {
        var work = new RefitWork { Sort = isDepthFirst ? default : new NodeSort(this, pool), FitsBounds = fitsBounds };
        if (!isDepthFirst)
            work.Sort.HandOver(ref this);
        work.Tree = this;
        work.Parts = new TreeParts(this, dispatcher.ThreadCount, work.Sort, pool);
        try
        {
            StagedWork.Run(ref work, dispatcher);
        }
        finally
        {
            work.Parts.Dispose(pool);
            work.Sort.End(pool);
        }
        isDepthFirst = true;
    }

    // Subtrees write to nobody's nodes but their own, and to the slots that they hang on.
    struct RefitWork : IStagedWork
    {
        public Tree Tree;
        public TreeParts Parts;
        public NodeSort Sort;
        public bool FitsBounds;

        public readonly int StageCount => FitsBounds ? 2 : 1;
        public readonly int GetBlockCount(int stage) => stage == 0 ? Parts.Parts.Count : 1;

        public readonly void Execute(int stage, int block, int workerIndex)
        {
            if (stage == 0)
            {
                var part = Parts.Parts[block];
                if (Sort.IsNeeded)
                    Sort.Place(part.Start, part.End);
                if (FitsBounds)
                    Tree.SweepBounds(part.Start, part.End);
                return;
            }
            for (var i = Parts.Tops.Count - 1; i > 0; --i)
                Tree.FitBoundsOfSlot(Parts.Tops[i]);
        }
    }

    /// <summary>In depth-first order all that is below a node comes after it, so one sweep from the end sees children before
    /// parents.</summary>
    readonly void SweepBounds() => SweepBounds(1, NodeCount);

    // Every node writes into its parent unasked: that leaves no branch to predict.
    readonly void SweepBounds(int start, int end)
    {
        for (var node = end - 1; node >= start; --node)
            FitBoundsOfSlot(node);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void FitBoundsOfSlot(int node)
    {
        var children = Children;
        var a = children + 2 * node;
        BoxMath.StoreBox(children + Metanodes.Memory[node].ParentSlot,
            BoxMath.Min(BoxMath.LoadMin(a), BoxMath.LoadMin(a + 1)),
            BoxMath.Max(BoxMath.LoadMax(a), BoxMath.LoadMax(a + 1)));
    }

    /// <summary>Walks the tree in post-order along its links, without a stack and in any order of nodes.</summary>
    readonly void RefitByLinks()
    {
        var children = Children;
        var node = DescendToFirst(0);
        while (true)
        {
            var slot = Metanodes[node].ParentSlot;
            if (slot < 0)
                return;
            FitSlotToNode(node);
            var cameFromA = (slot & 1) == 0;
            node = cameFromA && children[slot + 1].Index >= 0 ? DescendToFirst(children[slot + 1].Index) : slot >> 1;
        }
    }

    readonly int DescendToFirst(int node)
    {
        var children = Children;
        while (true)
        {
            var a = children[2 * node].Index;
            var b = children[2 * node + 1].Index;
            if ((a & b) < 0)
                return node;
            node = a >= 0 ? a : b;
        }
    }

    /// <summary>Copies the nodes into fresh memory in depth-first order.</summary>
    void SortNodes(BufferPool pool)
    {
        var sort = new NodeSort(this, pool);
        sort.Place(0, NodeCount);
        sort.HandOver(ref this);
        sort.End(pool);
        isDepthFirst = true;
    }

    /// <summary>Brings box and leaf count of the child that stands for a node in its parent up to date.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void FitSlotToNode(int node)
    {
        var children = Children;
        var a = children + 2 * node;
        BoxMath.Store(children + Metanodes[node].ParentSlot,
            BoxMath.Min(BoxMath.LoadMin(a), BoxMath.LoadMin(a + 1)),
            BoxMath.Max(BoxMath.LoadMax(a), BoxMath.LoadMax(a + 1)),
            node, a[0].LeafCount + a[1].LeafCount);
    }

    /// <summary>Fits the nodes above one whose boxes changed, until one does not change any more.</summary>
    readonly void RefitAncestors(int node)
    {
        var children = Children;
        for (var slot = Metanodes[node].ParentSlot; slot >= 0; slot = Metanodes[slot >> 1].ParentSlot)
        {
            var a = children + 2 * children[slot].Index;
            var min = BoxMath.Min(BoxMath.LoadMin(a), BoxMath.LoadMin(a + 1));
            var max = BoxMath.Max(BoxMath.LoadMax(a), BoxMath.LoadMax(a + 1));
            var same = Vector128.Equals(min, BoxMath.LoadMin(children + slot)) & Vector128.Equals(max, BoxMath.LoadMax(children + slot));
            if ((same.ExtractMostSignificantBits() & 7) == 7)
                return;
            BoxMath.StoreBox(children + slot, min, max);
        }
    }
}
