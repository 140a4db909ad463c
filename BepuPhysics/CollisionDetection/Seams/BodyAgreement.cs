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
unsafe struct BodyAgreement(BufferPool pool)
{
    SeamMemory memory;
    QuickList<ChildResult> results = new(InitialCapacity, pool);
    QuickList<PlacedChildren> placed = new(InitialCapacity, pool);

    const int InitialCapacity = 4 * SeamMemory.BodyCapacity;

    // What cannot yield comes first: nobody can do anything about it.
    const int FixedClass = -1;

    /// <summary>Forgets all bodies.</summary>
    public void Begin()
    {
        memory.Begin();
        results.Count = placed.Count = 0;
    }

    /// <summary>Begins a body; what is added then is of this one.</summary>
    /// <returns>Its number.</returns>
    public int BeginBody(BufferPool pool)
    {
        // Each child that is added has a place of its own among the results, which is that among those that touch.
        memory.Add(new() { First = results.Count, Stage = SeamStage.Done, Index = -1 }, pool);
        return memory.Sets.Count - 1;
    }

    /// <summary>Adds two shapes that touch to the last body.</summary>
    /// <param name="child">The shapes, and what was found for them.</param>
    /// <param name="pair">Number of their pair, from one.</param>
    /// <param name="group">Number of those that move as what is not the body.</param>
    /// <param name="remembered">A bit for each contact that was there in the last step.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>The place of the result, of those of its body.</returns>
    public int Add(in SeamChild child, int pair, int group, int remembered, BufferPool pool)
    {
        ref var set = ref memory.Sets[memory.Sets.Count - 1];
        if (set.Count > 0 && !ChildAgreement.HasEqualNormal(results[set.First].Manifold.Normal, child.Result.Manifold.Normal))
            set.Stage = SeamStage.Order;
        memory.Touching.Add(new() { Slot = set.Count, Class = child.Class, Pair = pair, Group = group, Remembered = remembered }, pool);
        placed.Add(child.Placed, pool);
        results.Add(child.Result, pool);
        return set.Count++;
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

    /// <summary>Makes what was added agree, body by body.</summary>
    /// <param name="registry">The tasks that test pairs.</param>
    /// <param name="pool">Source of memory.</param>
    public void Run(CollisionTaskRegistry registry, BufferPool pool)
    {
        foreach (ref var set in memory.Sets.AsSpan())
        {
            set.Results = results.Span.Memory + set.First;
            set.Placed = placed.Span.Memory + set.First;
        }
        SeamRounds.Run(ref memory, registry, pool);
    }

    /// <summary>Leaves a body those contacts that it needs.</summary>
    /// <returns>Whether anything of it has changed.</returns>
    public bool Finish(int body, BufferPool pool)
    {
        ref var set = ref memory.Sets[body];
        var children = memory.TouchingOf(set);
        // Where all have one normal they were not brought in order yet.
        if (set.Index < 0)
            children = children[..SeamMemory.Sort(children, set.Results)];
        memory.Rank(children, pool);
        JoinNormals(ResultsOf(set), PlacedOf(set));
        LeaveFixed();
        if (!set.IsOnPlane && MovesAlike())
            PatchSet.Thin(ref memory, ResultsOf(set), PlacedOf(set), pool);
        var changes = false;
        set.Count = memory.Ranked.Count;
        for (int i = 0; i < set.Count; ++i)
        {
            changes |= memory.Ranked[i].HasChanged;
            children[i] = memory.Ranked[i];
        }
        return changes;
    }

    readonly int SlotCount(in SeamSet set) => (int)(results.Span.Memory + results.Count - set.Results);

    // To the end of all: those of a body are the first of these.
    readonly Span<ChildResult> ResultsOf(in SeamSet set) => new(set.Results, SlotCount(set));

    readonly Span<PlacedChildren> PlacedOf(in SeamSet set) => new(set.Placed, SlotCount(set));

    // What has one normal has that of the deepest, as the contacts of a patch have. What leans a little has the normal of its own face on a part of the floor
    // that ends below it: it would be pushed along the others by what it leans. Normals of what is round are found by a search, and not as exact.
    void JoinNormals(Span<ChildResult> results, Span<PlacedChildren> placed)
    {
        var ranked = memory.Ranked.AsSpan();
        for (int i = 1; i < ranked.Length; ++i)
        {
            ref var normal = ref results[ranked[i].Slot].Manifold.Normal;
            if (ranked[i].Class == FixedClass || PlacedChildren.IsRound(placed[ranked[i].Slot].TypeA))
                continue;
            for (int j = 0; j < i; ++j)
            {
                ref readonly var leader = ref results[ranked[j].Slot].Manifold.Normal;
                if (ranked[j].Group != ranked[i].Group || PlacedChildren.IsRound(placed[ranked[j].Slot].TypeA) ||
                    !ChildAgreement.HasOneNormal(leader, normal))
                    continue;
                ranked[i].HasYielded |= normal != leader;
                normal = leader;
                break;
            }
        }
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

    /// <summary>Whether what is left of a body may be that for more than this step.</summary>
    public readonly bool MayRemember(int body) => !memory.Sets[body].HasForeseen;

    /// <summary>Whether a child of a pair of a body has changed.</summary>
    public readonly bool HasChanged(int body, int pair)
    {
        foreach (ref var child in memory.TouchingOf(memory.Sets[body]))
        {
            if (child.Pair == pair && child.HasChanged)
                return true;
        }
        return false;
    }

    /// <summary>What is left of two shapes of a body.</summary>
    public readonly ref ChildResult Result(int body, int place) => ref memory.Sets[body].Results[place];

    /// <summary>Makes patches of what is left of the children of a pair.</summary>
    /// <param name="body">Number of the body.</param>
    /// <param name="pair">Number of the pair.</param>
    /// <param name="known">Patches of the last step.</param>
    /// <param name="target">Receives the patches at its end.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Number of patches.</returns>
    public int BuildPatches(int body, int pair, in KnownPatches known, Span<ChildResult> target, BufferPool pool)
    {
        ref var set = ref memory.Sets[body];
        memory.Ranked.Count = 0;
        foreach (ref var child in memory.TouchingOf(set))
        {
            if (child.Pair == pair)
                memory.Ranked.Add(child, pool);
        }
        memory.Ranked.Count = SeamMemory.Sort(memory.Ranked.AsSpan(), set.Results);
        return PatchSet.Build(ref memory, ResultsOf(set), PlacedOf(set), known, target, pool);
    }

    /// <summary>Returns all memory.</summary>
    public void Dispose(BufferPool pool)
    {
        memory.Dispose(pool);
        results.Dispose(pool);
        placed.Dispose(pool);
    }
}
