using System;
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
                // By which it may come to sway.
                (link.Moves && link.IsWhole != support.IsWhole) ||
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
            pool.ReturnIfTaken(ref floors);
            order.Dispose(pool);
            leaning.Dispose(pool);
            swaying.Dispose(pool);
            Nodes.Dispose(pool);
            Links.Dispose(pool);
            Islands.Dispose(pool);
        }
        builtOf.DisposeIfTaken(pool);
        this = default;
    }
}
