using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Trees;

/// <summary>Finds all overlapping pairs within a tree in depth-first order, or between it and another tree, with runs of leaves at the
/// bottom.</summary>
/// <remarks>
/// Whether two boxes overlap is a coin toss to the branch predictor, and a lost toss costs more than the test. So a descent ends at
/// subtrees of eight leaves, and
/// from there on nothing branches on a result: which leaves of one run meet the box of the other is packed into a list of tasks, one leaf
/// against one run each;
/// tasks are done many at a time, and what they find is packed into the results in the same way.
/// <para>The stack of a descent holds one entry for each level of both trees, so its size is fixed.</para>
/// </remarks>
static unsafe class RunTraversal<THandler, TConsumer> where TConsumer : IPairConsumer<THandler>
{
    const int StackSize = 2 * Tree.MaximumHeight + 4;
    const int ResultCapacity = 512;
    const int TaskCapacity = 256;

    /// <summary>Two children whose boxes overlap, and where their leaves begin.</summary>
    struct Entry
    {
        public NodeChild* A, B;
        public int FirstA, FirstB;
    }

    /// <summary>Memory of one search.</summary>
    struct Scratch
    {
        public fixed int ResultsA[ResultCapacity];
        public fixed int ResultsB[ResultCapacity];
        public fixed int TaskPlaces[TaskCapacity];
        public fixed int TaskFirsts[TaskCapacity];
        public fixed int TaskCounts[TaskCapacity];
        public fixed byte Stack[StackSize * 24];
    }

    /// <summary>One search on one thread.</summary>
    ref struct Search
    {
        public Scratch* Scratch;
        public LeafRuns Runs;
        public int TaskCount, ResultCount;
        public int WorkerIndex;
        public ref THandler Handler;

        /// <summary>Whatever the tasks so far find goes to the handler.</summary>
        public void Finish()
        {
            RunTasks();
            Flush();
        }

        /// <summary>Each leaf of a run against those after it.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddRunWithItself(int first, int count)
        {
            var lanes = Vector256<int>.Indices;
            var places = Vector256.Create(first) + lanes;
            places.Store(Scratch->TaskPlaces + TaskCount);
            (places + Vector256<int>.One).Store(Scratch->TaskFirsts + TaskCount);
            (Vector256.Create(count - 1) - lanes).Store(Scratch->TaskCounts + TaskCount);
            EndTasks(count - 1);
        }

        /// <summary>Each leaf of run B that meets the box of run A against the leaves of A.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddRuns(NodeChild* boxA, int firstA, int firstB, int countB)
        {
            var near = Runs.FindOverlaps(boxA, firstB, countB);
            Vector256.Create(firstA).Store(Scratch->TaskFirsts + TaskCount);
            Vector256.Create(boxA->LeafCount).Store(Scratch->TaskCounts + TaskCount);
            EndTasks(Runs.Pack(Vector256.Create(firstB) + Vector256<int>.Indices, near, Scratch->TaskPlaces + TaskCount));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        void EndTasks(int added)
        {
            TaskCount += added;
            if (TaskCount > TaskCapacity - LeafRuns.RunLength)
                RunTasks();
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        void RunTasks()
        {
            var scratch = Scratch;
            var runs = Runs;
            var resultCount = ResultCount;
            for (var task = 0; task < TaskCount; ++task)
            {
                var place = scratch->TaskPlaces[task];
                var first = scratch->TaskFirsts[task];
                var mask = runs.FindOverlaps(place, first, scratch->TaskCounts[task]);
                Vector256.Create(runs.LeafIndices[place]).Store(scratch->ResultsA + resultCount);
                resultCount += runs.Pack(Vector256.Load(runs.LeafIndices + first), mask, scratch->ResultsB + resultCount);
                if (resultCount > ResultCapacity - LeafRuns.RunLength)
                {
                    ResultCount = resultCount;
                    Flush();
                    resultCount = 0;
                }
            }
            ResultCount = resultCount;
            TaskCount = 0;
        }

        /// <summary>Leaves of run A against a leaf of another tree.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void TestForeignLeaf(int firstA, int countA, NodeChild* leafB)
        {
            var mask = Runs.FindOverlaps(leafB, firstA, countA);
            Vector256.Create(~leafB->Index).Store(Scratch->ResultsB + ResultCount);
            ResultCount += Runs.Pack(Vector256.Load(Runs.LeafIndices + firstA), mask, Scratch->ResultsA + ResultCount);
            if (ResultCount > ResultCapacity - LeafRuns.RunLength)
                Flush();
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        void Flush()
        {
            TConsumer.Consume(ref Handler, WorkerIndex, Scratch->ResultsA, Scratch->ResultsB, ResultCount);
            ResultCount = 0;
        }
    }

    /// <summary>Pairs within a tree that meet in one of some nodes; a subtree that is tested as one run belongs to its first
    /// node.</summary>
    /// <param name="tree">The tree, in depth-first order.</param>
    /// <param name="runs">Its leaves.</param>
    /// <param name="firstNode">First of the nodes.</param>
    /// <param name="endNode">One past the last of the nodes.</param>
    /// <param name="leafLimit">Nodes with more leaves are left out; at least a run.</param>
    /// <param name="handler">Receives the pairs.</param>
    /// <param name="workerIndex">Passed on to the consumer.</param>
    public static void FindSelfPairs(
        in Tree tree, in LeafRuns runs, int firstNode, int endNode, int leafLimit, ref THandler handler, int workerIndex)
    {
        Scratch scratch;
        var search = new Search { Scratch = &scratch, Runs = runs, WorkerIndex = workerIndex, Handler = ref handler };
        var node = SkipStartedRun(tree, firstNode);
        while (node < endNode)
        {
            var a = tree.Children + 2 * node;
            var b = a + 1;
            var first = runs.FirstLeaves[node];
            var leafCount = a->LeafCount + b->LeafCount;
            if (leafCount <= LeafRuns.RunLength)
            {
                search.AddRunWithItself(first, leafCount);
                node += leafCount - 1;
                continue;
            }
            if (leafCount <= leafLimit && Overlap(a, b))
                DescendSelf(tree, new Entry { A = a, B = b, FirstA = first, FirstB = first + a->LeafCount }, ref search);
            ++node;
        }
        search.Finish();
    }

    /// <summary>Pairs of leaves below a pair of children of one tree that is known to overlap.</summary>
    public static void FindSelfPairsBelow(in Tree tree, in LeafRuns runs, ChildPair pair, ref THandler handler, int workerIndex)
    {
        Scratch scratch;
        var search = new Search { Scratch = &scratch, Runs = runs, WorkerIndex = workerIndex, Handler = ref handler };
        var root = new Entry { A = pair.A, B = pair.B, FirstA = GetFirst(tree, runs, pair.A), FirstB = GetFirst(tree, runs, pair.B) };
        DescendSelf(tree, root, ref search);
        search.Finish();
    }

    /// <summary>Pairs of leaves below a pair of children, of the tree with runs and of another tree, that is known to overlap.</summary>
    public static void FindPairsBelow(in Tree treeA, in LeafRuns runs, in Tree treeB, ChildPair pair, ref THandler handler, int workerIndex)
    {
        Scratch scratch;
        var search = new Search { Scratch = &scratch, Runs = runs, WorkerIndex = workerIndex, Handler = ref handler };
        DescendTwo(treeA, treeB, new Entry { A = pair.A, B = pair.B, FirstA = GetFirst(treeA, runs, pair.A) }, ref search);
        search.Finish();
    }

    /// <summary>Pairs between all leaves of the tree with runs and of another one.</summary>
    public static void FindPairs(in Tree treeA, in LeafRuns runs, in Tree treeB, ref THandler handler, int workerIndex)
    {
        // The second side of a tree with a single leaf is nothing.
        var sidesA = treeA.LeafCount < 2 ? treeA.LeafCount : 2;
        var sidesB = treeB.LeafCount < 2 ? treeB.LeafCount : 2;
        for (var sideA = 0; sideA < sidesA; ++sideA)
        {
            for (var sideB = 0; sideB < sidesB; ++sideB)
            {
                var pair = new ChildPair { A = treeA.Children + sideA, B = treeB.Children + sideB };
                if (Overlap(pair.A, pair.B))
                    FindPairsBelow(treeA, runs, treeB, pair, ref handler, workerIndex);
            }
        }
    }

    /// <summary>First node from one on that is not inside a run which began before it.</summary>
    static int SkipStartedRun(in Tree tree, int node)
    {
        while (node > 0 && node < tree.NodeCount)
        {
            var parent = tree.Children + 2 * tree.Metanodes[node].Parent;
            if (parent[0].LeafCount + parent[1].LeafCount > LeafRuns.RunLength)
                break;
            ++node;
        }
        return node;
    }

    static int GetFirst(in Tree tree, in LeafRuns runs, NodeChild* child)
    {
        if (child->Index >= 0)
            return runs.FirstLeaves[child->Index];
        var slot = (int)(child - tree.Children);
        var first = runs.FirstLeaves[slot >> 1];
        return (slot & 1) == 0 ? first : first + (child - 1)->LeafCount;
    }

    static void DescendSelf(in Tree tree, Entry root, ref Search search)
    {
        var children = tree.Children;
        var stack = (Entry*)search.Scratch->Stack;
        var count = 1;
        stack[0] = root;
        while (count > 0)
        {
            ref var entry = ref stack[--count];
            // Within one tree a pair has no order.
            var inOrder = entry.A->LeafCount >= entry.B->LeafCount;
            var larger = inOrder ? entry.A : entry.B;
            var smaller = inOrder ? entry.B : entry.A;
            var firstLarger = inOrder ? entry.FirstA : entry.FirstB;
            var firstSmaller = inOrder ? entry.FirstB : entry.FirstA;
            if (larger->LeafCount <= LeafRuns.RunLength)
            {
                search.AddRuns(larger, firstLarger, firstSmaller, smaller->LeafCount);
                continue;
            }
            var part = children + 2 * larger->Index;
            if (Overlap(part, smaller))
                stack[count++] = new Entry { A = part, B = smaller, FirstA = firstLarger, FirstB = firstSmaller };
            if (Overlap(part + 1, smaller))
                stack[count++] = new Entry { A = part + 1, B = smaller, FirstA = firstLarger + part->LeafCount, FirstB = firstSmaller };
        }
    }

    static void DescendTwo(in Tree treeA, in Tree treeB, Entry root, ref Search search)
    {
        var stack = (Entry*)search.Scratch->Stack;
        var count = 1;
        stack[0] = root;
        while (count > 0)
        {
            var entry = stack[--count];
            var leavesA = entry.A->LeafCount;
            var leavesB = entry.B->LeafCount;
            if (leavesA <= LeafRuns.RunLength && leavesB == 1)
            {
                search.TestForeignLeaf(entry.FirstA, leavesA, entry.B);
            }
            else if (leavesA > LeafRuns.RunLength && leavesA >= leavesB)
            {
                var a = treeA.Children + 2 * entry.A->Index;
                if (Overlap(a, entry.B))
                    stack[count++] = new Entry { A = a, B = entry.B, FirstA = entry.FirstA };
                if (Overlap(a + 1, entry.B))
                    stack[count++] = new Entry { A = a + 1, B = entry.B, FirstA = entry.FirstA + a->LeafCount };
            }
            else
            {
                var b = treeB.Children + 2 * entry.B->Index;
                if (Overlap(entry.A, b))
                    stack[count++] = new Entry { A = entry.A, B = b, FirstA = entry.FirstA };
                if (Overlap(entry.A, b + 1))
                    stack[count++] = new Entry { A = entry.A, B = b + 1, FirstA = entry.FirstA };
            }
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool Overlap(NodeChild* a, NodeChild* b) =>
        BoxMath.Overlaps(BoxMath.LoadMin(a), BoxMath.LoadMax(a), BoxMath.LoadMin(b), BoxMath.LoadMax(b));
}
