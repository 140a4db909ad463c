using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair of a dynamic body and something that does not give way, whose contacts wait for those of the body's other such pairs.</summary>
struct StaticPair
{
    /// <summary>The pair.</summary>
    public TestedPair Tested;
    /// <summary>How its surfaces behave.</summary>
    public PairMaterialProperties Material;
    /// <summary>Place of its results: for patches there is room before it.</summary>
    public int FirstResult;
    /// <summary>Number of its patches, which are right before the results; of a pair of convex shapes there are none.</summary>
    public int PatchCount;
    /// <summary>Number of results, without patches; zero for a pair that was completed without contacts.</summary>
    public int ResultCount;
    /// <summary>Place of the children that touch, of those that were kept; number of them.</summary>
    public int FirstChild, ChildCount;
    /// <summary>Whether one of its shapes is made of children.</summary>
    public bool IsOfChildren;
    /// <summary>Whether a game has changed its contacts: then it knows best.</summary>
    public bool IsOfGame;
    /// <summary>Whether it had contacts before the pairs of its body agreed.</summary>
    public bool IsTouching;
    /// <summary>Number of those that move as its B; where bodies agree.</summary>
    public int Group;
    /// <summary>Whether its B turns; where bodies agree.</summary>
    public bool IsTurning;
    /// <summary>Place among the children of the body, of a pair of convex shapes.</summary>
    public int Slot;

    /// <summary>Place of the first of its results, patches before all.</summary>
    public readonly int Start => FirstResult - PatchCount;

    /// <summary>Place after the last of its results.</summary>
    public readonly int End => FirstResult + ResultCount;
}

/// <summary>What contacts that are new take over from contacts of the same body with something else.</summary>
struct Inheritance
{
    /// <summary>The pair whose contacts are new.</summary>
    public CollidablePair Pair;
    /// <summary>Which of its manifolds it is.</summary>
    public ChildIds Children;
    /// <summary>What the others carried in the last step.</summary>
    public ContactPatch Load;
}

/// <summary>Where the friction of a manifold acts that is a part of a patch on several things that do not give way.</summary>
struct SharedFriction
{
    /// <summary>The pair.</summary>
    public CollidablePair Pair;
    /// <summary>Which of its manifolds it is.</summary>
    public ChildIds Children;
    /// <summary>
    /// Relative to the centre of the body, m: the middle of all contacts that touch; on bodies that turn the position of B, as friction acts at the foot of
    /// the body's centre there; zero where each manifold has its own.
    /// </summary>
    public Vector3 Center;

    /// <summary>Whether it is of a manifold.</summary>
    public readonly bool IsOf(in CollidablePair pair, ChildIds children) =>
        Pair.A.Packed == pair.A.Packed && Pair.B.Packed == pair.B.Packed && Children == children;
}

/// <summary>A constraint that a body had in the last step with something that does not give way.</summary>
struct OldPatch
{
    /// <summary>The constraint.</summary>
    public ConstraintHandle Constraint;
    /// <summary>Number of its contacts.</summary>
    public int ContactCount;
    /// <summary>Features of its contacts.</summary>
    public FeatureIds Features;
    /// <summary>Its contacts, relative to the centre of the body, m.</summary>
    public FourVectors Arms;
    /// <summary>Index of its pair in the cache.</summary>
    public int CacheIndex;
    /// <summary>Which of the pair's manifolds it is.</summary>
    public ChildIds Children;
    /// <summary>Place of the pair among those that wait; negative where it does not.</summary>
    public int Pair;
    /// <summary>Number that it has where loads are handed on.</summary>
    public int Source;
    /// <summary>Whether the contacts of this step have been written to it already.</summary>
    public bool IsWritten;
}

/// <summary>A body whose pairs agree.</summary>
struct AgreeingBody
{
    /// <summary>Places of its pairs: the first, and the one after the last.</summary>
    public int First, End;
    /// <summary>Place of the first of its constraints in <see cref="StaticPairs.Old"/>, and how many it had.</summary>
    public int FirstOld, OldCount;
    /// <summary>Number of pairs that have contacts.</summary>
    public int TouchCount;
    /// <summary>Its number where they agree; <see cref="StaticPairs.Nothing"/> where there is nothing to agree on.</summary>
    public int Number;
    /// <summary>Whether what they agree on holds for as long as nothing changes.</summary>
    public bool MayRemember;
}

/// <summary>The pairs of one worker that wait, and its memory for making them agree. There is none before the first pair.</summary>
struct StaticPairs
{
    /// <summary>The pairs.</summary>
    public QuickList<StaticPair> Pairs;
    /// <summary>Results of the pairs, each with room for patches before them.</summary>
    public QuickList<ChildResult> Results;
    /// <summary>Children that touch.</summary>
    public QuickList<SeamChild> Children;
    /// <summary>What new contacts take over.</summary>
    public QuickList<Inheritance> Inheritances;
    /// <summary>Where friction acts, of the body whose pairs agree.</summary>
    public QuickList<SharedFriction> FrictionCenters;
    /// <summary>The bodies whose pairs agree at once.</summary>
    public QuickList<AgreeingBody> Bodies;
    /// <summary>Constraints of these bodies.</summary>
    public QuickList<OldPatch> Old;
    /// <summary>How what the body touches moves.</summary>
    public QuickList<SurfaceMotion> Groups;
    /// <summary>Hands on what contacts carry.</summary>
    public LoadHandover Transfer;
    /// <summary>Makes pairs agree.</summary>
    public BodyAgreement Agreement;
    /// <summary>Pairs for which there is room from the first one on.</summary>
    public int Room;
    PatchResults shown;
    int shownCount;

    /// <summary>Index of what there is not.</summary>
    public const int Nothing = -1;

    const int InitialCapacity = 16;

    [System.Runtime.CompilerServices.InlineArray(PatchSet.Capacity)]
    struct PatchResults
    {
        ConvexContactManifold first;
    }

    void Prepare(BufferPool pool)
    {
        if (Pairs.Span.Allocated)
            return;
        Pairs = new(Math.Max(InitialCapacity, Room), pool);
        Results = new(Math.Max(InitialCapacity * 2, Room), pool);
        Children = new(InitialCapacity, pool);
    }

    /// <summary>Makes room for what bodies need that agree.</summary>
    public void PrepareAgreement(BufferPool pool)
    {
        Inheritances = new(InitialCapacity, pool);
        FrictionCenters = new(InitialCapacity, pool);
        Bodies = new(InitialCapacity, pool);
        Old = new(InitialCapacity, pool);
        Groups = new(InitialCapacity, pool);
        Transfer = new(pool);
        Agreement = new(pool);
    }

    /// <summary>The constraints that a body had.</summary>
    public readonly Span<OldPatch> OldOf(in AgreeingBody body) => Old.AsSpan().Slice(body.FirstOld, body.OldCount);

    /// <summary>Adds a pair of convex shapes.</summary>
    /// <returns>Its index.</returns>
    public int Add(in TestedPair tested, in ConvexContactManifold manifold, in PairMaterialProperties material, bool isOfGame, BufferPool pool)
    {
        Prepare(pool);
        // Field by field: what is made elsewhere first is copied as a whole.
        ref var pair = ref Pairs.Allocate(pool);
        pair.Tested = tested;
        pair.Material = material;
        pair.FirstResult = Results.Count;
        pair.PatchCount = 0;
        pair.ResultCount = 1;
        pair.FirstChild = pair.ChildCount = 0;
        pair.IsOfChildren = false;
        pair.IsOfGame = isOfGame;
        ref var result = ref Results.Allocate(pool);
        result.Children = ChildIds.None;
        result.KeepsHistory = tested.KeepsHistory;
        result.IsLeftToNeighbours = false;
        result.Lever = FaceLever.OfOneFace;
        result.OffsetA = default;
        result.Manifold = manifold;
        return Pairs.Count - 1;
    }

    /// <summary>Notes a pair of convex shapes that had contacts, has none any more, and was completed.</summary>
    public void NoteGone(in TestedPair tested, BufferPool pool)
    {
        if (tested.Pair.B.Mobility == CollidableMobility.Dynamic || tested.ConstraintTypeId == CachedManifold.NoConstraint)
            return;
        Prepare(pool);
        Pairs.Add(new() { Tested = tested, FirstResult = Results.Count }, pool);
    }

    /// <summary>Remembers the patches of a pair as a game is shown them.</summary>
    public void Show(Span<ChildResult> results)
    {
        shownCount = 0;
        for (int i = 0; i < results.Length && results[i].Children.IsPatch; ++i)
            shown[shownCount++] = results[i].Manifold;
    }

    /// <summary>Adds a pair of which one shape is made of children.</summary>
    public void Add(in TestedPair tested, Span<ChildResult> results, Span<SeamChild> children, in PairMaterialProperties material, BufferPool pool)
    {
        Prepare(pool);
        var patchCount = 0;
        while (patchCount < results.Length && results[patchCount].Children.IsPatch)
            ++patchCount;
        var isOfGame = patchCount != shownCount;
        for (int i = 0; i < patchCount && !isOfGame; ++i)
            isOfGame = !BytesOf.AreEqual(shown[i], results[i].Manifold);
        Results.EnsureCapacity(Results.Count + PatchSet.Capacity + results.Length, pool);
        Results.Count += PatchSet.Capacity - patchCount;
        foreach (ref var result in results)
            Results.AddUnsafely(result);
        // Field by field, as above.
        ref var pair = ref Pairs.Allocate(pool);
        pair.Tested = tested;
        pair.Material = material;
        pair.FirstResult = Results.Count - results.Length + patchCount;
        pair.PatchCount = patchCount;
        pair.ResultCount = results.Length - patchCount;
        pair.FirstChild = Children.Count;
        pair.ChildCount = children.Length;
        pair.IsOfChildren = true;
        pair.IsOfGame = isOfGame;
        pair.IsTouching = pair.IsTurning = false;
        pair.Group = pair.Slot = 0;
        foreach (ref var child in children)
            Children.Add(child, pool);
    }

    /// <summary>Place of what a manifold takes over; <see cref="Nothing"/> where there is nothing.</summary>
    // Only those of one body are looked through, which are last.
    public readonly int FindInheritance(in CollidablePair pair, ChildIds children)
    {
        for (int i = Inheritances.Count - 1; i >= 0 && Inheritances[i].Pair.A.Packed == pair.A.Packed; --i)
        {
            if (Inheritances[i].Pair.B.Packed == pair.B.Packed && Inheritances[i].Children == children)
                return i;
        }
        return Nothing;
    }

    /// <summary>What is written of the place of a manifold's friction; zero where it shares none. See <see cref="SharedFriction.Center"/>.</summary>
    public readonly Vector3 FindFrictionCenter(in CollidablePair pair, ChildIds children)
    {
        var index = IndexOfFriction(pair, children);
        return index >= 0 ? FrictionCenters[index].Center : default;
    }

    /// <summary>Whether it is known whether a manifold shares friction.</summary>
    public readonly bool HasFrictionCenter(in CollidablePair pair, ChildIds children) => IndexOfFriction(pair, children) >= 0;

    readonly int IndexOfFriction(in CollidablePair pair, ChildIds children)
    {
        for (int i = 0; i < FrictionCenters.Count; ++i)
        {
            if (FrictionCenters[i].IsOf(pair, children))
                return i;
        }
        return Nothing;
    }

    public void Release(BufferPool pool)
    {
        if (Inheritances.Span.Allocated)
        {
            Inheritances.Dispose(pool);
            FrictionCenters.Dispose(pool);
            Bodies.Dispose(pool);
            Old.Dispose(pool);
            Groups.Dispose(pool);
            Transfer.Dispose(pool);
            Agreement.Dispose(pool);
        }
        ReleasePairs(pool);
        this = default;
    }

    /// <summary>Gives the pairs and their results back, which have been handed on. What new contacts take over stays.</summary>
    public void ReleasePairs(BufferPool pool)
    {
        if (!Pairs.Span.Allocated)
            return;
        Pairs.Dispose(pool);
        Results.Dispose(pool);
        Children.Dispose(pool);
    }
}

/// <summary>Compares values of any kind bit by bit.</summary>
static class BytesOf
{
    /// <summary>Whether two values are the same in all bits.</summary>
    public static bool AreEqual<T>(in T a, in T b) where T : unmanaged => System.Runtime.InteropServices.MemoryMarshal.AsBytes(new ReadOnlySpan<T>(in a))
        .SequenceEqual(System.Runtime.InteropServices.MemoryMarshal.AsBytes(new ReadOnlySpan<T>(in b)));
}
