using System;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>
/// Groups of dynamic bodies that constraints connect, contacts included: nothing that happens to one group reaches another before collisions are
/// detected again.
/// </summary>
/// <remarks>
/// Found when somebody asks, and kept by nobody. Kinematic bodies and statics connect nothing, as no impulse goes through them. Islands are in the
/// order of their lowest slots, the bodies of each in the order of theirs: neither depends on places in memory, threads or the order of constraints.
/// </remarks>
readonly unsafe struct Islands
{
    // Indices in the active set, island after island.
    readonly Buffer<int> bodies;
    // Where each island begins, and where the last one ends.
    readonly Buffer<int> starts;

    /// <summary>Number of islands.</summary>
    internal readonly int Count;

    /// <summary>Indices in the active set of the bodies of an island.</summary>
    internal readonly ReadOnlySpan<int> BodiesOf(int island) => new(bodies.Memory + starts[island], starts[island + 1] - starts[island]);

    /// <summary>Finds the islands of the active set.</summary>
    /// <param name="all">The bodies.</param>
    /// <param name="solver">Their constraints.</param>
    /// <param name="pool">Source of memory, until <see cref="Dispose"/>.</param>
    internal Islands(Bodies all, Solver solver, BufferPool pool)
    {
        ref var set = ref all.Awake;
        pool.Take(Math.Max(1, set.Count), out bodies);
        pool.Take(set.Count + 1, out starts);
        pool.Take<int>(Math.Max(1, set.Count), out var parents);
        // Island of a root, plus one.
        pool.Take<int>(Math.Max(1, set.Count), out var islands);
        DisjointSets.Begin(parents, set.Count);
        islands.Clear(0, set.Count);
        starts.Clear(0, set.Count + 1);
        Connect(solver, parents);
        // Sizes first: each island's behind its own place, so that their sums are where the next one begins.
        for (int slot = 0; slot <= all.HandlePool.HighestPossiblyClaimedId; ++slot)
        {
            if (!IsDynamic(all, slot, out var index))
                continue;
            ref var island = ref islands[DisjointSets.Root(parents, index)];
            if (island == 0)
                island = ++Count;
            ++starts[island];
        }
        pool.Take<int>(Count + 1, out var next);
        for (int i = 0; i <= Count; ++i)
            next[i] = starts[i] += i > 0 ? starts[i - 1] : 0;
        for (int slot = 0; slot <= all.HandlePool.HighestPossiblyClaimedId; ++slot)
        {
            if (IsDynamic(all, slot, out var index))
                bodies[next[islands[DisjointSets.Root(parents, index)] - 1]++] = index;
        }
        pool.Return(ref next);
        pool.Return(ref parents);
        pool.Return(ref islands);
    }

    static bool IsDynamic(Bodies all, int slot, out int index)
    {
        ref var location = ref all.Locations[slot];
        index = location.Index;
        return location.SetIndex == 0 && !Bodies.IsKinematic(all.Awake.LocalInertias[index]);
    }

    static void Connect(Solver solver, Buffer<int> parents)
    {
        ref var batches = ref solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            if (batches[i].Kind == BatchKind.Disabled)
                continue;
            for (int j = 0; j < batches[i].TypeBatches.Count; ++j)
            {
                ref var typeBatch = ref batches[i].TypeBatches[j];
                var processor = solver.Processor(typeBatch.TypeId);
                for (int k = 0; k < typeBatch.ConstraintCount; ++k)
                {
                    var first = -1;
                    for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
                    {
                        var reference = processor.BodyReference(ref typeBatch, k, slot);
                        if ((reference & EncodedBody.KinematicFlag) != 0)
                            continue;
                        var root = DisjointSets.Root(parents, reference & EncodedBody.IndexMask);
                        first = first < 0 ? root : DisjointSets.Join(parents, first, root);
                    }
                }
            }
        }
    }

    internal void Dispose(BufferPool pool)
    {
        var lent = bodies;
        pool.Return(ref lent);
        lent = starts;
        pool.Return(ref lent);
    }
}
