using System.Runtime.CompilerServices;

namespace BepuPhysics.Trees;

/// <summary>Two children whose boxes overlap, not both leaves.</summary>
unsafe struct ChildPair
{
    public NodeChild* A, B;
}

/// <summary>Finds all pairs of overlapping leaves within a tree or between two, in any order of nodes and without memory beyond the
/// stack.</summary>
/// <remarks>
/// Where both sides of a pair are nodes, all four pairs of their children are tested at once, so that each box is loaded once. Pairs
/// within one tree start from
/// every node alike: its two children, if they overlap. Each step of the stack goes down one level of one tree at least and leaves three
/// entries
/// behind at most, so the stack's size is fixed.
/// </remarks>
static unsafe class PairTraversal<THandler, TConsumer> where TConsumer : IPairConsumer<THandler>
{
    const int StackSize = 3 * 2 * Tree.MaximumHeight + 8;
    const int ResultCapacity = 256;

    ref struct Search
    {
        public ChildPair* Stack;
        public int* ResultsA, ResultsB;
        public int StackCount, ResultCount;
        public int WorkerIndex;
        public ref THandler Handler;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Test(NodeChild* a, NodeChild* b)
        {
            if (!BoxMath.Overlaps(BoxMath.LoadMin(a), BoxMath.LoadMax(a), BoxMath.LoadMin(b), BoxMath.LoadMax(b)))
                return;
            if ((a->Index & b->Index) >= 0)
            {
                Stack[StackCount++] = new ChildPair { A = a, B = b };
                return;
            }
            ResultsA[ResultCount] = ~a->Index;
            ResultsB[ResultCount] = ~b->Index;
            if (++ResultCount == ResultCapacity)
                Flush();
        }

        public void Descend(NodeChild* childrenA, NodeChild* childrenB)
        {
            while (StackCount > 0)
            {
                var pair = Stack[--StackCount];
                var indexA = pair.A->Index;
                var indexB = pair.B->Index;
                if ((indexA | indexB) >= 0)
                {
                    var a = childrenA + 2 * indexA;
                    var b = childrenB + 2 * indexB;
                    Test(a, b);
                    Test(a, b + 1);
                    Test(a + 1, b);
                    Test(a + 1, b + 1);
                }
                else if (indexA < 0)
                {
                    var b = childrenB + 2 * indexB;
                    Test(pair.A, b);
                    Test(pair.A, b + 1);
                }
                else
                {
                    var a = childrenA + 2 * indexA;
                    Test(a, pair.B);
                    Test(a + 1, pair.B);
                }
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        public void Flush()
        {
            TConsumer.Consume(ref Handler, WorkerIndex, ResultsA, ResultsB, ResultCount);
            ResultCount = 0;
        }
    }

    /// <summary>Pairs within a tree of two leaves or more.</summary>
    public static void FindSelfPairs(in Tree tree, ref THandler handler, int workerIndex)
    {
        var stack = stackalloc ChildPair[StackSize];
        var results = stackalloc int[2 * ResultCapacity];
        var search = new Search
        {
            Stack = stack,
            ResultsA = results,
            ResultsB = results + ResultCapacity,
            WorkerIndex = workerIndex,
            Handler = ref handler
        };
        for (var node = 0; node < tree.NodeCount; ++node)
        {
            var a = tree.Children + 2 * node;
            search.Test(a, a + 1);
            search.Descend(tree.Children, tree.Children);
        }
        search.Flush();
    }

    /// <summary>Pairs between all leaves of two trees.</summary>
    public static void FindPairs(in Tree treeA, in Tree treeB, ref THandler handler, int workerIndex)
    {
        var stack = stackalloc ChildPair[StackSize];
        var results = stackalloc int[2 * ResultCapacity];
        var search = new Search
        {
            Stack = stack,
            ResultsA = results,
            ResultsB = results + ResultCapacity,
            WorkerIndex = workerIndex,
            Handler = ref handler
        };
        // The second side of a tree with a single leaf is nothing.
        var sidesA = treeA.LeafCount < 2 ? treeA.LeafCount : 2;
        var sidesB = treeB.LeafCount < 2 ? treeB.LeafCount : 2;
        for (var sideA = 0; sideA < sidesA; ++sideA)
        {
            for (var sideB = 0; sideB < sidesB; ++sideB)
                search.Test(treeA.Children + sideA, treeB.Children + sideB);
        }
        search.Descend(treeA.Children, treeB.Children);
        search.Flush();
    }
}
