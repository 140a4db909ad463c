using System.Numerics;
using System.Runtime.Intrinsics;
using BepuUtilities;
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
        var children = Children;
        var queryMin = min.AsVector128();
        var queryMax = max.AsVector128();
        if (LeafCount <= 1)
        {
            if (LeafCount == 1 && BoxMath.Overlaps(queryMin, queryMax, BoxMath.LoadMin(children), BoxMath.LoadMax(children)))
                leafEnumerator.LoopBody(~children->Index);
            return;
        }

        var stack = stackalloc int[TraversalStackSize];
        var count = 1;
        stack[0] = 0;
        while (count > 0)
        {
            var slot = 2 * stack[--count];
            for (var last = slot + 1; slot <= last; ++slot)
            {
                var child = children + slot;
                if (!BoxMath.Overlaps(queryMin, queryMax, BoxMath.LoadMin(child), BoxMath.LoadMax(child)))
                    continue;
                if (child->Index >= 0)
                    stack[count++] = child->Index;
                else if (!leafEnumerator.LoopBody(~child->Index))
                    return;
            }
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

    static void RequireQuery(Vector3 min, Vector3 max)
    {
        if (!(min.X <= max.X && min.Y <= max.Y && min.Z <= max.Z))
            throw new System.ArgumentException($"A box must have min <= max on every axis, was min {min}, max {max}.");
    }

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
