using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

// Where a leaf goes: the cost of a tree is the summed surface of its inner nodes. Hanging the leaf beside a child c costs the surface of a
// new node around both; going down into c costs the growth of c now and at least the surface of the leaf further down. The cheapest of the
// four ways at a node is taken until it is a stop; ties go down, and to the side with fewer leaves, which keeps equal boxes balanced.
public unsafe partial struct Tree
{
    /// <summary>Inserts a leaf, rotating nodes on its way where that makes the tree cheaper, and returns its index: the present leaf
    /// count.</summary>
    public int Add(BoundingBox bounds, BufferPool pool) => Insert(bounds, pool, rotates: true);

    /// <summary>Inserts a leaf without rotations and returns its index: the present leaf count. For many leaves that a build or refinement
    /// follows.</summary>
    public int AddWithoutRefinement(BoundingBox bounds, BufferPool pool) => Insert(bounds, pool, rotates: false);

    int Insert(BoundingBox bounds, BufferPool pool, bool rotates)
    {
        ArgumentNullException.ThrowIfNull(pool);
        BoxMath.RequireBox(bounds.Min, bounds.Max);
        if (LeafCount == MaximumLeafCount)
            throw new InvalidOperationException($"A tree holds at most {MaximumLeafCount} leaves.");
        if (LeafCount == Leaves.Length)
            Reallocate(LeafCount < 8 ? 16 : LeafCount * 2, pool);

        var leafIndex = LeafCount;
        var leaf = new NodeChild { Min = bounds.Min, Max = bounds.Max, Index = ~leafIndex, LeafCount = 1 };
        if (leafIndex == 0)
        {
            WriteSingleLeaf(leaf);
            isDepthFirst = true;
        }
        else if (leafIndex == 1)
        {
            Nodes[0].B = leaf;
            Leaves[1].Slot = 1;
        }
        else
        {
            InsertBeside(FindSibling(&leaf), &leaf, leafIndex - 1);
        }
        ++LeafCount;
        if (leafIndex > 1)
            TidyAncestors(leafIndex - 1, rotates, pool);
        return leafIndex;
    }

    /// <summary>Slot whose content becomes the leaf's sibling, -1 for the whole tree. Counts the leaf in, and grows, every child passed on
    /// the way.</summary>
    readonly int FindSibling(NodeChild* leaf)
    {
        var children = Children;
        var leafMin = BoxMath.LoadMin(leaf);
        var leafMax = BoxMath.LoadMax(leaf);
        var leafArea = BoxMath.HalfArea(leafMin, leafMax);

        var rootMin = BoxMath.Min(BoxMath.LoadMin(children), BoxMath.LoadMin(children + 1));
        var rootMax = BoxMath.Max(BoxMath.LoadMax(children), BoxMath.LoadMax(children + 1));
        var rootArea = BoxMath.HalfArea(rootMin, rootMax);

        var node = 0;
        while (true)
        {
            var a = children + 2 * node;
            var b = a + 1;
            var stopA = BoxMath.HalfArea(BoxMath.Min(leafMin, BoxMath.LoadMin(a)), BoxMath.Max(leafMax, BoxMath.LoadMax(a)));
            var stopB = BoxMath.HalfArea(BoxMath.Min(leafMin, BoxMath.LoadMin(b)), BoxMath.Max(leafMax, BoxMath.LoadMax(b)));
            var downA = a->Index < 0 ? float.PositiveInfinity : stopA - BoxMath.HalfArea(a) + leafArea;
            var downB = b->Index < 0 ? float.PositiveInfinity : stopB - BoxMath.HalfArea(b) + leafArea;
            var bestA = downA <= stopA ? downA : stopA;
            var bestB = downB <= stopB ? downB : stopB;
            // Beside the root means one more node around everything; on any other way the root only grows to that size, so its own surface
            // is the difference.
            if (node == 0 && rootArea < bestA && rootArea < bestB && MayBecomeSibling(0, LeafCount))
                return -1;
            var takeB = bestB < bestA || (!(bestA < bestB) && b->LeafCount < a->LeafCount);
            var child = takeB ? b : a;
            var goesDown = takeB ? downB <= stopB : downA <= stopA;
            if (child->Index < 0 || (!goesDown && MayBecomeSibling(child->Index, child->LeafCount)))
                return 2 * node + (takeB ? 1 : 0);
            BoxMath.StoreBox(child, BoxMath.Min(leafMin, BoxMath.LoadMin(child)), BoxMath.Max(leafMax, BoxMath.LoadMax(child)));
            ++child->LeafCount;
            node = child->Index;
        }
    }

    /// <summary>
    /// Whether a leaf may hang beside a node. Boxes that grow would all hang beside the root and make a list of it, to be rebuilt again
    /// and again;
    /// where a node is too high for its size already, the leaf goes further down, where a rebuild is cheap.
    /// </summary>
    readonly bool MayBecomeSibling(int node, int leafCount) => Metanodes[node].Height < BalancedHeight(leafCount);

    /// <summary>Makes a node of what hangs at a slot and a leaf, and hangs it there.</summary>
    readonly void InsertBeside(int slot, NodeChild* leaf, int newNode)
    {
        var children = Children;
        if (slot < 0)
        {
            // The root keeps its index, so its content moves to the new node and becomes one side of it.
            Nodes[newNode] = Nodes[0];
            Metanodes[newNode] = new Metanode { ParentSlot = 0, Height = Metanodes[0].Height };
            var moved = children + 2 * newNode;
            LinkToSlot(2 * newNode);
            LinkToSlot(2 * newNode + 1);
            BoxMath.Store(children,
                BoxMath.Min(BoxMath.LoadMin(moved), BoxMath.LoadMin(moved + 1)),
                BoxMath.Max(BoxMath.LoadMax(moved), BoxMath.LoadMax(moved + 1)),
                newNode, moved[0].LeafCount + moved[1].LeafCount);
            children[1] = *leaf;
            LinkToSlot(1);
            return;
        }

        var child = children + slot;
        var pair = children + 2 * newNode;
        pair[0] = *child;
        pair[1] = *leaf;
        LinkToSlot(2 * newNode);
        LinkToSlot(2 * newNode + 1);
        BoxMath.Store(child,
            BoxMath.Min(BoxMath.LoadMin(pair), BoxMath.LoadMin(pair + 1)),
            BoxMath.Max(BoxMath.LoadMax(pair), BoxMath.LoadMax(pair + 1)),
            newNode, pair[0].LeafCount + 1);
        Metanodes[newNode] = new Metanode { ParentSlot = slot, Height = MeasureHeight(newNode) };
    }

    /// <summary>Brings heights up to date from a new node to the root, rotating on the way; rebuilds where the tree has become too
    /// deep.</summary>
    void TidyAncestors(int newNode, bool rotates, BufferPool pool)
    {
        isDepthFirst = false;
        for (var node = newNode; node >= 0; node = Metanodes[node].Parent)
        {
            Metanodes[node].Height = MeasureHeight(node);
            if (rotates)
                Rotate(node);
        }
        // Once is enough for the path of the leaf; a rotation may have pushed a second one over the edge.
        while (Metanodes[0].Height > MaximumHeight)
            RebuildTooDeep(pool);
    }

    /// <summary>
    /// Exchanges one child of a node with a child of the other where that shrinks the node in between most. Afterwards the node is no
    /// higher
    /// than before, or than a fairly balanced tree of its size.
    /// </summary>
    readonly void Rotate(int node)
    {
        var children = Children;
        var slotA = 2 * node;
        var allowedHeight = Metanodes[node].Height;
        var balanced = BalancedHeight(children[slotA].LeafCount + children[slotA + 1].LeafCount);
        if (balanced > allowedHeight)
            allowedHeight = balanced;

        var bestGain = 0f;
        var bestUpper = -1;
        var bestLower = -1;
        for (var side = 0; side < 2; ++side)
        {
            // The upper child goes down into the lower parent in exchange for one of the two below it; the other one stays.
            var upper = slotA + side;
            var lowerParent = slotA + 1 - side;
            if (children[lowerParent].Index < 0)
                continue;
            var area = BoxMath.HalfArea(children + lowerParent);
            var firstLower = 2 * children[lowerParent].Index;
            for (var i = 0; i < 2; ++i)
            {
                var lower = firstLower + i;
                var staying = firstLower + 1 - i;
                var gain = area - BoxMath.UnionHalfArea(children + upper, children + staying);
                if (!(gain > bestGain))
                    continue;
                var upperHeight = HeightOf(children + upper);
                var stayingHeight = HeightOf(children + staying);
                var pairHeight = 1 + (upperHeight > stayingHeight ? upperHeight : stayingHeight);
                var lowerHeight = HeightOf(children + lower);
                if (1 + (pairHeight > lowerHeight ? pairHeight : lowerHeight) > allowedHeight)
                    continue;
                bestGain = gain;
                bestUpper = upper;
                bestLower = lower;
            }
        }
        if (bestUpper >= 0)
            Exchange(node, bestUpper, bestLower);
    }

    readonly void Exchange(int node, int upper, int lower)
    {
        var children = Children;
        (children[upper], children[lower]) = (children[lower], children[upper]);
        LinkToSlot(upper);
        LinkToSlot(lower);
        var between = lower >> 1;
        Metanodes[between].Height = MeasureHeight(between);
        FitSlotToNode(between);
        Metanodes[node].Height = MeasureHeight(node);
    }

    /// <summary>A height that a reasonable tree of so many leaves stays below; halving needs about half of it.</summary>
    static int BalancedHeight(int leafCount) => 2 * HalvingHeight(leafCount) + 2;

    /// <summary>Height of a tree that is halved all the way down: the logarithm to base two, rounded up.</summary>
    internal static int HalvingHeight(int leafCount) => leafCount <= 1 ? 0 : 32 - BitOperations.LeadingZeroCount((uint)(leafCount - 1));

    /// <summary>
    /// Follows the longest path down from the root to the smallest subtree that is far too deep for its size and rebuilds it. The limits
    /// make
    /// sure that there is one and that its rebuilding lowers the root: 2 log n + 2 after it against more than 2 log n + 6 before it.
    /// </summary>
    void RebuildTooDeep(BufferPool pool)
    {
        var children = Children;
        var chosen = 0;
        var node = 0;
        while (true)
        {
            var a = children + 2 * node;
            if (Metanodes[node].Height > BalancedHeight(a[0].LeafCount + a[1].LeafCount) + 4)
                chosen = node;
            var next = HeightOf(a) >= HeightOf(a + 1) ? a : a + 1;
            if (next->Index < 0)
                break;
            node = next->Index;
        }
        var count = children[2 * chosen].LeafCount + children[2 * chosen + 1].LeafCount;
        RebuildSubtree(chosen, BalancedHeight(count), pool);
        UpdateAncestorHeights(chosen);
    }

    readonly void UpdateAncestorHeights(int node)
    {
        for (var parent = Metanodes[node].Parent; parent >= 0; parent = Metanodes[parent].Parent)
        {
            var height = MeasureHeight(parent);
            if (height == Metanodes[parent].Height)
                return;
            Metanodes[parent].Height = height;
        }
    }
}
