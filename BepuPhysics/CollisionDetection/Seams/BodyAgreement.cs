using System;
using System.Numerics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Makes all pairs of one body with what does not give way agree on their normals, as the children of one pair do.</summary>
/// <remarks>
/// Two statics side by side are to a body what two children of one static are (<see cref="ChildAgreement"/>). The children of each pair have agreed among
/// themselves when they come here; those of different pairs agree where they touch the same child of the body.
/// </remarks>
struct BodyAgreement(BufferPool pool)
{
    SeamMemory memory = new(pool);
    QuickList<RankedChild> children = new(InitialCapacity, pool);
    QuickList<ChildResult> results = new(InitialCapacity, pool);
    QuickList<PlacedChildren> placed = new(InitialCapacity, pool);
    bool hasSeveralNormals;

    const int InitialCapacity = 16;

    // What cannot yield comes first: nobody can do anything about it.
    const int FixedClass = -1;

    /// <summary>Forgets the last body.</summary>
    public void Begin()
    {
        children.Count = results.Count = placed.Count = 0;
        hasSeveralNormals = false;
    }

    /// <summary>Adds two shapes that touch.</summary>
    /// <param name="child">The shapes, and what was found for them.</param>
    /// <param name="pair">Number of their pair, from one.</param>
    /// <param name="group">Number of those that move as what is not the body.</param>
    /// <param name="remembered">A bit for each contact that was there in the last step.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>The place of the result.</returns>
    public int Add(in SeamChild child, int pair, int group, int remembered, BufferPool pool)
    {
        hasSeveralNormals |= results.Count > 0 && !ChildAgreement.HasOneNormal(results[0].Manifold.Normal, child.Result.Manifold.Normal);
        children.Add(new() { Slot = results.Count, Class = child.Class, Pair = pair, Group = group, Remembered = remembered }, pool);
        placed.Add(child.Placed, pool);
        results.Add(child.Result, pool);
        return results.Count - 1;
    }

    /// <summary>Adds contacts that stay as they are, for others to agree with.</summary>
    /// <param name="normal">Unit normal towards the body.</param>
    /// <param name="depth">Greatest depth of the contacts, m.</param>
    /// <param name="pair">Number of their pair, from one.</param>
    /// <param name="group">Number of those that move as what is not the body.</param>
    /// <param name="pool">Source of memory.</param>
    public void AddFixed(in Vector3 normal, float depth, int pair, int group, BufferPool pool)
    {
        SeamChild child = default;
        child.Class = FixedClass;
        child.Placed.TypeA = child.Placed.TypeB = -1;
        child.Result.Children = new(ChildAgreement.AnyChild, 0);
        child.Result.Manifold.Count = 1;
        child.Result.Manifold.Normal = normal;
        child.Result.Manifold.Contact0.Depth = depth;
        Add(child, pair, group, 0, pool);
    }

    /// <summary>Makes what was added agree.</summary>
    /// <returns>Whether anything has changed.</returns>
    public bool Run(BufferPool pool)
    {
        Take(0, pool);
        if (hasSeveralNormals)
            ChildAgreement.Run(ref memory, results, placed, pool);
        LeaveFixed();
        if (MovesAlike())
            PatchSet.Thin(ref memory, results, placed, pool);
        children.Count = 0;
        var changes = false;
        foreach (ref var child in memory.Ranked.AsSpan())
        {
            changes |= child.HasYielded;
            children.Add(child, pool);
        }
        return changes;
    }

    void LeaveFixed()
    {
        var count = 0;
        foreach (ref var child in memory.Ranked.AsSpan())
        {
            if (child.Class != FixedClass)
                memory.Ranked[count++] = child;
        }
        memory.Ranked.Count = count;
    }

    readonly bool MovesAlike()
    {
        foreach (ref var child in memory.Ranked.AsSpan())
        {
            if (child.Group != memory.Ranked[0].Group)
                return false;
        }
        return true;
    }

    // The children of a pair, or of all, in their order.
    void Take(int pair, BufferPool pool)
    {
        memory.Ranked.Count = 0;
        foreach (ref var child in children.AsSpan())
        {
            if (pair == 0 || child.Pair == pair)
                memory.Ranked.Add(child, pool);
        }
        memory.Sort(results);
    }

    /// <summary>Whether a child of a pair has changed.</summary>
    public readonly bool HasChanged(int pair)
    {
        foreach (ref var child in children.AsSpan())
        {
            if (child.Pair == pair && child.HasYielded)
                return true;
        }
        return false;
    }

    /// <summary>What is left of two shapes.</summary>
    public readonly ref ChildResult this[int place] => ref results[place];

    /// <summary>Makes patches of what is left of the children of a pair.</summary>
    /// <param name="pair">Number of the pair.</param>
    /// <param name="known">Patches of the last step.</param>
    /// <param name="target">Receives the patches at its end.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Number of patches.</returns>
    public int BuildPatches(int pair, in KnownPatches known, Span<ChildResult> target, BufferPool pool)
    {
        Take(pair, pool);
        return PatchSet.Build(ref memory, results, placed, known, target, pool);
    }

    public void Dispose(BufferPool pool)
    {
        memory.Dispose(pool);
        children.Dispose(pool);
        results.Dispose(pool);
        placed.Dispose(pool);
    }
}
