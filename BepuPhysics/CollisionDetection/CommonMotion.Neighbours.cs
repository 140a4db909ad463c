using System;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// Whom all bodies meet, found at once.
//
// Where kinematic bodies are many beside all others, as lifts and platforms that carry a thing or two each, most of what is awake is
// asked for what its bounds overlap. One by one that is a way from the root of a tree for each, which takes more than all else that is done
// with it. All pairs of a tree are found in a fifth of the time, by runs of leaves. Whoever is asked, and how, finds the same, in another
// order, on which nothing depends.
sealed unsafe partial class CommonMotion
{
    // Pairs per body from which on they are not listed: of what lies in one heap each body meets many, and the first that does not move
    // along ends its search.
    const int PairsPerBody = 8;

    // Where those that each active leaf meets begin, and they themselves; not there where bodies are asked one by one.
    Buffer<int> firstNeighbours;
    Buffer<CollidableReference> neighbours;

    /// <summary>
    /// Bodies that are awake for each kinematic one that moves, up to which those that all of them meet are found at once: each kinematic
    /// one is asked with what it carries, and a search takes some four times what the share of a body in all pairs takes. Tests ask in
    /// either way, to the same bits.
    /// </summary>
    internal int BodiesPerKinematic = 4;

    void FindNeighbours(int kinematicCount)
    {
        var broadPhase = simulation.BroadPhase;
        var leafCount = broadPhase.ActiveTree.LeafCount;
        if ((long)kinematicCount * BodiesPerKinematic < leafCount)
            return;
        var collector = new PairCollector { Pairs = new QuickList<ulong>(leafCount, pool), Pool = pool, Most = leafCount * PairsPerBody };
        broadPhase.FindOverlapsOfLeaves(ref collector, null);
        if (collector.Count <= collector.Most)
            List(collector.Pairs, leafCount);
        collector.Pairs.Dispose(pool);
    }

    // By counting.
    void List(in QuickList<ulong> pairs, int leafCount)
    {
        pool.TakeAtLeast(leafCount + 2, out firstNeighbours);
        firstNeighbours.Clear(0, leafCount + 2);
        pool.TakeAtLeast(Math.Max(1, 2 * pairs.Count), out neighbours);
        foreach (var pair in pairs.AsSpan())
        {
            ++firstNeighbours[LeafA(pair) + 2];
            if (!IsStatic(pair))
                ++firstNeighbours[LeafB(pair) + 2];
        }
        for (int i = 2; i < leafCount + 2; ++i)
            firstNeighbours[i] += firstNeighbours[i - 1];
        // Each place is where the leaf before ends once all are written.
        var (active, still) = (simulation.BroadPhase.ActiveLeaves, simulation.BroadPhase.StaticLeaves);
        foreach (var pair in pairs.AsSpan())
        {
            var (a, b) = (LeafA(pair), LeafB(pair));
            neighbours[firstNeighbours[a + 1]++] = IsStatic(pair) ? still[b] : active[b];
            if (!IsStatic(pair))
                neighbours[firstNeighbours[b + 1]++] = active[a];
        }
    }

    void ForgetNeighbours()
    {
        pool.ReturnIfTaken(ref neighbours);
        pool.ReturnIfTaken(ref firstNeighbours);
    }

    void AskNeighbours(ref Near near)
    {
        var leaf = Awake.Collidables[near.Self].BroadPhaseIndex;
        for (int i = firstNeighbours[leaf]; i < firstNeighbours[leaf + 1]; ++i)
        {
            if (!near.LoopBody(neighbours[i]))
                return;
        }
    }

    static int LeafA(ulong pair) => (int)(pair >> 32);

    static int LeafB(ulong pair) => (int)((uint)pair >> 1);

    static bool IsStatic(ulong pair) => (pair & 1) != 0;

    // Two leaves of a pair, of which the second is followed by a bit that says whether it is of the static tree.
    struct PairCollector : IBroadPhaseOverlapHandler
    {
        public QuickList<ulong> Pairs;
        public BufferPool Pool;
        public int Count;
        public int Most;

        public void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic)
        {
            if (++Count <= Most)
                Pairs.Add((ulong)(uint)leafA << 32 | (uint)leafB << 1 | (bIsStatic ? 1u : 0), Pool);
        }
    }
}
