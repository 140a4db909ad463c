using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Which joints are solved at once, in which order, and where each number of their equations is. The same until joints come or go.</summary>
// The equations of a structure are A x = b with A = J M^-1 J^T: a block for each joint, and one for each two that have a dynamic body in common. They are
// factored A = L D L^T, joint after joint; eliminating one makes blocks between all that are left of its neighbours. Which these are is found here, once.
unsafe struct DirectPlan
{
    /// <summary>Joints of a structure with loops beyond which it is left to the sweeps: the work grows with a power between two and three.</summary>
    internal const int MostJointsWithLoops = 1024;
    // Blocks that an elimination changes, per joint in the mean, beyond which a structure is left to the sweeps: a hub of forty joints, a net of twenty by
    // twenty.
    const int MostTargetsPerJoint = 256;

    /// <summary>Joints, island by island, in the order of elimination.</summary>
    internal QuickList<DirectNode> Nodes;
    /// <summary>Structures.</summary>
    internal QuickList<DirectIsland> Islands;
    /// <summary>Bodies.</summary>
    internal QuickList<DirectBody> Bodies;
    /// <summary>Blocks below the diagonal.</summary>
    internal QuickList<DirectBlock> Blocks;
    /// <summary>Places of the blocks that an elimination changes: for each block below it, those with itself and the ones before it.</summary>
    internal QuickList<int> Targets;
    /// <summary>What makes the blocks.</summary>
    internal QuickList<DirectCoupling> Couplings;
    /// <summary>Numbers of all blocks.</summary>
    internal int NumberCount;
    /// <summary>Rows of all joints.</summary>
    internal int RowCount;
    /// <summary>Pairs of all Jacobians.</summary>
    internal int JacobianCount;

    /// <summary>Whether any joint is solved at once.</summary>
    internal readonly bool IsEmpty => Nodes.Count == 0;

    /// <summary>Makes lists.</summary>
    internal static DirectPlan Create(BufferPool pool) => new()
    {
        Nodes = new(16, pool),
        Islands = new(4, pool),
        Bodies = new(16, pool),
        Blocks = new(16, pool),
        Targets = new(16, pool),
        Couplings = new(16, pool),
    };

    /// <summary>Adds a structure, unless its equations would take too long.</summary>
    /// <param name="joints">Its joints, with rows, and with bodies counted from zero, dynamic ones first.</param>
    /// <param name="references">Its bodies, dynamic ones first.</param>
    /// <param name="dynamicCount">Number of dynamic ones.</param>
    /// <param name="pool">Memory.</param>
    /// <returns>Whether it was added.</returns>
    internal bool TryAdd(ReadOnlySpan<DirectNode> joints, ReadOnlySpan<int> references, int dynamicCount, BufferPool pool)
    {
        var before = this;
        pool.Take<int>(joints.Length + 1, out var starts);
        pool.Take<int>(joints.Length * Solver.MaximumBodiesPerConstraint, out var bodies);
        var graph = GraphOf(joints, dynamicCount, starts, bodies, pool);
        var isTree = !graph.HasLoops(joints, withBounds: true, pool);
        var isAdded = isTree || joints.Length <= MostJointsWithLoops;
        if (isAdded)
        {
            pool.Take<int>(joints.Length, out var order);
            Span<int> ordered = new(order.Memory, joints.Length);
            if (isTree)
                EliminationOrder.OfTree(graph, ordered, pool);
            else
                EliminationOrder.ByDegree(graph, ordered, pool);
            isAdded = TryArrange(joints, graph, ordered, pool);
            pool.Return(ref order);
        }
        // Those that have bounds may be beside a joint that holds both ways, and do not make it give.
        var hasLoops = isAdded && !isTree && graph.HasLoops(joints, withBounds: false, pool);
        graph.Dispose(pool);
        pool.Return(ref bodies);
        pool.Return(ref starts);
        if (!isAdded)
        {
            TakeBack(before);
            return false;
        }
        foreach (var reference in references)
            Bodies.Add(new() { Reference = reference }, pool);
        AddCouplings(before.Nodes.Count, dynamicCount, before.Bodies.Count, pool);
        Islands.Add(new()
        {
            FirstNode = before.Nodes.Count,
            EndNode = Nodes.Count,
            FirstBody = before.Bodies.Count,
            EndBody = Bodies.Count,
            FirstCoupling = before.Couplings.Count,
            EndCoupling = Couplings.Count,
            FirstNumber = before.NumberCount,
            EndNumber = NumberCount,
            FirstRow = before.RowCount,
            EndRow = RowCount,
            HasLoops = hasLoops,
            HasBounds = HasBounds(joints),
        }, pool);
        return true;
    }

    internal static bool HasBounds(ReadOnlySpan<DirectNode> joints)
    {
        foreach (ref readonly var joint in joints)
        {
            if (joint.HasBounds)
                return true;
        }
        return false;
    }

    // Lists may have grown, and keep what they have.
    void TakeBack(in DirectPlan before)
    {
        Nodes.Count = before.Nodes.Count;
        Blocks.Count = before.Blocks.Count;
        Targets.Count = before.Targets.Count;
        NumberCount = before.NumberCount;
        RowCount = before.RowCount;
        JacobianCount = before.JacobianCount;
    }

    static JointGraph GraphOf(ReadOnlySpan<DirectNode> joints, int dynamicCount, Buffer<int> starts, Buffer<int> bodies, BufferPool pool)
    {
        int count = 0;
        for (int i = 0; i < joints.Length; ++i)
        {
            starts[i] = count;
            for (int slot = 0; slot < joints[i].BodyCount; ++slot)
            {
                if (joints[i].Bodies[slot] < dynamicCount)
                    bodies[count++] = joints[i].Bodies[slot];
            }
        }
        starts[joints.Length] = count;
        return new(joints.Length, dynamicCount, starts, bodies, pool);
    }

    // What is left of a joint's neighbours when it is eliminated: those that it has from the beginning, and those of the joints that were eliminated before
    // it and whose first one left was it. Places in the order are counted from that of the first joint.
    bool TryArrange(ReadOnlySpan<DirectNode> joints, in JointGraph graph, ReadOnlySpan<int> order, BufferPool pool)
    {
        var first = Nodes.Count;
        var count = order.Length;
        long targets = 0;
        pool.Take<int>(count * 4, out var scratch);
        var place = scratch.Slice(0, count);
        var firstChild = scratch.Slice(count, count);
        var nextChild = scratch.Slice(2 * count, count);
        var seenBy = scratch.Slice(3 * count, count);
        for (int i = 0; i < count; ++i)
        {
            place[order[i]] = i;
            firstChild[i] = seenBy[i] = -1;
        }
        var fits = true;
        for (int k = 0; k < count && fits; ++k)
        {
            var node = joints[order[k]];
            node.FirstRow = RowCount;
            node.Jacobian = JacobianCount;
            node.Diagonal = NumberCount;
            node.FirstBlock = Blocks.Count;
            RowCount += node.RowCount;
            JacobianCount += node.RowCount * node.BodyCount;
            NumberCount += node.RowCount * node.RowCount;
            seenBy[k] = k;
            foreach (var body in graph.BodiesOf(order[k]))
            {
                foreach (var joint in graph.JointsOf(body))
                    AddBlock(place[joint], k, seenBy, first, pool);
            }
            for (int child = firstChild[k]; child >= 0; child = nextChild[child])
            {
                var (start, end) = (Nodes[first + child].FirstBlock, Nodes[first + child].FirstBlock + Nodes[first + child].BlockCount);
                for (int i = start; i < end; ++i)
                    AddBlock(Blocks[i].Joint - first, k, seenBy, first, pool);
            }
            node.BlockCount = Blocks.Count - node.FirstBlock;
            Nodes.Add(node, pool);
            SortBlocks(node);
            if (node.BlockCount > 0)
            {
                var parent = Blocks[node.FirstBlock].Joint - first;
                nextChild[k] = firstChild[parent];
                firstChild[parent] = k;
            }
            targets += node.BlockCount * (node.BlockCount + 1) / 2;
            fits = targets <= (long)MostTargetsPerJoint * count;
        }
        pool.Return(ref scratch);
        if (fits)
        {
            PlaceBlocks(first);
            AddTargets(first, pool);
        }
        return fits;
    }

    void AddBlock(int place, int k, Buffer<int> seenBy, int first, BufferPool pool)
    {
        if (place <= k || seenBy[place] == k)
            return;
        seenBy[place] = k;
        Blocks.Add(new() { Joint = first + place }, pool);
    }

    readonly void SortBlocks(in DirectNode node) =>
        new Span<DirectBlock>(Blocks.Span.Memory + node.FirstBlock, node.BlockCount).Sort(static (a, b) => a.Joint.CompareTo(b.Joint));

    void PlaceBlocks(int first)
    {
        for (int k = first; k < Nodes.Count; ++k)
        {
            ref var node = ref Nodes[k];
            for (int i = node.FirstBlock; i < node.FirstBlock + node.BlockCount; ++i)
            {
                Blocks[i].Place = NumberCount;
                NumberCount += node.RowCount * Nodes[Blocks[i].Joint].RowCount;
            }
        }
    }

    // Eliminating a joint changes the block of each two that are left, which is in the column of the one that goes first of the two.
    void AddTargets(int first, BufferPool pool)
    {
        var count = Nodes.Count - first;
        pool.Take<int>(count, out var placeOf);
        for (int k = first; k < Nodes.Count; ++k)
        {
            ref var node = ref Nodes[k];
            node.FirstTarget = Targets.Count;
            // Triangular: the places of block a with blocks 0 to a.
            Targets.EnsureCapacity(Targets.Count + node.BlockCount * (node.BlockCount + 1) / 2, pool);
            Targets.Count += node.BlockCount * (node.BlockCount + 1) / 2;
            for (int b = 0; b < node.BlockCount; ++b)
            {
                var earlier = Blocks[node.FirstBlock + b].Joint;
                ReadPlaces(earlier, first, placeOf);
                for (int a = b; a < node.BlockCount; ++a)
                    Targets[node.FirstTarget + a * (a + 1) / 2 + b] = placeOf[Blocks[node.FirstBlock + a].Joint - first];
            }
        }
        pool.Return(ref placeOf);
    }

    readonly void ReadPlaces(int column, int first, Buffer<int> placeOf)
    {
        ref var node = ref Nodes[column];
        placeOf[column - first] = node.Diagonal;
        for (int i = node.FirstBlock; i < node.FirstBlock + node.BlockCount; ++i)
            placeOf[Blocks[i].Joint - first] = Blocks[i].Place;
    }

    // Bodies of the nodes become places in the list of the plan.
    void AddCouplings(int first, int dynamicCount, int firstBody, BufferPool pool)
    {
        for (int k = first; k < Nodes.Count; ++k)
        {
            ref var earlier = ref Nodes[k];
            for (int i = earlier.FirstBlock; i < earlier.FirstBlock + earlier.BlockCount; ++i)
            {
                ref var later = ref Nodes[Blocks[i].Joint];
                for (int slot = 0; slot < earlier.BodyCount; ++slot)
                {
                    for (int laterSlot = 0; laterSlot < later.BodyCount; ++laterSlot)
                    {
                        if (earlier.Bodies[slot] != later.Bodies[laterSlot] || earlier.Bodies[slot] >= dynamicCount)
                            continue;
                        Couplings.Add(new()
                        {
                            Place = Blocks[i].Place,
                            Later = Blocks[i].Joint,
                            Earlier = k,
                            LaterSlot = laterSlot,
                            EarlierSlot = slot,
                        }, pool);
                    }
                }
            }
        }
        for (int k = first; k < Nodes.Count; ++k)
        {
            ref var node = ref Nodes[k];
            node.Island = Islands.Count;
            for (int slot = 0; slot < node.BodyCount; ++slot)
                node.Bodies[slot] += firstBody;
        }
    }

    internal void Dispose(BufferPool pool)
    {
        if (!Nodes.Span.Allocated)
            return;
        Nodes.Dispose(pool);
        Islands.Dispose(pool);
        Bodies.Dispose(pool);
        Blocks.Dispose(pool);
        Targets.Dispose(pool);
        Couplings.Dispose(pool);
        this = default;
    }
}
