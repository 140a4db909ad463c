using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>When the tree of what is awake is built anew.</summary>
/// <remarks>
/// Slices that are refined in turn keep up with a pile. Where thousands of bodies fly past each other, a slice is out of order long before its turn comes
/// again. That shows in what a slice gains, which costs nothing to know; only then the tree is looked at, and built if it is not what it was.
/// </remarks>
struct ActiveTreeUpkeep
{
    // Part of its cost that a slice of a tree has gained that is looked at.
    const float LargeGain = .25f;
    // Cost over that of the last build from which on a build is worth its time.
    const float TolerableCost = 1.25f;

    // Leaves that came since the last update.
    int additions;
    float costWhenBuilt;
    bool isBuildDue;
    bool isTidy;

    /// <summary>Notes that a leaf came.</summary>
    public void NoteAddition() => ++additions;

    /// <summary>Fits the tree to its leaves, or builds it anew.</summary>
    public void Fit(ref Tree tree, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        // A tree that has just grown by a good part is cheaper to build than to mend: the start of a game, a level that was loaded.
        var hasGrown = StaticTreeUpkeep.IsGoodPart(additions, tree.LeafCount);
        additions = 0;
        if (hasGrown || isBuildDue)
        {
            tree.BinnedBuild(pool, dispatcher);
            costWhenBuilt = tree.MeasureRelativeCost();
            isBuildDue = false;
            isTidy = true;
            return;
        }
        tree.Refit(pool, dispatcher);
        isTidy = false;
    }

    /// <summary>Whether <see cref="Tidy"/> needs no more of a pool than it gives back.</summary>
    public readonly bool TidiesInPlace(in Tree tree) => !isTidy && tree.IsDepthFirst;

    /// <summary>Refines a slice of the tree, once after each time that it was fitted.</summary>
    /// <param name="tree">The tree.</param>
    /// <param name="pool">That of the tree's memory; any where the tree is tidied in place.</param>
    public void Tidy(ref Tree tree, BufferPool pool)
    {
        if (isTidy)
            return;
        isTidy = true;
        if (!tree.IsDepthFirst)
            tree.Refit(pool);
        isBuildDue = tree.RefineUnsorted(pool) >= LargeGain && tree.MeasureRelativeCost() > TolerableCost * costWhenBuilt;
    }
}
