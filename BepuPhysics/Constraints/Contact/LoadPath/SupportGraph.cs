using System;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Which bodies rest on which, from what does not move upwards, island by island.</summary>
/// <remarks>
/// Built from constraints in the order in which they are swept: nothing depends on threads or the width of vectors but the order of constraints, which
/// does not either. One thread says who comes where, from the little that this takes, and where that little is what it was a step ago, as in all that
/// stands, so is the graph. The links follow node by node.
/// </remarks>
unsafe partial struct SupportGraph
{
    // What has to be known of a link until it has its place.
    struct Support
    {
        // Its place among those that were found.
        public int Found;
        public int Upper;
        public int Lower;
        public byte CarryingCount;
        public bool Slides;
        public bool Leans;
        public bool IsSpoilt;
        public bool Moves;
        public bool Sways;
        public bool IsWhole;
        public bool WasHeld;
        public bool Carries;
    }

    // Supports by upper body.
    Buffer<Support> byUpper;
    // Per body of the active set, all of one length.
    Buffer<int> positions;
    Buffer<int> waiting;
    // Supports that carry.
    Buffer<int> carrying;
    Buffer<int> starts;
    Buffer<int> above;
    Buffer<int> islandOf;
    Buffer<byte> grounded;
    // Whether anything rests on a kinematic body that moves.
    bool hasFloors;
    // Per body that has its place in the order: what carries it, as in the place of a lower body, or None. Allocated only if there is any floor.
    Buffer<int> floors;
    // Support with the same lower body that follows, by index in the order of upper bodies.
    Buffer<int> nextAbove;
    QuickList<int> order;
    // Supports that lean, by index in the order of upper bodies.
    QuickList<int> leaning;
    // Supports of bodies that may sway, by index in the order of upper bodies.
    QuickList<int> swaying;
    // What the graph was built of, beside the supports: it is the same of the same.
    QuickList<(int Start, int Count)> builtOf;
    int builtBodyCount;
    // Heights and velocities change in each step.
    bool dependsOnMotion;

    /// <summary>Bodies, island after island, in each from the ground upwards.</summary>
    internal QuickList<LoadNode> Nodes;
    /// <summary>What carries them, body after body, in the order of the nodes.</summary>
    internal QuickList<SupportLink> Links;
    /// <summary>Where the nodes of each island begin, and where those of the last one end.</summary>
    internal QuickList<int> Islands;
    /// <summary>Whether any bodies may lean on each other, or sway.</summary>
    internal readonly bool MayRelaxAny => leaning.Count > 0 || swaying.Count > 0;
    /// <summary>Whether any island is small enough to be relaxed if it tips over.</summary>
    internal bool MayTipAny;
    /// <summary>Most bodies of an island that may be a column; zero if none may.</summary>
    internal int LongestColumn;
    /// <summary>Node of each body of the active set; negative where it is none.</summary>
    internal Buffer<int> NodeOf;

    /// <summary>Arranges what was found to carry a body. Links, and radii of nodes, are still to be filled in.</summary>
    /// <param name="found">What was found.</param>
    /// <param name="pieces">Which of that is in use.</param>
    /// <param name="bodyCount">Bodies of the active set.</param>
    /// <param name="spoilt">Not zero for each body that something unknown pushes from the side.</param>
    /// <param name="motions">Height of each body, in any unit, by which a circle of supports is cut, and who rests on what moves.</param>
    /// <param name="pool">Source of memory, until <see cref="Dispose"/>.</param>
    /// <param name="byHandle">
    /// The bodies in the order of their handles; nothing where they lie in it. Where others have gone they do not, and in which place one lies then depends on
    /// bodies that it has nothing to do with.
    /// </param>
    internal void Build<TMotions>(SupportLink* found, ReadOnlySpan<(int Start, int Count)> pieces, int bodyCount, Buffer<byte> spoilt, TMotions motions,
        BufferPool pool, Buffer<int> byHandle = default)
        where TMotions : struct, IHeights, IFloors
    {
        if (!byHandle.Allocated && IsBuiltOf(found, pieces, bodyCount, spoilt))
            return;
        Dispose(pool);
        var count = 0;
        foreach (var piece in pieces)
            count += piece.Count;
        Take(count, bodyCount, pool);
        SortByUpper(found, pieces, bodyCount, spoilt, pool);
        LinkAbove(bodyCount, byHandle, pool);
        if (hasFloors)
            pool.TakeAtLeast(bodyCount, out floors);
        OrderUpwards(bodyCount, byHandle, motions, pool);
        if (swaying.Count > 0)
        {
            FindSwaying(found, bodyCount, motions, pool);
            FindStructures(found, motions, pool);
            waiting.Clear(0, bodyCount);
        }
        if (leaning.Count > 0)
            FindLeaning(motions, pool);
        MakeNodes(bodyCount, pool);
        builtOf = new QuickList<(int, int)>(pieces.Length, pool);
        foreach (var piece in pieces)
            builtOf.AddUnsafely(piece);
        builtBodyCount = bodyCount;
    }

    // The supports lie by their upper body, each with its place among those found: no two have the same, so they are all.
    readonly bool IsBuiltOf(SupportLink* found, ReadOnlySpan<(int Start, int Count)> pieces, int bodyCount, Buffer<byte> spoilt)
    {
        if (!builtOf.Span.Allocated || dependsOnMotion || bodyCount != builtBodyCount || !builtOf.AsSpan().SequenceEqual(pieces))
            return false;
        for (int i = 0; i < starts[bodyCount]; ++i)
        {
            ref var support = ref byUpper[i];
            ref var link = ref found[support.Found];
            if (link.Upper != support.Upper || link.Lower != support.Lower || link.CarryingCount != support.CarryingCount ||
                link.Slides != support.Slides || link.Leans != support.Leans || link.Moves != support.Moves || link.Sways != support.Sways ||
                (link.Leans && IsSpoilt(link, spoilt) != support.IsSpoilt))
            {
                return false;
            }
        }
        return true;
    }

    void Take(int linkCount, int bodyCount, BufferPool pool)
    {
        var atLeastOne = Math.Max(1, linkCount);
        pool.TakeAtLeast(atLeastOne, out byUpper);
        pool.TakeAtLeast(atLeastOne, out nextAbove);
        Links = new QuickList<SupportLink>(atLeastOne, pool);
        pool.TakeAtLeast(bodyCount, out positions);
        pool.TakeAtLeast(bodyCount, out waiting);
        pool.TakeAtLeast(bodyCount, out carrying);
        pool.TakeAtLeast(bodyCount + 1, out starts);
        pool.TakeAtLeast(bodyCount, out above);
        pool.TakeAtLeast(bodyCount, out islandOf);
        pool.TakeAtLeast(bodyCount, out NodeOf);
        pool.TakeAtLeast(bodyCount, out grounded);
        order = new QuickList<int>(Math.Max(1, bodyCount), pool);
        leaning = new QuickList<int>(16, pool);
        swaying = new QuickList<int>(16, pool);
        for (int i = 0; i < bodyCount; ++i)
            positions[i] = above[i] = NodeOf[i] = -1;
        waiting.Clear(0, bodyCount);
        carrying.Clear(0, bodyCount);
        starts.Clear(0, bodyCount + 1);
        grounded.Clear(0, bodyCount);
    }

    // By counting, so that supports of one body stay in the order in which they were found.
    void SortByUpper(SupportLink* found, ReadOnlySpan<(int Start, int Count)> pieces, int bodyCount, Buffer<byte> spoilt, BufferPool pool)
    {
        foreach (var piece in pieces)
        {
            for (int i = piece.Start; i < piece.Start + piece.Count; ++i)
                ++starts[found[i].Upper + 1];
        }
        for (int i = 0; i < bodyCount; ++i)
            starts[i + 1] += starts[i];
        pool.TakeAtLeast<int>(Math.Max(1, bodyCount), out var next);
        starts.CopyTo(0, next, 0, bodyCount);
        foreach (var piece in pieces)
        {
            for (int i = piece.Start; i < piece.Start + piece.Count; ++i)
            {
                ref var link = ref found[i];
                hasFloors |= link.Lower < SupportLink.Still;
                byUpper[next[link.Upper]++] = new()
                {
                    Found = i,
                    Upper = link.Upper,
                    Lower = link.Lower,
                    CarryingCount = (byte)link.CarryingCount,
                    Slides = link.Slides,
                    Leans = link.Leans,
                    Moves = link.Moves,
                    Sways = link.Sways,
                    IsWhole = link.IsWhole,
                    WasHeld = link.WasHeld,
                    IsSpoilt = link.Leans && IsSpoilt(link, spoilt),
                };
            }
        }
        pool.Return(ref next);
    }

    void LinkAbove(int bodyCount, Buffer<int> byHandle, BufferPool pool)
    {
        for (int i = bodyCount - 1; i >= 0; --i)
        {
            var body = byHandle.Allocated ? byHandle[i] : i;
            for (int j = starts[body + 1] - 1; j >= starts[body]; --j)
                LinkAbove(j, pool);
        }
    }

    void LinkAbove(int i, BufferPool pool)
    {
        var lower = byUpper[i].Lower;
        if (byUpper[i].Leans)
            leaning.Add(i, pool);
        else if (byUpper[i].Sways || (byUpper[i].IsWhole && byUpper[i].Moves))
            swaying.Add(i, pool);
        if (lower < 0 || byUpper[i].Leans || byUpper[i].Sways)
            return;
        ++waiting[byUpper[i].Upper];
        nextAbove[i] = above[lower];
        above[lower] = i;
    }

    // A body comes after all that it rests on. Where bodies rest on each other in a circle, the lowest that is left comes next.
    void OrderUpwards<TMotions>(int bodyCount, Buffer<int> byHandle, TMotions motions, BufferPool pool) where TMotions : struct, IHeights, IFloors
    {
        dependsOnMotion = hasFloors || swaying.Count > 0 || byHandle.Allocated;
        int participants = 0;
        for (int place = 0; place < bodyCount; ++place)
        {
            var i = byHandle.Allocated ? byHandle[place] : place;
            if (above[i] < 0 && starts[i + 1] == starts[i])
                continue;
            ++participants;
            if (waiting[i] == 0)
                order.Add(i, pool);
        }
        Buffer<int> byHeight = default;
        int lowest = 0;
        for (int taken = 0; taken < participants; ++taken)
        {
            if (taken == order.Count)
            {
                dependsOnMotion = true;
                if (!byHeight.Allocated)
                    SortByHeight(bodyCount, motions, pool, out byHeight);
                while (positions[byHeight[lowest]] >= 0 || waiting[byHeight[lowest]] == 0)
                    ++lowest;
                waiting[byHeight[lowest]] = 0;
                order.Add(byHeight[lowest], pool);
            }
            var body = order[taken];
            positions[body] = taken;
            grounded[body] = IsGrounded(body, motions) ? (byte)1 : (byte)0;
            for (int i = above[body]; i >= 0; i = nextAbove[i])
            {
                var upper = byUpper[i].Upper;
                if (positions[upper] < 0 && waiting[upper] > 0 && --waiting[upper] == 0)
                    order.Add(upper, pool);
            }
        }
        if (byHeight.Allocated)
            pool.Return(ref byHeight);
    }

    static void SortByHeight<THeights>(int bodyCount, THeights heights, BufferPool pool, out Buffer<int> byHeight) where THeights : struct, IHeights
    {
        pool.Take(bodyCount, out byHeight);
        pool.Take<HeightOfBody>(bodyCount, out var keys);
        for (int i = 0; i < bodyCount; ++i)
            keys[i] = new() { Height = heights.Of(i), Body = i };
        var lowestFirst = default(LowestFirst);
        QuickSort.Sort(new Span<HeightOfBody>(keys.Memory, bodyCount), ref lowestFirst);
        for (int i = 0; i < bodyCount; ++i)
            byHeight[i] = keys[i].Body;
        pool.Return(ref keys);
    }

    struct HeightOfBody
    {
        public float Height;
        public int Body;
    }

    struct LowestFirst : IComparerRef<HeightOfBody>
    {
        public readonly int Compare(ref HeightOfBody a, ref HeightOfBody b) => a.Height != b.Height ? a.Height.CompareTo(b.Height) : a.Body.CompareTo(b.Body);
    }

    // What slides on all that it rests on moves.
    readonly bool IsGrounded<TMotions>(int body, TMotions motions) where TMotions : struct, IFloors
    {
        if (hasFloors)
            floors[body] = FloorOf(body, motions);
        int contacts = 0;
        var slides = true;
        for (int i = starts[body]; i < starts[body + 1]; ++i)
        {
            if (byUpper[i].Leans || !Carries(byUpper[i]))
                continue;
            contacts += byUpper[i].CarryingCount;
            slides &= byUpper[i].Slides;
        }
        return contacts >= SupportFinder.LeastContacts && !slides;
    }

    // What is below must itself be carried, and come earlier: what comes later hands its own load on too late.
    readonly bool Carries(in Support support) => !support.Sways && IsBelow(support) && (hasFloors ? SharesFloor(support) : !support.Moves);

    readonly bool IsBelow(in Support support) => support.Lower < 0 ||
        (grounded[support.Lower] != 0 && positions[support.Lower] < positions[support.Upper]);

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
            // Nothing is left of the last step.
            node = new()
            {
                Body = node.Body,
                Floor = node.Floor,
                FirstSupport = node.FirstSupport,
                SupportCount = node.SupportCount,
                Leans = node.Leans,
                IsOfStructure = node.IsOfStructure,
                IsRelaxed = node.IsRelaxed,
                IsOfColumn = node.IsOfColumn,
                MayBeColumn = node.MayBeColumn,
            };
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

    /// <summary>Island of a node.</summary>
    internal readonly int IslandOf(int node)
    {
        // Some begins at the node or is the last that begins before it: none is empty.
        var found = ((ReadOnlySpan<int>)new Span<int>(Islands.Span.Memory, Islands.Count)).BinarySearch(node);
        return found >= 0 ? found : ~found - 1;
    }

    /// <summary>Gives all memory back; nothing is in the graph.</summary>
    internal void Dispose(BufferPool pool)
    {
        if (order.Span.Allocated)
        {
            pool.Return(ref byUpper);
            pool.Return(ref positions);
            pool.Return(ref waiting);
            pool.Return(ref carrying);
            pool.Return(ref starts);
            pool.Return(ref above);
            pool.Return(ref islandOf);
            pool.Return(ref NodeOf);
            pool.Return(ref grounded);
            pool.Return(ref nextAbove);
            if (floors.Allocated)
                pool.Return(ref floors);
            order.Dispose(pool);
            leaning.Dispose(pool);
            swaying.Dispose(pool);
            Nodes.Dispose(pool);
            Links.Dispose(pool);
            Islands.Dispose(pool);
        }
        if (builtOf.Span.Allocated)
            builtOf.Dispose(pool);
        this = default;
    }
}
