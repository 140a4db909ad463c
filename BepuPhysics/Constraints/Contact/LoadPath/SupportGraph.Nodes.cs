using System;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// What is carried, island by island.
unsafe partial struct SupportGraph
{
    void MakeNodes(int bodyCount, BufferPool pool)
    {
        // Islands by the first of their bodies in the order.
        for (int i = 0; i < order.Count; ++i)
            islandOf[order[i]] = order[i];
        for (int i = 0; i < starts[bodyCount]; ++i)
        {
            ref var support = ref byUpper[i];
            if (!support.Leans && grounded[support.Upper] < OfColumn)
                support.Carries = Carries(support);
            if (!support.Carries)
                continue;
            ++carrying[support.Upper];
            if (support.Lower < 0)
                continue;
            var a = DisjointSets.Root(islandOf, support.Upper);
            var b = DisjointSets.Root(islandOf, support.Lower);
            if (positions[a] < positions[b])
                islandOf[b] = a;
            else
                islandOf[a] = b;
        }
        // Place of each island, plus one, at its root; then a counting sort of the bodies.
        Nodes = new QuickList<LoadNode>(Math.Max(1, order.Count), pool);
        Islands = new QuickList<int>(16, pool);
        pool.TakeAtLeast<int>(Math.Max(1, bodyCount), out var place);
        int islandCount = 0;
        for (int i = 0; i < order.Count; ++i)
        {
            if (grounded[order[i]] != 0 && DisjointSets.Root(islandOf, order[i]) == order[i])
                place[order[i]] = islandCount++;
        }
        for (int i = 0; i <= islandCount; ++i)
            Islands.Add(0, pool);
        int nodeCount = 0;
        for (int i = 0; i < order.Count; ++i)
        {
            if (grounded[order[i]] == 0)
                continue;
            ++Islands[place[DisjointSets.Root(islandOf, order[i])] + 1];
            ++nodeCount;
        }
        for (int i = 0; i < islandCount; ++i)
            Islands[i + 1] += Islands[i];
        Nodes.Count = nodeCount;
        pool.TakeAtLeast<int>(Math.Max(1, islandCount), out var next);
        Islands.Span.CopyTo(0, next, 0, islandCount);
        for (int i = 0; i < order.Count; ++i)
        {
            if (grounded[order[i]] == 0)
                continue;
            var node = next[place[DisjointSets.Root(islandOf, order[i])]]++;
            NodeOf[order[i]] = node;
            Nodes[node] = new()
            {
                Body = order[i],
                Floor = hasFloors ? SupportLink.Floor(floors[order[i]]) : -1,
                Leans = grounded[order[i]] is Leans or OfColumn,
                IsOfStructure = grounded[order[i]] == OfStructure,
                IsOfColumn = grounded[order[i]] == OfColumn,
            };
        }
        if (leaning.Count > 0 || swaying.Count > 0)
            FindRelaxed(islandCount);
        pool.Return(ref next);
        pool.Return(ref place);
        // Links that carry, in the order of the nodes.
        for (int i = 0; i < nodeCount; ++i)
        {
            ref var node = ref Nodes[i];
            node.FirstSupport = Links.Count;
            node.SupportCount = carrying[node.Body];
            Links.Count += node.SupportCount;
        }
        FindSingle(islandCount);
    }

    /// <summary>Fills in the links of some nodes, and how far their contacts are from their centres; nodes are independent of each other.</summary>
    /// <param name="found">What was found.</param>
    /// <param name="start">The first of the nodes.</param>
    /// <param name="end">One after the last.</param>
    internal void Fill(SupportLink* found, int start, int end)
    {
        for (int i = start; i < end; ++i)
        {
            ref var node = ref Nodes[i];
            node.Begin();
            var link = node.FirstSupport;
            for (int j = starts[node.Body]; j < starts[node.Body + 1]; ++j)
            {
                ref var support = ref byUpper[j];
                if (!support.Carries)
                    continue;
                Links[link] = found[support.Found];
                node.Radius = MathHelper.Max(node.Radius, Links[link++].Radius);
            }
        }
    }

    /// <summary>How often the links that carry a body name a body: each is a constraint of its upper body, and of the lower one if it has any.</summary>
    internal readonly int CountEnds(int body)
    {
        int count = 0;
        for (int i = starts[body]; i < starts[body + 1]; ++i)
        {
            if (byUpper[i].Carries)
                count += byUpper[i].Lower >= 0 ? 2 : 1;
        }
        return count;
    }

    /// <summary>How many of the links that carry anything rest on a body.</summary>
    internal readonly int CountAbove(int body)
    {
        int count = 0;
        for (int i = above[body]; i >= 0; i = nextAbove[i])
            count += byUpper[i].Carries ? 1 : 0;
        return count;
    }

    /// <summary>Island of a node.</summary>
    internal readonly int IslandOf(int node)
    {
        // Some begins at the node or is the last that begins before it: none is empty.
        var found = ((ReadOnlySpan<int>)new Span<int>(Islands.Span.Memory, Islands.Count)).BinarySearch(node);
        return found >= 0 ? found : ~found - 1;
    }
}
