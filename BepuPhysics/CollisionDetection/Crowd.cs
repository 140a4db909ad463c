using System;
using System.Runtime.CompilerServices;
using System.Threading;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Bounds what a step may take where very many bodies are in one place.</summary>
/// <remarks>
/// n bodies in one place are n (n - 1) / 2 pairs: 2,500 of them 3 million, which no game can pay for and none needs. As long as there are
/// fewer than <see cref="PairsPerBody"/> pairs of moving bodies for each body in the mean, nothing happens here but counting. Beyond,
/// pairs of two bodies that both have more than <see cref="PairsOfCrowdedBody"/> of them are kept only if the two are near each other in
/// the order of their handles, so that each keeps about that many. Pairs with statics are always kept, and so are those of a platform
/// with any number of bodies on it, as these have few.
/// </remarks>
// Pairs are tested as they are found, so it is known too late that there are too many. The step in which that happens begins its narrow
// phase again: what was stored by then depends on which worker found what, so all contacts are forgotten. From then on, until there are few
// pairs again, pairs are counted before they are tested.
unsafe struct Crowd
{
    /// <summary>Pairs of moving bodies for each body, in the mean, from which on they are too many.</summary>
    // A dense pile has 10 to 20 for each body, and 60 while all of it moves by the size of a body in each step.
    const int PairsPerBody = 128;
    /// <summary>Pairs that never are too many.</summary>
    const int SmallNumber = 1 << 16;
    /// <summary>Pairs of a body from which on it is crowded, and about as many as it keeps then with others that are.</summary>
    const int PairsOfCrowdedBody = 64;
    /// <summary>Pairs after which a worker tells how many it has found.</summary>
    internal const int PairsPerReport = 1024;

    // For each active leaf its place among the crowded ones, in the order of handles; negative for one that is not crowded.
    Buffer<int> places;
    long limit;
    long found;

    /// <summary>Whether pairs are counted before they are tested.</summary>
    public bool CountsFirst { get; private set; }

    /// <summary>Whether some pairs are left out.</summary>
    public readonly bool LeavesOut => places.Allocated;

    /// <summary>Whether too many pairs were found while none is left out.</summary>
    public readonly bool HasTooMany => !LeavesOut && found > limit;

    /// <summary>Begins to find pairs, among a number of active leaves.</summary>
    public void Begin(int leafCount)
    {
        limit = SmallNumber + PairsPerBody * (long)leafCount;
        found = 0;
    }

    /// <summary>Notes the pairs that a worker has found since its last report.</summary>
    /// <returns>Whether the worker goes on; not once there are too many.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public bool Report(ref int pairsLeft)
    {
        pairsLeft = 0;
        if (Volatile.Read(in found) > limit || Interlocked.Add(ref found, PairsPerReport) > limit)
            return false;
        pairsLeft = PairsPerReport - 1;
        return true;
    }

    /// <summary>Notes what a worker has found since its last report. After the workers have ended.</summary>
    public void AddRest(int pairsLeft) => found += PairsPerReport - pairsLeft;

    /// <summary>Whether a pair of active leaves is tested.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool Keeps(int leafA, int leafB)
    {
        var a = places[leafA];
        var b = places[leafB];
        return (a | b) < 0 || Math.Abs(a - b) <= PairsOfCrowdedBody / 2;
    }

    /// <summary>Counts the pairs of all active leaves, and decides which are left out.</summary>
    public void Count(Bodies bodies, BroadPhase broadPhase, CollidableLayers layers, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        var leafCount = broadPhase.ActiveTree.LeafCount;
        var workerCount = dispatcher?.ThreadCount ?? 1;
        Begin(leafCount);
        pool.TakeAtLeast<int>(Math.Max(1, leafCount * workerCount), out var counts);
        counts.Clear(0, leafCount * workerCount);
        try
        {
            var handler = new Counter { Counts = counts.Memory, LeafCount = leafCount, Leaves = broadPhase.ActiveLeaves.Memory, Layers = layers };
            broadPhase.FindOverlapsOfLeaves(ref handler, dispatcher);
            for (int i = leafCount; i < leafCount * workerCount; ++i)
                counts[i % leafCount] += counts[i];
            for (int i = 0; i < leafCount; ++i)
                found += counts[i];
            found /= 2;
            CountsFirst = found > limit;
            if (CountsFirst)
                Place(bodies, leafCount, counts, pool);
        }
        finally
        {
            pool.Return(ref counts);
        }
    }

    void Place(Bodies bodies, int leafCount, in Buffer<int> counts, BufferPool pool)
    {
        pool.TakeAtLeast(leafCount, out places);
        for (int i = 0; i < leafCount; ++i)
            places[i] = -1;
        int place = 0;
        // In the order of slots: leaves are in that of memory.
        for (int i = 0; i < bodies.Locations.Length; ++i)
        {
            var location = bodies.Locations[i];
            if (location.SetIndex != 0)
                continue;
            var leaf = bodies.ActiveSet.Collidables[location.Index].BroadPhaseIndex;
            if (leaf >= 0 && counts[leaf] > PairsOfCrowdedBody)
                places[leaf] = place++;
        }
    }

    /// <summary>Ends a step.</summary>
    public void End(BufferPool pool)
    {
        pool.ReturnIfTaken(ref places);
    }

    // Counts the pairs that may meet of which one is dynamic and none is static.
    struct Counter : IBroadPhaseOverlapHandler
    {
        public int* Counts;
        public int LeafCount;
        public CollidableReference* Leaves;
        public CollidableLayers Layers;

        public readonly void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic)
        {
            if (bIsStatic || (Leaves[leafA].Mobility != CollidableMobility.Dynamic && Leaves[leafB].Mobility != CollidableMobility.Dynamic))
                return;
            if (!CollisionLayers.MayMeet(Layers.Of(Leaves[leafA]), Layers.Of(Leaves[leafB])))
                return;
            var counts = Counts + (nint)workerIndex * LeafCount;
            ++counts[leafA];
            ++counts[leafB];
        }
    }
}
