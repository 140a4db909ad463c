using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The work of finding overlaps, cut into pieces of bounded size.</summary>
unsafe struct OverlapPieces
{
    /// <summary>Two children that are known to overlap; the second is of the static tree if so marked.</summary>
    public struct Pair
    {
        public ChildPair Children;
        public bool IsStatic;
    }

    /// <summary>Pairs that are pieces of their own.</summary>
    public QuickList<Pair> Pairs;

    /// <summary>
    /// All pieces as they are to be handed out, a pair by its index, a range by the complement of its own. Of each part of the tree first come the pairs, which
    /// are larger, and then the ranges.
    /// </summary>
    // A worker that begins with the same part in each step finds its bodies, their pairs and their constraints in its own cache; those of one body lie side by
    // side, and would be taken from one processor to the other where the pairs with the ground were one worker's and those among bodies another's.
    public QuickList<int> Order;

    /// <summary>Nodes of the active tree with more leaves than this are not part of any range: their pairs are in the list.</summary>
    public int LeafLimit { get; }

    /// <summary>Number of ranges that the nodes of the active tree are divided into.</summary>
    public int RangeCount { get; }

    // Ranges come last, and there is nothing to be cut for them: short ones let all workers end at the same time.
    const int RangesPerPiece = 4;

    readonly int nodeCount;

    /// <summary>Cuts the work into at least about a number of pieces.</summary>
    /// <param name="activeTree">Tree whose leaves are in each pair.</param>
    /// <param name="staticTree">Tree of what does not move.</param>
    /// <param name="targetCount">Least number of pieces.</param>
    /// <param name="workerCount">Number of parts of the active tree, one after the other, of which each worker has one.</param>
    /// <param name="pool">Memory of the pieces.</param>
    public OverlapPieces(in Tree activeTree, in Tree staticTree, int targetCount, int workerCount, BufferPool pool)
    {
        nodeCount = activeTree.NodeCount;
        RangeCount = RangesPerPiece * targetCount < nodeCount ? RangesPerPiece * targetCount : nodeCount;
        LeafLimit = activeTree.LeafCount / targetCount;
        if (LeafLimit < 32)
            LeafLimit = 32;
        Pairs = new QuickList<Pair>(4 * targetCount, pool);
        AddLargeNodes(activeTree, pool);
        AddRoots(activeTree, staticTree, pool);
        Arrange(activeTree, workerCount, pool);
    }

    public void Dispose(BufferPool pool)
    {
        Pairs.DisposeIfTaken(pool);
        Order.DisposeIfTaken(pool);
    }

    void Arrange(in Tree tree, int partCount, BufferPool pool)
    {
        var places = stackalloc int[partCount];
        for (var part = 0; part < partCount; ++part)
            places[part] = FirstRange(part + 1, partCount) - FirstRange(part, partCount);
        for (var i = 0; i < Pairs.Count; ++i)
            ++places[PartOf(Pairs[i], tree, partCount)];
        var sum = 0;
        for (var part = 0; part < partCount; ++part)
        {
            sum += places[part];
            places[part] = sum - places[part];
        }
        Order = new QuickList<int>(sum, pool) { Count = sum };
        for (var i = 0; i < Pairs.Count; ++i)
            Order[places[PartOf(Pairs[i], tree, partCount)]++] = i;
        for (var part = 0; part < partCount; ++part)
        {
            for (var range = FirstRange(part, partCount); range < FirstRange(part + 1, partCount); ++range)
                Order[places[part]++] = ~range;
        }
    }

    readonly int FirstRange(int part, int partCount) => (int)((long)RangeCount * part / partCount);

    readonly int PartOf(in Pair pair, in Tree tree, int partCount) => (int)((long)PlaceOf(pair, tree) * partCount / nodeCount);

    // The node of the larger side, or the one that a lone leaf hangs on.
    static int PlaceOf(in Pair pair, in Tree tree)
    {
        var child = pair.IsStatic || pair.Children.A->LeafCount >= pair.Children.B->LeafCount ? pair.Children.A : pair.Children.B;
        return child->Index >= 0 ? child->Index : (int)(child - tree.Children) / 2;
    }

    /// <summary>Nodes of a range.</summary>
    public readonly void GetRange(int range, out int firstNode, out int endNode)
    {
        firstNode = (int)((long)nodeCount * range / RangeCount);
        endNode = (int)((long)nodeCount * (range + 1) / RangeCount);
    }

    void AddLargeNodes(in Tree tree, BufferPool pool)
    {
        var stack = stackalloc int[Tree.TraversalStackSize];
        var count = 0;
        if (tree.LeafCount > LeafLimit)
            stack[count++] = 0;
        while (count > 0)
        {
            var a = tree.Children + 2 * stack[--count];
            var b = a + 1;
            if (Overlap(a, b))
                Split(new Pair { Children = new ChildPair { A = a, B = b } }, tree, tree, pool);
            if (a->LeafCount > LeafLimit)
                stack[count++] = a->Index;
            if (b->LeafCount > LeafLimit)
                stack[count++] = b->Index;
        }
    }

    void AddRoots(in Tree activeTree, in Tree staticTree, BufferPool pool)
    {
        var staticSides = staticTree.LeafCount < 2 ? staticTree.LeafCount : 2;
        for (var sideA = 0; sideA < 2; ++sideA)
        {
            for (var sideB = 0; sideB < staticSides; ++sideB)
            {
                var pair = new ChildPair { A = activeTree.Children + sideA, B = staticTree.Children + sideB };
                if (Overlap(pair.A, pair.B))
                    Split(new Pair { Children = pair, IsStatic = true }, activeTree, staticTree, pool);
            }
        }
    }

    /// <summary>Divides the larger side of overlapping pairs until a pair is cheap: its cost grows with both sides.</summary>
    // It has as many leaves as the smaller side where two subtrees only meet at a face, but as many as the larger one where the other is a ground.
    void Split(Pair pair, in Tree treeA, in Tree treeB, BufferPool pool)
    {
        var stack = stackalloc ChildPair[2 * Tree.TraversalStackSize];
        var count = 1;
        stack[0] = pair.Children;
        while (count > 0)
        {
            var children = stack[--count];
            var leavesA = children.A->LeafCount;
            var leavesB = children.B->LeafCount;
            if (2 * (leavesA < leavesB ? leavesA : leavesB) <= LeafLimit && (leavesA < leavesB ? leavesB : leavesA) <= LeafLimit)
            {
                Pairs.Add(new Pair { Children = children, IsStatic = pair.IsStatic }, pool);
                continue;
            }
            // The same choice as in the traversal.
            var dividesB = leavesA < leavesB;
            var part = dividesB ? treeB.Children + 2 * children.B->Index : treeA.Children + 2 * children.A->Index;
            for (var i = 0; i < 2; ++i, ++part)
            {
                if (Overlap(part, dividesB ? children.A : children.B))
                    stack[count++] = dividesB ? new ChildPair { A = children.A, B = part } : new ChildPair { A = part, B = children.B };
            }
        }
    }

    static bool Overlap(NodeChild* a, NodeChild* b) =>
        BoxMath.Overlaps(BoxMath.LoadMin(a), BoxMath.LoadMax(a), BoxMath.LoadMin(b), BoxMath.LoadMax(b));
}
