using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Pairs that may have to do with each other within a step: those of one body that moves, and those of its neighbours, and so on.</summary>
// What happens in one group changes nothing in another. So each has its impacts made in the order of their times by itself, and many threads make those of
// many groups: the same impacts as in the order of all times.
struct ImpactGroups(BufferPool pool)
{
    // From how many pairs on a block ends.
    const int PairsPerBlock = 16;

    // First pair of each body of the active set; -1 for none.
    QuickList<int> firstOfBody = new(16, pool);
    // Pairs by groups, in the order of the list within each; the groups are in the order of their first pairs.
    QuickList<int> members = new(16, pool);
    // Of each pair: one of its group that comes before it, or itself; then the number of its group.
    QuickList<int> leaders = new(16, pool);
    // Where each group begins in the members, and where the last one ends.
    QuickList<int> starts = new(16, pool);
    // First pair of each structure of joints; -1 for none.
    QuickList<int> firstOfStructure = new(4, pool);
    // Where each block begins in the groups, and where the last one ends.
    QuickList<int> blocks = new(4, pool);

    internal void Dispose()
    {
        firstOfBody.Dispose(pool);
        members.Dispose(pool);
        leaders.Dispose(pool);
        starts.Dispose(pool);
        firstOfStructure.Dispose(pool);
        blocks.Dispose(pool);
    }

    /// <summary>At most as many blocks as there are of a number of pairs.</summary>
    internal static int MostBlocks(int pairCount) => (pairCount + PairsPerBlock - 1) / PairsPerBlock;

    /// <summary>Number of blocks of groups.</summary>
    internal readonly int BlockCount => blocks.Count - 1;

    /// <summary>First group of a block; that of the block after it is where it ends.</summary>
    internal readonly int FirstGroup(int block) => blocks[block];

    /// <summary>Number of pairs of a group.</summary>
    internal readonly int CountOf(int group) => starts[group + 1] - starts[group];

    /// <summary>A pair of a group.</summary>
    internal readonly int Pair(int group, int index) => members[starts[group] + index];

    /// <summary>First pair of a body, or -1.</summary>
    internal readonly int FirstOf(int body) => firstOfBody[body];

    /// <summary>Links pairs to their bodies, and finds the groups.</summary>
    internal void Link(ref QuickList<BouncingPair> pairs, int bodyCount, ImpactStructures structures)
    {
        Resize(ref firstOfBody, bodyCount);
        firstOfBody.AsSpan().Fill(-1);
        Resize(ref leaders, pairs.Count);
        for (int i = pairs.Count - 1; i >= 0; --i)
        {
            ref var pair = ref pairs[i];
            leaders[i] = i;
            pair.NextOfA = Link(pair.A, i);
            if (pair.B >= 0)
                pair.NextOfB = Link(pair.B, i);
        }
        if (!structures.IsEmpty)
            LinkStructures(ref pairs, structures);
        Gather(pairs.Count);
        Divide();
    }

    // Pairs of bodies that hang together by joints have to do with each other, too.
    void LinkStructures(ref QuickList<BouncingPair> pairs, ImpactStructures structures)
    {
        Resize(ref firstOfStructure, structures.Count);
        firstOfStructure.AsSpan().Fill(-1);
        for (int i = 0; i < pairs.Count; ++i)
        {
            ref var pair = ref pairs[i];
            var (islandA, islandB) = structures.IslandsOf(pair);
            pair.IsInStructure = islandA >= 0 || islandB >= 0;
            pair.Hangs = !pair.Bears && structures.Hangs(islandA) && structures.Hangs(islandB);
            LinkStructure(islandA, i);
            LinkStructure(islandB, i);
        }
    }

    readonly void LinkStructure(int island, int pair)
    {
        if (island < 0)
            return;
        if (firstOfStructure[island] < 0)
            firstOfStructure[island] = pair;
        else
            Join(LeaderOf(firstOfStructure[island]), LeaderOf(pair));
    }

    int Link(int body, int pair)
    {
        var next = firstOfBody[body];
        firstOfBody[body] = pair;
        if (next >= 0)
            Join(LeaderOf(next), LeaderOf(pair));
        return next;
    }

    // The first of a group leads it.
    readonly void Join(int a, int b)
    {
        if (a < b)
            leaders[b] = a;
        else
            leaders[a] = b;
    }

    readonly int LeaderOf(int pair)
    {
        while (leaders[pair] != pair)
        {
            leaders[pair] = leaders[leaders[pair]];
            pair = leaders[pair];
        }
        return pair;
    }

    void Gather(int pairCount)
    {
        starts.Count = 0;
        // Each leader comes before the others of its group, and so has its number before they ask.
        for (int i = 0; i < pairCount; ++i)
        {
            if (leaders[i] == i)
            {
                leaders[i] = starts.Count;
                starts.Add(0, pool);
            }
            else
            {
                leaders[i] = leaders[leaders[i]];
            }
            ++starts[leaders[i]];
        }
        starts.Add(0, pool);
        var end = 0;
        for (int i = 0; i < starts.Count; ++i)
        {
            end += starts[i];
            starts[i] = end;
        }
        // From the last one on, so that the ends become the starts.
        Resize(ref members, pairCount);
        for (int i = pairCount - 1; i >= 0; --i)
            members[--starts[leaders[i]]] = i;
    }

    void Divide()
    {
        blocks.Count = 0;
        blocks.Add(0, pool);
        for (int group = 0, begin = 0; group < starts.Count - 1; ++group)
        {
            if (starts[group + 1] - begin < PairsPerBlock && group < starts.Count - 2)
                continue;
            begin = starts[group + 1];
            blocks.Add(group + 1, pool);
        }
    }

    readonly void Resize(ref QuickList<int> list, int count)
    {
        list.EnsureCapacity(count, pool);
        list.Count = count;
    }
}
