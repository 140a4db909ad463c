using System;
using System.Numerics;
using System.Runtime.Intrinsics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Which joints are solved at once, in which order, and where each number of their equations is. The same until joints come or go.</summary>
// Equal structures, which have joints of the same types between the same of their bodies in the same order, have one plan, and are solved side by side.
// The equations of a structure are A x = b with A = J M^-1 J^T: a block for each joint, and one for each two that have a dynamic body in common. They are
// factored A = L D L^T, joint after joint; eliminating one makes blocks between all that are left of its neighbours. Which these are is found here, once.
unsafe partial struct DirectPlan
{
    /// <summary>Most structures that are solved side by side on any machine.</summary>
    internal const int MostLanes = 8;
    /// <summary>Most structures that are solved side by side on this one; no more than a bundle has lanes.</summary>
    internal static int Lanes => Vector512.IsHardwareAccelerated && Vector<float>.Count >= MostLanes ? MostLanes : FourLanes;
    /// <summary>Structures up to which those are solved as four that are more than one.</summary>
    internal const int FourLanes = 4;
    /// <summary>Most rows of a joint.</summary>
    internal const int MostRows = 6;
    /// <summary>Joints of a structure with loops beyond which it is left to the sweeps: the work grows with a power between two and three.</summary>
    internal const int MostJointsWithLoops = 1024;
    // Blocks that an elimination changes, per joint in the mean, beyond which a structure is left to the sweeps: a hub of forty joints, a net of twenty by
    // twenty.
    const int MostTargetsPerJoint = 256;

    /// <summary>Joints, island by island, in the order of elimination.</summary>
    internal QuickList<DirectNode> Nodes;
    /// <summary>Structures, up to <see cref="Lanes"/> equal ones as one.</summary>
    internal QuickList<DirectIsland> Islands;
    /// <summary>The joints themselves: <see cref="Lanes"/> for each node.</summary>
    internal QuickList<DirectMember> Members;
    /// <summary>Bodies, as indices in the active set with the mark of a kinematic one: <see cref="Lanes"/> for each body of each island.</summary>
    internal QuickList<int> Bodies;
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
    /// <summary>Memory that the equations take.</summary>
    internal int MemoryCount;

    // The last island of those whose structures have the same hash.
    QuickDictionary<ulong, int, HashOfHash> lastOfHash;

    /// <summary>Whether each structure is by itself, also where others are equal.</summary>
    internal bool KeepsApart;

    /// <summary>Whether any joint is solved at once.</summary>
    internal readonly bool IsEmpty => Nodes.Count == 0;

    /// <summary>The island of a member.</summary>
    internal readonly ref DirectIsland IslandOf(int member) => ref Islands[Nodes[member / Lanes].Island];

    /// <summary>Makes lists.</summary>
    internal static DirectPlan Create(BufferPool pool) => new()
    {
        Nodes = new(16, pool),
        Islands = new(4, pool),
        Members = new(16, pool),
        Bodies = new(16, pool),
        lastOfHash = new(16, pool),
        Blocks = new(16, pool),
        Targets = new(16, pool),
        Couplings = new(16, pool),
    };

    /// <summary>Adds a structure, unless its equations would take too long.</summary>
    /// <param name="joints">Its joints, with rows, and with bodies counted from zero, dynamic ones first.</param>
    /// <param name="handles">Their handles.</param>
    /// <param name="references">Its bodies, dynamic ones first.</param>
    /// <param name="dynamicCount">Number of dynamic ones.</param>
    /// <param name="pool">Memory.</param>
    /// <param name="mostJointsWithLoops">Joints of a structure with loops beyond which it is not added.</param>
    /// <returns>Whether it was added.</returns>
    internal bool TryAdd(
        ReadOnlySpan<DirectNode> joints, ReadOnlySpan<ConstraintHandle> handles, ReadOnlySpan<int> references, int dynamicCount, BufferPool pool,
        int mostJointsWithLoops = MostJointsWithLoops)
    {
        var hash = HashOf(joints, references.Length, dynamicCount);
        if (!KeepsApart && lastOfHash.TryGetValue(hash, out var last) && IsEqual(Islands[last], joints, references.Length, dynamicCount))
        {
            AddMember(ref Islands[last], handles, references);
            return true;
        }
        var before = this;
        pool.Take<int>(joints.Length + 1, out var starts);
        pool.Take<int>(joints.Length * Solver.MaximumBodiesPerConstraint, out var bodies);
        var graph = GraphOf(joints, dynamicCount, starts, bodies, pool);
        var isTree = !graph.HasLoops(joints, withBounds: true, pool);
        var isAdded = isTree || joints.Length <= mostJointsWithLoops;
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
        var firstBody = before.Bodies.Count / Lanes;
        AddCouplings(before.Nodes.Count, dynamicCount, firstBody, pool);
        ref var island = ref Islands.Allocate(pool);
        island = new()
        {
            FirstNode = before.Nodes.Count,
            EndNode = Nodes.Count,
            FirstBody = firstBody,
            EndBody = firstBody + references.Length,
            DynamicCount = dynamicCount,
            FirstNumber = before.NumberCount,
            EndNumber = NumberCount,
            FirstRow = before.RowCount,
            EndRow = RowCount,
            FirstBlock = before.Blocks.Count,
            EndBlock = Blocks.Count,
            FirstPair = before.JacobianCount,
            EndPair = JacobianCount,
            HasLoops = hasLoops,
            HasBounds = HasBounds(joints),
        };
        Members.EnsureCapacity(Nodes.Count * Lanes, pool);
        Members.Count = Nodes.Count * Lanes;
        Bodies.EnsureCapacity(island.EndBody * Lanes, pool);
        Bodies.Count = island.EndBody * Lanes;
        AddMember(ref island, handles, references);
        lastOfHash.AddAndReplace(hash, Islands.Count - 1, pool);
        return true;
    }

    /// <summary>Says where in memory the equations of each island are, when all are there.</summary>
    internal void PlaceMemory()
    {
        MemoryCount = 0;
        foreach (ref var island in Islands.AsSpan())
        {
            island.Memory = MemoryCount;
            MemoryCount += island.Lanes switch
            {
                1 => DirectMemory<OneVector, OneNumber>.SizeOf(island),
                FourLanes => DirectMemory<ManyVectors<FourNumbers>, FourNumbers>.SizeOf(island),
                _ => DirectMemory<ManyVectors<EightNumbers>, EightNumbers>.SizeOf(island),
            };
        }
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
            node.Place = order[k];
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
                ref var later = ref Nodes[Blocks[i].Joint];
                Blocks[i].Place = NumberCount;
                (Blocks[i].RowCount, Blocks[i].FirstRow) = (later.RowCount, later.FirstRow);
                NumberCount += node.RowCount * later.RowCount;
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
                Blocks[i].FirstCoupling = Couplings.Count;
                for (int slot = 0; slot < earlier.BodyCount; ++slot)
                {
                    for (int laterSlot = 0; laterSlot < later.BodyCount; ++laterSlot)
                    {
                        if (earlier.Bodies[slot] != later.Bodies[laterSlot] || earlier.Bodies[slot] >= dynamicCount)
                            continue;
                        Couplings.Add(new() { LaterSlot = laterSlot, EarlierSlot = slot }, pool);
                    }
                }
                Blocks[i].EndCoupling = Couplings.Count;
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
        Members.Dispose(pool);
        Bodies.Dispose(pool);
        Blocks.Dispose(pool);
        Targets.Dispose(pool);
        Couplings.Dispose(pool);
        lastOfHash.Dispose(pool);
        this = default;
    }
}
