using System.Runtime.Intrinsics;

namespace BepuPhysics.Trees;

/// <summary>
/// Builds a subtree over items, leaves or whole subtrees, top down: the split of each node is the cheapest of those between bins along the
/// longest axis of the items' centres (all splits in sorted order for few items), by the surface area heuristic: area times leaves on the
/// left plus
/// the same on the right. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.
/// </summary>
/// <remarks>
/// Where no split is better than another (equal centres, overflowing areas), and where the height allowed leaves no choice, the items are
/// halved. A halved tree of n items has height ceil(log2 n), so any allowed height from there on is kept.
/// Partitions go back and forth between two arrays without a branch on the item: each item is written to both ends, and only one end moves
/// on.
/// </remarks>
unsafe ref struct TreeBuilder
{
    const int BinCount = 16;
    // Sorting so few costs less than filling and sweeping bins, and finds the best split instead of a good one.
    const int SortedCount = 8;

    readonly NodeChild* children;
    readonly Metanode* metanodes;
    readonly Leaf* leaves;
    readonly int* nodeIndices;
    Bins* bins;

    /// <summary>Scratch of a split; a node is done with it before its children begin.</summary>
    struct Bins
    {
        public fixed float Boxes[BinCount * 8];
        public fixed int ItemCounts[BinCount];
        public fixed int LeafCounts[BinCount];
        public fixed float RightCosts[BinCount];
    }

    /// <summary>Builds a tree over the items and returns its height.</summary>
    /// <param name="tree">Tree whose nodes are written and whose leaves and nodes that occur as items are told their parents.</param>
    /// <param name="items">The items, at least two; left in another order.</param>
    /// <param name="spare">Room for as many items.</param>
    /// <param name="count">Number of items.</param>
    /// <param name="nodeIndices">Places for the nodes, one less than there are items; used in depth-first order, the first for the
    /// top.</param>
    /// <param name="allowedHeight">Height that the tree over the items, counted as leaves, must not exceed; at least ceil(log2
    /// count).</param>
    public static int Build(in Tree tree, NodeChild* items, NodeChild* spare, int count, int* nodeIndices, int allowedHeight)
    {
        Bins bins;
        return new TreeBuilder(tree, nodeIndices, &bins).BuildNode(items, spare, count, 0, allowedHeight);
    }

    /// <summary>Divides the items of a node in two, as <see cref="Build"/> does, and builds nothing.</summary>
    /// <param name="items">The items, at least two; left in another order.</param>
    /// <param name="spare">Room for as many items.</param>
    /// <param name="count">Number of items.</param>
    /// <param name="allowedHeight">Height that the tree over the items must not exceed.</param>
    /// <param name="moved">Whether the items are in what was the room now.</param>
    /// <returns>Number of items on the left, which come first.</returns>
    public static int Split(NodeChild* items, NodeChild* spare, int count, int allowedHeight, out bool moved)
    {
        Bins bins;
        return new TreeBuilder { bins = &bins }.SplitItems(items, spare, count, allowedHeight, out moved);
    }

    /// <summary>Builds what is below a slot over items, and writes the slot, as <see cref="Build"/> does.</summary>
    public static void BuildBelow(in Tree tree, int slot, NodeChild* items, NodeChild* spare, int count, int* nodeIndices, int order, int allowedHeight)
    {
        Bins bins;
        new TreeBuilder(tree, nodeIndices, &bins).BuildChild(items, spare, count, slot, order, allowedHeight);
    }

    TreeBuilder(in Tree tree, int* nodeIndices, Bins* bins)
    {
        children = tree.Children;
        metanodes = tree.Metanodes.Memory;
        leaves = tree.Leaves.Memory;
        this.nodeIndices = nodeIndices;
        this.bins = bins;
    }

    readonly int SplitItems(NodeChild* items, NodeChild* spare, int count, int allowedHeight, out bool moved)
    {
        moved = false;
        if (count <= 2 || Tree.HalvingHeight(count) >= allowedHeight)
            return count >> 1;
        if (count <= SortedCount)
            return SortAndSplit(items, count);
        var split = BinAndSplit(items, spare, count);
        moved = split > 0;
        return moved ? split : count >> 1;
    }

    readonly int BuildNode(NodeChild* items, NodeChild* spare, int count, int order, int allowedHeight)
    {
        var node = nodeIndices[order];
        var leftCount = SplitItems(items, spare, count, allowedHeight, out var moved);
        var source = moved ? spare : items;
        var other = moved ? items : spare;
        --allowedHeight;
        var heightA = BuildChild(source, other, leftCount, 2 * node, order + 1, allowedHeight);
        var heightB = BuildChild(source + leftCount, other + leftCount, count - leftCount, 2 * node + 1, order + leftCount, allowedHeight);
        var height = 1 + (heightA > heightB ? heightA : heightB);
        metanodes[node].Height = height;
        return height;
    }

    readonly int BuildChild(NodeChild* items, NodeChild* spare, int count, int slot, int order, int allowedHeight)
    {
        if (count > 1)
        {
            var node = nodeIndices[order];
            metanodes[node].ParentSlot = slot;
            var height = BuildNode(items, spare, count, order, allowedHeight);
            var a = children + 2 * node;
            BoxMath.Store(children + slot,
                BoxMath.Min(BoxMath.LoadMin(a), BoxMath.LoadMin(a + 1)),
                BoxMath.Max(BoxMath.LoadMax(a), BoxMath.LoadMax(a + 1)),
                node, a[0].LeafCount + a[1].LeafCount);
            return height;
        }
        children[slot] = *items;
        var index = items->Index;
        if (index < 0)
        {
            leaves[~index].Slot = slot;
            return 0;
        }
        metanodes[index].ParentSlot = slot;
        return metanodes[index].Height;
    }

    /// <summary>Twice the lowest and highest centre of the items, and the axis on which these are farthest apart.</summary>
    static int GetLongestAxis(NodeChild* items, int count, out float lowest, out float extent)
    {
        var low = BoxMath.LoadMin(items) + BoxMath.LoadMax(items);
        var high = low;
        for (var i = 1; i < count; ++i)
        {
            var centre = BoxMath.LoadMin(items + i) + BoxMath.LoadMax(items + i);
            low = BoxMath.Min(low, centre);
            high = BoxMath.Max(high, centre);
        }
        var size = high - low;
        var axis = size.GetElement(1) > size.GetElement(0) ? 1 : 0;
        if (size.GetElement(2) > size.GetElement(axis))
            axis = 2;
        lowest = low.GetElement(axis);
        extent = size.GetElement(axis);
        return axis;
    }

    static int SortAndSplit(NodeChild* items, int count)
    {
        var axis = GetLongestAxis(items, count, out _, out _);
        var keys = stackalloc float[SortedCount];
        for (var i = 0; i < count; ++i)
        {
            var item = items[i];
            var key = ((float*)&item)[axis] + ((float*)&item)[axis + 4];
            var place = i;
            // Items in one place are in the order of their indices, so that what is built again without need comes out the same.
            while (place > 0 && (keys[place - 1] > key || (keys[place - 1] == key && items[place - 1].Index > item.Index)))
            {
                keys[place] = keys[place - 1];
                items[place] = items[place - 1];
                --place;
            }
            keys[place] = key;
            items[place] = item;
        }

        // rightCosts[i]: cost of the items from i on.
        var rightCosts = stackalloc float[SortedCount];
        var min = BoxMath.LoadMin(items + count - 1);
        var max = BoxMath.LoadMax(items + count - 1);
        var leafCount = 0;
        for (var i = count - 1; i > 0; --i)
        {
            min = BoxMath.Min(BoxMath.LoadMin(items + i), min);
            max = BoxMath.Max(BoxMath.LoadMax(items + i), max);
            leafCount += items[i].LeafCount;
            rightCosts[i] = BoxMath.HalfArea(min, max) * leafCount;
        }
        min = BoxMath.LoadMin(items);
        max = BoxMath.LoadMax(items);
        leafCount = 0;
        var best = new BestSplit(count);
        for (var i = 1; i < count; ++i)
        {
            min = BoxMath.Min(BoxMath.LoadMin(items + i - 1), min);
            max = BoxMath.Max(BoxMath.LoadMax(items + i - 1), max);
            leafCount += items[i - 1].LeafCount;
            best.Offer(BoxMath.HalfArea(min, max) * leafCount + rightCosts[i], i, i);
        }
        return best.LeftCount > 0 ? best.LeftCount : count >> 1;
    }

    /// <summary>Partitions the items into the spare array and returns how many went to the left; zero, and nothing written, when no split
    /// is any good.</summary>
    readonly int BinAndSplit(NodeChild* items, NodeChild* spare, int count)
    {
        var axis = GetLongestAxis(items, count, out var lowest, out var extent);
        if (!(extent > 0))
            return 0;
        // May overflow for the tiniest extents and vanish for the largest; BinOf has an answer to both.
        var scale = BinCount / extent;

        FillBins(items, count, axis, lowest, scale);
        var best = SweepBins(count);
        if (best.LeftCount <= 0)
            return 0;

        var left = spare;
        var right = spare + count - 1;
        for (var i = 0; i < count; ++i)
        {
            var item = items + i;
            var min = Vector128.Load((float*)item);
            var max = Vector128.Load((float*)item + 4);
            min.Store((float*)left);
            max.Store((float*)left + 4);
            min.Store((float*)right);
            max.Store((float*)right + 4);
            var toLeft = BinOf(item, axis, lowest, scale) < best.Position ? 1 : 0;
            left += toLeft;
            right += toLeft - 1;
        }
        return best.LeftCount;
    }

    static int BinOf(NodeChild* item, int axis, float lowest, float scale)
    {
        var place = (((float*)item)[axis] + ((float*)item)[axis + 4] - lowest) * scale;
        // Zero times infinity is not a number and compares as not above zero.
        if (!(place > 0))
            return 0;
        return place < BinCount - 1 ? (int)place : BinCount - 1;
    }

    readonly void FillBins(NodeChild* items, int count, int axis, float lowest, float scale)
    {
        var boxes = bins->Boxes;
        for (var i = 0; i < BinCount; ++i)
        {
            Vector128.Create(float.PositiveInfinity).Store(boxes + 8 * i);
            Vector128.Create(float.NegativeInfinity).Store(boxes + 8 * i + 4);
            bins->ItemCounts[i] = 0;
            bins->LeafCounts[i] = 0;
        }
        for (var i = 0; i < count; ++i)
        {
            var item = items + i;
            var bin = BinOf(item, axis, lowest, scale);
            var box = boxes + 8 * bin;
            BoxMath.Min(BoxMath.LoadMin(item), Vector128.Load(box)).Store(box);
            BoxMath.Max(BoxMath.LoadMax(item), Vector128.Load(box + 4)).Store(box + 4);
            ++bins->ItemCounts[bin];
            bins->LeafCounts[bin] += item->LeafCount;
        }
    }

    readonly BestSplit SweepBins(int count)
    {
        var boxes = bins->Boxes;
        var min = Vector128.Create(float.PositiveInfinity);
        var max = Vector128.Create(float.NegativeInfinity);
        var leafCount = 0;
        for (var i = BinCount - 1; i > 0; --i)
        {
            min = BoxMath.Min(Vector128.Load(boxes + 8 * i), min);
            max = BoxMath.Max(Vector128.Load(boxes + 8 * i + 4), max);
            leafCount += bins->LeafCounts[i];
            bins->RightCosts[i] = BoxMath.HalfArea(min, max) * leafCount;
        }
        min = Vector128.Create(float.PositiveInfinity);
        max = Vector128.Create(float.NegativeInfinity);
        leafCount = 0;
        var itemCount = 0;
        var best = new BestSplit(count);
        for (var i = 1; i < BinCount; ++i)
        {
            min = BoxMath.Min(Vector128.Load(boxes + 8 * (i - 1)), min);
            max = BoxMath.Max(Vector128.Load(boxes + 8 * (i - 1) + 4), max);
            leafCount += bins->LeafCounts[i - 1];
            itemCount += bins->ItemCounts[i - 1];
            if (itemCount > 0 && itemCount < count)
                best.Offer(BoxMath.HalfArea(min, max) * leafCount + bins->RightCosts[i], i, itemCount);
        }
        return best;
    }

    /// <summary>The cheapest split offered; of equal ones (points on a line cost nothing anywhere) the one nearest to the middle.</summary>
    struct BestSplit(int count)
    {
        float cost = float.PositiveInfinity;
        int imbalance = int.MaxValue;

        /// <summary>Where the right side begins; meaningful when <see cref="LeftCount"/> is not zero.</summary>
        public int Position { get; private set; }

        /// <summary>Items on the left; zero when every cost offered was infinite or not a number.</summary>
        public int LeftCount { get; private set; }

        public void Offer(float offeredCost, int position, int leftCount)
        {
            var offeredImbalance = 2 * leftCount > count ? 2 * leftCount - count : count - 2 * leftCount;
            if (!(offeredCost < cost || (offeredCost == cost && offeredImbalance < imbalance && offeredCost < float.PositiveInfinity)))
                return;
            cost = offeredCost;
            imbalance = offeredImbalance;
            Position = position;
            LeftCount = leftCount;
        }
    }
}
