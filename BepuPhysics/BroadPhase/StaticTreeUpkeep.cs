using System;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>When the tree of what does not move is built anew.</summary>
/// <remarks>
/// Insertions and removals keep a tree fitted and mend it on their way: 100,000 leaves that are replaced four times over by others anywhere cost 1.05
/// times a new tree. A level that streams in on one side, or is loaded in order, comes to 1.2 to 1.9. So many changes lead to a look at the tree, which
/// takes a sixtieth of building it, and only what the look finds to a build: a world in which statics come and go has no step that pays for all of them.
/// </remarks>
struct StaticTreeUpkeep
{
    // What a leaf that comes or goes counts, and what a body that falls asleep or wakes: it comes back to where it was.
    const int WeightOfStatic = 16;
    const int WeightOfSleeper = 1;
    // Cost over that of the last build from which on a build is worth its time.
    const float TolerableCost = 1.25f;

    // Leaves that came or went since the last look, by weight.
    int changes;
    int leavesWhenBuilt;
    float costWhenBuilt;

    /// <summary>Notes that a leaf came, went or moved.</summary>
    public void Note(CollidableReference collidable) => changes += collidable.Mobility == CollidableMobility.Static ? WeightOfStatic : WeightOfSleeper;

    /// <summary>Whether the tree is to be looked at.</summary>
    public readonly bool IsDue(int leafCount) => IsGoodPart(changes / WeightOfStatic, leafCount);

    /// <summary>Whether so many of so many leaves are worth a build.</summary>
    public static bool IsGoodPart(int changes, int leafCount) => changes > 32 && changes > leafCount / 4;

    /// <summary>Looks at the tree, if that is due, and builds it if it is not what it was.</summary>
    public void Update(ref Tree tree, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        if (!IsDue(tree.LeafCount))
            return;
        changes = 0;
        if (!IsGoodPart(Math.Abs(tree.LeafCount - leavesWhenBuilt), tree.LeafCount) && tree.MeasureRelativeCost() <= TolerableCost * costWhenBuilt)
            return;
        tree.BinnedBuild(pool, dispatcher);
        leavesWhenBuilt = tree.LeafCount;
        costWhenBuilt = tree.MeasureRelativeCost();
    }
}
