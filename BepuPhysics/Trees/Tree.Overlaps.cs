using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>Tells which leaves have boxes that overlap or touch a box, until the callback returns false. In no particular
    /// order.</summary>
    /// <param name="min">Lower corner of the box; no component may be NaN.</param>
    /// <param name="max">Upper corner of the box, nowhere below the lower; infinite components are allowed.</param>
    /// <param name="pool">Not used: the traversal needs no memory. Kept for callers.</param>
    /// <param name="leafEnumerator">Receives the indices of the leaves on the calling thread.</param>
    public readonly void GetOverlaps<TEnumerator>(Vector3 min, Vector3 max, BufferPool pool, ref TEnumerator leafEnumerator)
        where TEnumerator : IBreakableForEach<int>
    {
        RequireQuery(min, max);
        FindOverlapping(min.AsVector128(), max.AsVector128(), ref leafEnumerator);
    }

    /// <summary>Appends the leaves whose boxes overlap or touch a box, in no particular order, but in the same one for the same tree.</summary>
    /// <param name="min">Lower corner of the box; no component may be NaN.</param>
    /// <param name="max">Upper corner of the box, nowhere below the lower; infinite components are allowed.</param>
    /// <param name="overlaps">Receives the indices of the leaves, behind those that are in it.</param>
    /// <param name="pool">Source of the list's memory.</param>
    public readonly void GetOverlaps(Vector3 min, Vector3 max, ref QuickList<int> overlaps, BufferPool pool)
    {
        var collector = new LeafCollector { Leaves = overlaps, Pool = pool };
        GetOverlaps(min, max, pool, ref collector);
        overlaps = collector.Leaves;
    }

    struct LeafCollector : IBreakableForEach<int>
    {
        public QuickList<int> Leaves;
        public BufferPool Pool;

        public bool LoopBody(int i)
        {
            Leaves.Add(i, Pool);
            return true;
        }
    }

    /// <summary>As a box that was checked: of one that is looked for in several trees once.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void FindOverlapping<TEnumerator>(Vector128<float> min, Vector128<float> max, ref TEnumerator leafEnumerator)
        where TEnumerator : IBreakableForEach<int>
    {
        if (LeafCount > 1)
            Search(min, max, ref leafEnumerator);
        else if (LeafCount == 1 && BoxMath.Overlaps(min, max, BoxMath.LoadMin(Children), BoxMath.LoadMax(Children)))
            leafEnumerator.LoopBody(~Children->Index);
    }

    // Each way through a node is a branch of its own, which is guessed by itself, and the next node is not waited for.
    readonly void Search<TEnumerator>(Vector128<float> min, Vector128<float> max, ref TEnumerator leafEnumerator) where TEnumerator : IBreakableForEach<int>
    {
        var box = new OverlapTest(min, max);
        var children = Children;
        var stack = stackalloc int[TraversalStackSize];
        var count = 0;
        var index = 0;
        while (true)
        {
            var a = children + 2 * index;
            var apart = box.FindApart(a);
            var overlapsB = (apart & OverlapTest.SideB) == 0;
            if ((apart & OverlapTest.SideA) == 0)
            {
                index = a->Index;
                if (index >= 0)
                {
                    // Leaves are told of at once, of subtrees the second comes first.
                    if (overlapsB)
                    {
                        var indexB = (a + 1)->Index;
                        if (indexB >= 0)
                        {
                            stack[count++] = index;
                            index = indexB;
                        }
                        else if (!leafEnumerator.LoopBody(~indexB))
                        {
                            return;
                        }
                    }
                    continue;
                }
                if (!leafEnumerator.LoopBody(~index))
                    return;
            }
            if (overlapsB)
            {
                index = (a + 1)->Index;
                if (index >= 0)
                    continue;
                if (!leafEnumerator.LoopBody(~index))
                    return;
            }
            if (count == 0)
                return;
            index = stack[--count];
        }
    }

    /// <inheritdoc cref="GetOverlaps{TEnumerator}(Vector3, Vector3, BufferPool, ref TEnumerator)"/>
    public readonly void GetOverlaps<TEnumerator>(BoundingBox boundingBox, BufferPool pool, ref TEnumerator leafEnumerator)
        where TEnumerator : IBreakableForEach<int> =>
        GetOverlaps(boundingBox.Min, boundingBox.Max, pool, ref leafEnumerator);

    /// <summary>Tells which leaves of this tree overlap or touch which others of it, each pair once, the lower index first.</summary>
    public readonly void GetSelfOverlaps<TOverlapHandler>(ref TOverlapHandler results) where TOverlapHandler : IOverlapHandler
    {
        if (LeafCount > 1)
            PairTraversal<TOverlapHandler, SelfConsumer<TOverlapHandler>>.FindSelfPairs(this, ref results, 0);
    }

    /// <summary>
    /// As the overload without a pool, and several times as fast for large trees, with some memory of the pool for the time of the call.
    /// Brings the nodes into depth-first order first if they are not.
    /// </summary>
    public void GetSelfOverlaps<TOverlapHandler>(ref TOverlapHandler results, BufferPool pool) where TOverlapHandler : IOverlapHandler
    {
        System.ArgumentNullException.ThrowIfNull(pool);
        if (LeafCount < 2)
            return;
        if (!IsDepthFirst)
            SortNodes(pool);
        var runs = new LeafRuns(this, pool);
        try
        {
            RunTraversal<TOverlapHandler, SelfConsumer<TOverlapHandler>>.FindSelfPairs(
                this, runs, 0, NodeCount, int.MaxValue, ref results, 0);
        }
        finally
        {
            runs.Dispose(pool);
        }
    }

    /// <summary>Tells which leaves of this tree (first) overlap or touch which leaves of another (second), each pair once.</summary>
    public readonly void GetOverlaps<TOverlapHandler>(ref Tree treeB, ref TOverlapHandler overlapHandler)
        where TOverlapHandler : IOverlapHandler =>
        PairTraversal<TOverlapHandler, PairConsumer<TOverlapHandler>>.FindPairs(this, treeB, ref overlapHandler, 0);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void RequireQuery(Vector3 min, Vector3 max)
    {
        if (!Vector128.LessThanOrEqualAll(min.AsVector128(), max.AsVector128()))
            ThrowQuery(min, max);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ThrowQuery(Vector3 min, Vector3 max) =>
        throw new System.ArgumentException($"A box must have min <= max on every axis, was min {min}, max {max}.");

    readonly struct SelfConsumer<THandler> : IPairConsumer<THandler> where THandler : IOverlapHandler
    {
        public static void Consume(ref THandler handler, int workerIndex, int* leavesA, int* leavesB, int count)
        {
            for (var i = 0; i < count; ++i)
            {
                var a = leavesA[i];
                var b = leavesB[i];
                handler.Handle(a < b ? a : b, a < b ? b : a);
            }
        }
    }

    readonly struct PairConsumer<THandler> : IPairConsumer<THandler> where THandler : IOverlapHandler
    {
        public static void Consume(ref THandler handler, int workerIndex, int* leavesA, int* leavesB, int count)
        {
            for (var i = 0; i < count; ++i)
                handler.Handle(leavesA[i], leavesB[i]);
        }
    }
}
