using System;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

// Moving leaves make a tree worse. Rebuilding all of it in every step costs too much, so each call rebuilds a slice: in turn the subtrees
// of
// some hundred leaves, and now and then the top, whose items are subtrees several times smaller than those. The two kinds overlap in size,
// so a leaf can
// wander through the whole tree. When slices stop to gain anything, most calls do nothing: a scene at rest pays almost nothing.
public unsafe partial struct Tree
{
    /// <summary>Every so many slices the top is rebuilt instead of a subtree.</summary>
    const int SlicesPerTop = 8;

    /// <summary>Slices in a row without gain after which calls are skipped, and the largest power of two of calls for one slice.</summary>
    const int PatientSlices = 8, MaximumSkipPower = 3;

    /// <summary>A slice that lowers its cost by less than this part gained nothing.</summary>
    const float WorthwhileGain = 1f / 64;

    /// <summary>
    /// Rebuilds a small part of the tree, another one in each call, so that the whole tree stays good while its leaves move. The boxes
    /// must fit (call a refit first).
    /// Leaves the nodes in depth-first order. What is done depends on the tree and the calls before alone.
    /// </summary>
    public void Refine(BufferPool pool) => Refine(pool, null);

    /// <summary>
    /// As <see cref="Refine(BufferPool)"/>; where nodes have to be copied, on many threads if the tree is large. Returns by which part the cost of what was
    /// rebuilt fell.
    /// </summary>
    internal float Refine(BufferPool pool, IThreadDispatcher? dispatcher)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (LeafCount <= 2 || --callsToSkip >= 0)
            return 0;
        if (!IsDepthFirst)
            Refit(pool, dispatcher);
        var gain = RefineSlice(pool, dispatcher);
        if (!isDepthFirst)
            SortNodes(pool, dispatcher);
        return gain;
    }

    /// <summary>
    /// As <see cref="Refine(BufferPool)"/>, of a tree in depth-first order, which may end in another one: the next refit brings it back. What it takes of
    /// the pool it gives back.
    /// </summary>
    internal float RefineUnsorted(BufferPool pool)
    {
        Check.That(IsDepthFirst);
        return LeafCount <= 2 || --callsToSkip >= 0 ? 0 : RefineSlice(pool, null);
    }

    float RefineSlice(BufferPool pool, IThreadDispatcher? dispatcher)
    {
        // An eighth of a small tree, at most some hundred leaves; more only where the top of a huge tree asks for larger items.
        var topItemLimit = Clamp(LeafCount / 512, 8, MaximumLeafCount);
        var subtreeLimit = Clamp(LeafCount / 8, 32, 512);
        if (subtreeLimit < 4 * topItemLimit)
            subtreeLimit = 4 * topItemLimit;

        float gain;
        if (LeafCount <= subtreeLimit)
            gain = RefineSubtree(0, LeafCount, 0, pool);
        else if (++refinementSlice % SlicesPerTop == 0)
            gain = RefineTop(topItemLimit, pool, dispatcher);
        else
            gain = RefineNextSubtrees(subtreeLimit, pool);

        if (gain >= WorthwhileGain)
            slicesWithoutGain = 0;
        else if (slicesWithoutGain < PatientSlices * MaximumSkipPower)
            ++slicesWithoutGain;
        callsToSkip = (1 << slicesWithoutGain / PatientSlices) - 1;
        return gain;
    }

    static int Clamp(int value, int low, int high) => value < low ? low : value > high ? high : value;

    /// <summary>Rebuilds the largest subtrees within a limit, from where the last call stopped, until half the limit is used up. Returns
    /// the best relative gain.</summary>
    float RefineNextSubtrees(int limit, BufferPool pool)
    {
        var best = 0f;
        var leavesLeft = limit / 2;
        // Tiny subtrees that hang beside large ones do not add up to half the limit; a few of them are a slice as well.
        for (var i = 0; i < 8 && leavesLeft > 0; ++i)
        {
            if (refinementCursor >= NodeCount)
                refinementCursor = 0;
            var node = FindSubtree(refinementCursor, limit, out var count, out var depth);
            var gain = RefineSubtree(node, count, depth, pool);
            if (gain > best)
                best = gain;
            refinementCursor = node + count - 1;
            leavesLeft -= count;
        }
        return best;
    }

    /// <summary>The largest subtree within a limit that holds a node, or the node after it in order where the node itself is above the
    /// limit.</summary>
    readonly int FindSubtree(int position, int limit, out int count, out int depth)
    {
        var node = 0;
        count = LeafCount;
        depth = 0;
        while (count > limit)
        {
            if (position <= node)
                position = node + 1;
            var countA = Children[2 * node].LeafCount;
            var inB = position >= node + countA;
            node = inB ? node + countA : node + 1;
            count = inB ? count - countA : countA;
            ++depth;
        }
        return node;
    }

    /// <summary>Rebuilds the subtree of a node and returns by which part its cost fell.</summary>
    readonly float RefineSubtree(int node, int leafCount, int depth, BufferPool pool)
    {
        if (leafCount < 3)
            return 0;
        using var scratch = new BuildScratch(leafCount, pool);
        Gather(node, 1, scratch, out var itemCount, out _);
        var before = MeasureCost(scratch.NodeIndices, itemCount - 1);
        TreeBuilder.Build(this, scratch.Items, scratch.Spare, itemCount, scratch.NodeIndices, MaximumHeight - depth);
        UpdateAncestorHeights(node);
        return RelativeGain(before, MeasureCost(scratch.NodeIndices, itemCount - 1));
    }

    /// <summary>Rebuilds all nodes with more leaves than a limit over the subtrees that have no more, and returns by which part their cost
    /// fell.</summary>
    float RefineTop(int itemLimit, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        using var scratch = new BuildScratch(CountItems(itemLimit), pool);
        Gather(0, itemLimit, scratch, out var itemCount, out var highestItem);
        var allowedHeight = MaximumHeight - highestItem;
        if (HalvingHeight(itemCount) > allowedHeight)
        {
            // Only a subtree that is nearly as high as a tree may be leaves no room; a tree like that is best built anew.
            BinnedBuild(pool, dispatcher);
            return 1;
        }
        var before = MeasureCost(scratch.NodeIndices, itemCount - 1);
        TreeBuilder.Build(this, scratch.Items, scratch.Spare, itemCount, scratch.NodeIndices, allowedHeight);
        var after = MeasureCost(scratch.NodeIndices, itemCount - 1);
        // The subtrees stayed where they were, and are in another order if there was anything to gain.
        isDepthFirst = AreInOrder(scratch.NodeIndices, itemCount - 1);
        return RelativeGain(before, after);
    }

    /// <summary>Number of the largest subtrees that have no more leaves than a limit. The nodes must be in depth-first order.</summary>
    readonly int CountItems(int leafLimit)
    {
        var count = 0;
        for (var node = 0; node < NodeCount;)
        {
            var leavesOfA = Children[2 * node].LeafCount;
            var leavesOfB = Children[2 * node + 1].LeafCount;
            if (leavesOfA + leavesOfB <= leafLimit)
            {
                node += leavesOfA + leavesOfB - 1;
                continue;
            }
            count += (leavesOfA <= leafLimit ? 1 : 0) + (leavesOfB <= leafLimit ? 1 : 0);
            ++node;
        }
        return count;
    }

    /// <summary>Whether the children of some nodes, which were in depth-first order with all that is below them, are where that order has them.</summary>
    readonly bool AreInOrder(int* nodes, int count)
    {
        for (var i = 0; i < count; ++i)
        {
            var a = Children + 2 * nodes[i];
            var next = nodes[i] + 1;
            for (var child = a; child < a + 2; ++child)
            {
                if (child->Index >= 0 && child->Index != next)
                    return false;
                next += child->LeafCount - 1;
            }
        }
        return true;
    }

    static float RelativeGain(float before, float after) => before > 0 ? (before - after) / before : 0;

    /// <summary>Summed surface of the children of some nodes. What hangs below them adds the same before and after a rebuild.</summary>
    readonly float MeasureCost(int* nodes, int count)
    {
        var children = Children;
        var cost = 0f;
        for (var i = 0; i < count; ++i)
            cost += BoxMath.HalfArea(children + 2 * nodes[i]) + BoxMath.HalfArea(children + 2 * nodes[i] + 1);
        return cost;
    }

    /// <summary>Summed surface of the boxes of all nodes relative to the root's: about how many nodes a random small query visits. Zero
    /// for fewer than three leaves.</summary>
    public readonly float MeasureRelativeCost()
    {
        var children = Children;
        if (LeafCount < 3)
            return 0;
        var cost = 0f;
        for (var slot = 0; slot < 2 * NodeCount; ++slot)
        {
            if (children[slot].Index >= 0)
                cost += BoxMath.HalfArea(children + slot);
        }
        var root = BoxMath.UnionHalfArea(children, children + 1);
        return root > 0 ? cost / root : 0;
    }
}
