using System;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What sets of children are joined with, of several parents or bodies at once; grows from nothing to what they need.</summary>
struct SeamMemory
{
    /// <summary>Looks along directions.</summary>
    public DirectedTests Tests;
    /// <summary>Looks where contacts that are foreseen will be.</summary>
    public MovedTests Moved;
    /// <summary>The sets that agree at once, so that bundles of tests are full.</summary>
    public QuickList<SeamSet> Sets;
    /// <summary>The children that touch, of all sets.</summary>
    public QuickList<RankedChild> Touching;
    /// <summary>Of triangles of surfaces among them: along which directions they are touched.</summary>
    public QuickList<TouchedDirection> Directions;
    /// <summary>Those that patches are made of, in their order.</summary>
    public QuickList<RankedChild> Ranked;
    /// <summary>Contacts with planes in place of flush faces.</summary>
    public QuickList<DirectedPair> Planes;
    /// <summary>Contacts that are chosen from, a lane for each patch.</summary>
    public QuickList<FaceCandidate> Candidates;
    /// <summary>What of the contacts of one of these is asked for.</summary>
    public QuickList<ReducedContact> Contacts;
    /// <summary>Patches of which contacts are chosen, in the order of their pairs.</summary>
    public QuickList<ReducedPatch> Reduced;

    /// <summary>
    /// Number of sets of parents that are worked on at once. Tests of a round are of up to 21 pairs of shape types, and each has bundles of its own: the more
    /// sets, the fuller these are.
    /// </summary>
    public const int SetCapacity = 64;

    /// <summary>Number of bodies that agree at once: some bundles of tests in each round, and shapes that fit a cache.</summary>
    public const int BodyCapacity = 16;

    /// <summary>Forgets all sets.</summary>
    public void Begin() => Sets.Count = Touching.Count = 0;

    /// <summary>Adds the children of a parent, as they were found.</summary>
    /// <param name="results">What was found for each.</param>
    /// <param name="placed">Where each is.</param>
    /// <param name="count">Number of them.</param>
    /// <param name="owner">What they are of.</param>
    /// <param name="leavesToNeighbours">Whether there are triangles beside these of which what is near is a neighbour's.</param>
    /// <param name="pool">Source of memory.</param>
    public unsafe void Add(ChildResult* results, PlacedChildren* placed, int count, int owner, bool leavesToNeighbours, BufferPool pool)
    {
        Touching.EnsureCapacity(SetCapacity * 4, pool);
        Sets.EnsureCapacity(SetCapacity, pool);
        // Where it stays, and without what nobody reads before it is written.
        ref var set = ref Sets.Allocate(pool);
        set.Owner = owner;
        set.Results = results;
        set.Placed = placed;
        set.First = Touching.Count;
        set.Index = -1;
        set.LeaderCount = set.LastLeader = 0;
        set.Tests = default;
        set.HasForeseen = set.IsOnPlane = false;
        set.LeavesToNeighbours = leavesToNeighbours;
        var hasTriangle = false;
        for (int i = 0; i < count; ++i)
        {
            if (results[i].Manifold.Count == 0)
                continue;
            ref var child = ref Touching.Allocate(pool);
            child = default;
            child.Slot = i;
            hasTriangle |= placed[i].TypeA == Triangle.Id || placed[i].TypeB == Triangle.Id;
        }
        set.Count = Touching.Count - set.First;
        set.Stage = set.Count == 0 ? SeamStage.Done : hasTriangle ? SeamStage.DirectionsOfB : SeamStage.Order;
    }

    /// <summary>Adds a set.</summary>
    public void Add(in SeamSet set, BufferPool pool)
    {
        Sets.EnsureCapacity(SetCapacity, pool);
        Sets.Add(set, pool);
    }

    /// <summary>The children of a set that touch.</summary>
    public readonly Span<RankedChild> TouchingOf(in SeamSet set) => Touching.AsSpan().Slice(set.First, set.Count);

    /// <summary>Makes the children of a set those that patches are made of.</summary>
    public void Rank(Span<RankedChild> children, BufferPool pool)
    {
        Ranked.Count = 0;
        Ranked.EnsureCapacity(children.Length, pool);
        foreach (ref var child in children)
            Ranked.AddUnsafely(child);
    }

    /// <summary>Brings children in order, and leaves out those that do not touch any more.</summary>
    /// <param name="children">The children; those that touch come first then.</param>
    /// <param name="results">What was found for each child.</param>
    /// <returns>Number of those that touch.</returns>
    public static unsafe int Sort(Span<RankedChild> children, ChildResult* results)
    {
        var count = 0;
        for (int i = 0; i < children.Length; ++i)
        {
            var child = children[i];
            ref var manifold = ref results[child.Slot].Manifold;
            if (manifold.Count == 0)
                continue;
            child.Depth = manifold.GetDepth(0);
            for (int j = 1; j < manifold.Count; ++j)
                child.Depth = Math.Max(child.Depth, manifold.GetDepth(j));
            child.Overlap = RankedChild.Unknown;
            children[count++] = child;
        }
        if (count < 2)
            return count;
        var order = new RankedChild.Order();
        QuickSort.Sort(children[..count], ref order);
        return count;
    }

    public void Dispose(BufferPool pool)
    {
        Tests.Dispose(pool);
        Moved.Dispose(pool);
        Sets.DisposeIfTaken(pool);
        Touching.DisposeIfTaken(pool);
        Directions.DisposeIfTaken(pool);
        Ranked.DisposeIfTaken(pool);
        Planes.DisposeIfTaken(pool);
        Candidates.DisposeIfTaken(pool);
        Contacts.DisposeIfTaken(pool);
        Reduced.DisposeIfTaken(pool);
    }
}
