using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>What a body is to the search for islands.</summary>
enum RestKind : byte
{
    /// <summary>Keeps every island awake that a constraint connects with it.</summary>
    Holds,
    /// <summary>A kinematic body at rest: connects nothing and holds nobody.</summary>
    Fixed,
    /// <summary>A dynamic body that may sleep.</summary>
    Rests,
}

/// <summary>
/// Groups of dynamic bodies that constraints connect, contacts included, all of which may sleep: nothing that happens to one group reaches
/// another before collisions are detected again.
/// </summary>
/// <remarks>
/// Found when somebody asks, and kept by nobody while the bodies are awake. Kinematic bodies and statics connect nothing, as no impulse goes through
/// them. Islands are in the order of their lowest slots, the bodies of each in the order of theirs: neither depends on places in memory, threads or the
/// order of constraints.
/// </remarks>
// One sweep over all constraints, in the order of memory, at 2 ns each: following the edges of the bodies at rest alone would wait for memory at every
// one of them, and only be cheaper where very few rest.
readonly unsafe struct IslandSearch
{
    const int Held = -1;

    // Island after island.
    readonly Buffer<int> slots;
    // Where each island begins, and where the last one ends.
    readonly Buffer<int> starts;

    /// <summary>Number of islands.</summary>
    internal readonly int Count;

    /// <summary>Number of bodies of all islands.</summary>
    internal readonly int BodyCount => starts[Count];

    /// <summary>Slots of the bodies of an island.</summary>
    internal readonly ReadOnlySpan<int> SlotsOf(int island) => new(slots.Memory + starts[island], starts[island + 1] - starts[island]);

    /// <summary>Finds the islands of the active set.</summary>
    /// <param name="all">The bodies.</param>
    /// <param name="solver">Their constraints.</param>
    /// <param name="kinds">What each body of the active set is to the search.</param>
    /// <param name="pool">Source of memory, until <see cref="Dispose"/>.</param>
    internal IslandSearch(Bodies all, Solver solver, in Buffer<RestKind> kinds, BufferPool pool)
    {
        ref var set = ref all.Awake;
        var room = Math.Max(1, set.Count);
        pool.TakeAtLeast<int>(room, out var parents);
        // By root: the lowest slot of an island, or that something holds it; and how many bodies it has.
        pool.TakeAtLeast<int>(room, out var lowest);
        pool.TakeAtLeast<int>(room, out var sizes);
        DisjointSets.Begin(parents, set.Count);
        lowest.AsSpan()[..set.Count].Fill(int.MaxValue);
        sizes.Clear(0, set.Count);
        Connect(solver, kinds, parents, lowest);
        int islandCount = 0;
        for (int i = 0; i < set.Count; ++i)
        {
            if (kinds[i] != RestKind.Rests)
                continue;
            var root = DisjointSets.Root(parents, i);
            // A body that is held passes it on to its island.
            lowest[root] = Math.Min(lowest[root], Math.Min(lowest[i], set.IndexToHandle[i].Slot));
            ++sizes[root];
            islandCount += root == i ? 1 : 0;
        }
        pool.TakeAtLeast<ulong>(Math.Max(1, islandCount), out var order);
        islandCount = 0;
        for (int i = 0; i < set.Count; ++i)
        {
            if (kinds[i] == RestKind.Rests && parents[i] == i && lowest[i] != Held)
                order[islandCount++] = (ulong)lowest[i] << 32 | (uint)i;
        }
        if (islandCount > 0)
            order.AsSpan()[..islandCount].Sort();
        pool.TakeAtLeast(islandCount + 1, out starts);
        starts[0] = 0;
        // From here on the size of an island is where its next body comes; negative for those that are held.
        if (islandCount > 0)
        {
            sizes.CopyTo(0, lowest, 0, set.Count);
            sizes.AsSpan()[..set.Count].Fill(-1);
        }
        while (Count < islandCount)
        {
            var root = (int)(uint)order[Count];
            sizes[root] = starts[Count];
            starts[Count + 1] = starts[Count] + lowest[root];
            ++Count;
        }
        pool.TakeAtLeast(Math.Max(1, starts[Count]), out slots);
        for (int i = 0; i < set.Count && Count > 0; ++i)
        {
            if (kinds[i] != RestKind.Rests)
                continue;
            ref var next = ref sizes[DisjointSets.Root(parents, i)];
            if (next >= 0)
                slots[next++] = set.IndexToHandle[i].Slot;
        }
        for (int i = 0; i < Count; ++i)
            new Span<int>(slots.Memory + starts[i], starts[i + 1] - starts[i]).Sort();
        pool.Return(ref order);
        pool.Return(ref parents);
        pool.Return(ref lowest);
        pool.Return(ref sizes);
    }

    static void Connect(Solver solver, in Buffer<RestKind> kinds, Buffer<int> parents, Buffer<int> lowest)
    {
        ref var batches = ref solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            for (int j = 0; j < batches[i].TypeBatches.Count; ++j)
            {
                ref var typeBatch = ref batches[i].TypeBatches[j];
                var bodyCount = solver.Processor(typeBatch.TypeId).BodiesPerConstraint;
                // One on a single body connects nothing.
                if (bodyCount == 1)
                    continue;
                var references = typeBatch.BodyReferences.Memory;
                for (int k = 0; k < typeBatch.ConstraintCount; k += Vector<int>.Count, references += Vector<int>.Count * bodyCount)
                {
                    var end = Math.Min(Vector<int>.Count, typeBatch.ConstraintCount - k);
                    for (int lane = 0; lane < end; ++lane)
                        Connect(references + lane, bodyCount, kinds, parents, lowest);
                }
            }
        }
    }

    // The bodies of a constraint are a bundle apart.
    static void Connect(int* references, int bodyCount, in Buffer<RestKind> kinds, Buffer<int> parents, Buffer<int> lowest)
    {
        var joined = -1;
        var holds = false;
        for (int slot = 0; slot < bodyCount; ++slot)
        {
            var index = references[slot * Vector<int>.Count] & EncodedBody.IndexMask;
            holds |= kinds[index] == RestKind.Holds;
            if (kinds[index] != RestKind.Rests)
                continue;
            joined = DisjointSets.JoinNext(parents, joined, index);
        }
        // Whoever is held is in the same island as the root, be it one itself by then or not.
        if (holds && joined >= 0)
            lowest[joined] = Held;
    }

    internal void Dispose(BufferPool pool)
    {
        var lent = slots;
        pool.Return(ref lent);
        lent = starts;
        pool.Return(ref lent);
    }
}
