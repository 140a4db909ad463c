using System;
using System.Numerics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The direction of least depth of those that there are for a child.</summary>
struct ChosenDirection
{
    /// <summary>Place of the child in the order of children.</summary>
    public int Owner;
    /// <summary>Unit direction in world axes, from B to A.</summary>
    public Vector3 Normal;
}

/// <summary>What the children of one parent after the other are joined with; grows to what the largest needs.</summary>
struct SeamMemory(BufferPool pool)
{
    /// <summary>Looks along directions.</summary>
    public DirectedTests Tests = new(pool);
    /// <summary>The children that touch.</summary>
    public QuickList<RankedChild> Ranked = new(InitialCapacity, pool);
    /// <summary>Those of them that others may yield to.</summary>
    public QuickList<int> Leaders = new(InitialCapacity, pool);
    /// <summary>Directions that triangles are looked at along.</summary>
    public QuickList<ChosenDirection> Chosen = new(InitialCapacity, pool);
    /// <summary>Contacts that patches are chosen from, a lane for each patch.</summary>
    public QuickList<FaceCandidate> Candidates = new(InitialCapacity, pool);

    /// <summary>Names of the contacts that the last reduction has chosen: a slot, times the contacts of a manifold, and a contact.</summary>
    public QuickList<int> Kept = new(InitialCapacity, pool);

    const int InitialCapacity = 16;

    /// <summary>Lists the children that touch.</summary>
    /// <returns>Whether there is one.</returns>
    public bool Rank(Span<ChildResult> results, BufferPool pool)
    {
        Ranked.Count = 0;
        for (int i = 0; i < results.Length; ++i)
        {
            if (results[i].Manifold.Count > 0)
                Ranked.Add(new RankedChild { Slot = i }, pool);
        }
        return Ranked.Count > 0;
    }

    /// <summary>Brings the children in order, and leaves out those that do not touch any more.</summary>
    public void Sort(Span<ChildResult> results)
    {
        var count = 0;
        for (int i = 0; i < Ranked.Count; ++i)
        {
            var child = Ranked[i];
            ref var manifold = ref results[child.Slot].Manifold;
            if (manifold.Count == 0)
                continue;
            child.Depth = manifold.GetDepth(0);
            for (int j = 1; j < manifold.Count; ++j)
                child.Depth = Math.Max(child.Depth, manifold.GetDepth(j));
            child.Overlap = RankedChild.Unknown;
            Ranked[count++] = child;
        }
        Ranked.Count = count;
        if (count < 2)
            return;
        var order = new RankedChild.Order();
        QuickSort.Sort(Ranked.Span, count, ref order);
    }

    /// <summary>Patch of a contact, by its name.</summary>
    public readonly int PatchOf(int name)
    {
        foreach (ref var child in Ranked.AsSpan())
        {
            if (child.Slot == name / ConvexContactManifold.MaximumContactCount)
                return child.Patch;
        }
        return -1;
    }

    public void Dispose(BufferPool pool)
    {
        Tests.Dispose(pool);
        Ranked.Dispose(pool);
        Leaders.Dispose(pool);
        Chosen.Dispose(pool);
        Candidates.Dispose(pool);
        Kept.Dispose(pool);
    }
}
