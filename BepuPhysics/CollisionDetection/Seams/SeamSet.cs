using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is next for a set of children that agree.</summary>
enum SeamStage
{
    /// <summary>Looks triangles of B that are touched beyond their neighbours up along directions; then chooses of these, and takes what is there.</summary>
    DirectionsOfB, NormalsOfB,
    /// <summary>The same for those of A.</summary>
    DirectionsOfA, NormalsOfA,
    /// <summary>Brings the children in order.</summary>
    Order,
    /// <summary>Finds the next child that may be accepted.</summary>
    Next,
    /// <summary>Follows a contact that is foreseen to where it touches; then knows how it is there.</summary>
    Foreseen, Prepared,
    /// <summary>Knows whether it yields to one of those that might come before it.</summary>
    Rivals,
    /// <summary>Knows who yields to it, as it is accepted.</summary>
    Followers,
    /// <summary>All agree.</summary>
    Done,
}

/// <summary>The children of one parent, or all of one body, on the way to where they agree.</summary>
unsafe struct SeamSet
{
    /// <summary>What was found for each child, and then what is left of it; by slots.</summary>
    public ChildResult* Results;
    /// <summary>Shapes and poses of each child, by slots.</summary>
    public PlacedChildren* Placed;
    /// <summary>Place of its first child in <see cref="SeamMemory.Touching"/>, and number of those.</summary>
    public int First, Count;
    /// <summary>What the next round is to do.</summary>
    public SeamStage Stage;
    /// <summary>The child that is looked at, by its place in the order.</summary>
    public int Index;
    /// <summary>Number of children that others may yield to; the last of them.</summary>
    public int LeaderCount, LastLeader;
    /// <summary>Its tests of the last round.</summary>
    public SeamTests Tests;
    /// <summary>The contact that is foreseen, of the child that is looked at.</summary>
    public Foresight Foresight;
    /// <summary>Whether a contact was foreseen: what became of it is of this step alone.</summary>
    public bool HasForeseen;
    /// <summary>Whether its contacts are those with one plane; see <see cref="FaceCorners"/>.</summary>
    public bool IsOnPlane;
    /// <summary>Whether there are triangles beside these that were left out, as what is near them is a neighbour's.</summary>
    public bool LeavesToNeighbours;
    /// <summary>Number of patches; the first of those whose contacts are chosen, and how many there are.</summary>
    public int PatchCount, FirstReduced, ReducedCount;
    /// <summary>Whether the children are wanted after they were joined.</summary>
    public bool KeepsChildren;
    /// <summary>What the set is of.</summary>
    public int Owner;
}

/// <summary>The tests of one set in a round: the first, and how many there are.</summary>
readonly record struct SeamTests(int First, int Count)
{
    /// <summary>Place after the last.</summary>
    public int End => First + Count;
}

/// <summary>A set while it is worked on, with what it points to.</summary>
readonly unsafe ref struct SeamView(ref SeamSet set, Span<RankedChild> touching)
{
    /// <summary>The set.</summary>
    public readonly ref SeamSet Set = ref set;
    /// <summary>Its children that touch, in their order.</summary>
    public readonly Span<RankedChild> Ranked = touching.Slice(set.First, set.Count);

    /// <summary>What there is of a child.</summary>
    public ref ChildResult Result(in RankedChild child) => ref Set.Results[child.Slot];

    /// <summary>Where a child is.</summary>
    public ref PlacedChildren Placed(in RankedChild child) => ref Set.Placed[child.Slot];
}
