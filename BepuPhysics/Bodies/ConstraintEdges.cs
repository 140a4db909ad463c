using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>The list of a body's constraints: where it begins in <see cref="ConstraintEdges"/>. Empty where it is zero.</summary>
struct ConstraintList
{
    /// <summary>Edge of the constraint that was added first; means nothing where there is none.</summary>
    public int First;
    /// <summary>Number of constraints.</summary>
    public int Count;
    /// <summary>Number of them that sleep. Kept for kinematic bodies, whose constraints need not all be awake or asleep.</summary>
    public int AsleepCount;
}

/// <summary>Which constraints each body has: a ring of edges per body, in the order in which they were added.</summary>
/// <remarks>
/// There is an edge for each body of each constraint slot, and its index says which: nothing is searched for and nothing is taken from a pool when
/// constraints come and go, so a body with ten thousand of them pays no more for one than a body with two. Edges are named by constraint slots
/// and not by places in memory, so they stay what they are when bodies and constraints move.
/// </remarks>
struct ConstraintEdges
{
    struct Edge
    {
        public int Next;
        public int Previous;
    }

    Buffer<Edge> edges;
    // An edge's index is its constraint's slot, shifted by this, and which of its bodies.
    int shift;

    /// <summary>Slot of the constraint that an edge is of.</summary>
    internal readonly int ConstraintSlot(int edge) => edge >> shift;

    /// <summary>Which of its constraint's bodies an edge is of.</summary>
    internal readonly int BodySlot(int edge) => edge & (1 << shift) - 1;

    /// <summary>The edge of a body of a constraint.</summary>
    internal readonly int EdgeOf(int constraintSlot, int bodySlot) => constraintSlot << shift | bodySlot;

    /// <summary>The edge after another one; after the last of a body comes the first.</summary>
    internal readonly int Next(int edge) => edges[edge].Next;

    /// <summary>The edge before another one; before the first of a body comes the last.</summary>
    internal readonly int Previous(int edge) => edges[edge].Previous;

    /// <summary>Asks the processor to load an edge.</summary>
    internal readonly unsafe void Prefetch(int edge) => BepuUtilities.Memory.Prefetch.Read(edges.Memory + edge);

    /// <summary>Whether there is such an edge; for validation.</summary>
    internal readonly bool Contains(int edge) => (uint)edge < (uint)edges.Length;

    /// <summary>Appends the edge of a constraint to the list of its body.</summary>
    internal readonly void Add(ref ConstraintList list, int edge)
    {
        ref var added = ref edges[edge];
        if (list.Count++ == 0)
        {
            list.First = edge;
            added.Next = added.Previous = edge;
            return;
        }
        ref var first = ref edges[list.First];
        added.Next = list.First;
        added.Previous = first.Previous;
        edges[first.Previous].Next = edge;
        first.Previous = edge;
    }

    /// <summary>Takes the edge of a constraint out of the list of its body; the others keep their order.</summary>
    internal readonly void Remove(ref ConstraintList list, int edge)
    {
        Check.That(list.Count > 0);
        var removed = edges[edge];
        edges[removed.Previous].Next = removed.Next;
        edges[removed.Next].Previous = removed.Previous;
        if (list.First == edge)
            list.First = removed.Next;
        if (--list.Count == 0)
            list = default;
    }

    /// <summary>Makes room for constraint slots.</summary>
    internal void EnsureCapacity(int constraintSlots, BufferPool pool)
    {
        var previous = edges.Length;
        if (constraintSlots << shift > previous)
            pool.ResizeToAtLeast(ref edges, constraintSlots << shift, previous);
    }

    /// <summary>Makes room for a number of bodies per constraint. With more of them than before all edges have other indices.</summary>
    internal void EnsureBodiesPerConstraint(int count, Buffer<BodySet> sets, BufferPool pool)
    {
        if (1 << shift < count)
            Widen(count, sets, pool);
    }

    void Widen(int count, Buffer<BodySet> sets, BufferPool pool)
    {
        var previous = shift;
        while (1 << shift < count)
            ++shift;
        pool.TakeAtLeast<Edge>(edges.Length << shift - previous, out var renamed);
        for (int i = 0; i < edges.Length; ++i)
            renamed[Rename(i, previous)] = new() { Next = Rename(edges[i].Next, previous), Previous = Rename(edges[i].Previous, previous) };
        pool.Return(ref edges);
        edges = renamed;
        for (int i = 0; i < sets.Length; ++i)
        {
            for (int j = 0; j < sets[i].Count; ++j)
                sets[i].Constraints[j].First = Rename(sets[i].Constraints[j].First, previous);
        }
    }

    /// <summary>The index that an edge has now.</summary>
    /// <param name="edge">The index that it had.</param>
    /// <param name="previousShift">Bits that told the body of a constraint then.</param>
    readonly int Rename(int edge, int previousShift) => edge >> previousShift << shift | edge & (1 << previousShift) - 1;

    /// <param name="copy">Where to.</param>
    /// <param name="constraintSlots">Slots of constraints that were ever in use.</param>
    internal void CopyState(StateCopy copy, int constraintSlots)
    {
        copy.Value(ref shift);
        copy.Rows(ref edges, constraintSlots << shift);
    }

    internal void Dispose(BufferPool pool) => pool.Return(ref edges);
}
