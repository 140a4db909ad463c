using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair that waits for its contacts.</summary>
struct TestedPair
{
    public CollidablePair Pair;
    /// <summary>Index in the cache; negative for a pair that is not in it.</summary>
    public int CacheIndex;
    /// <summary>Contact constraint that the pair has; means nothing where there is none.</summary>
    public ConstraintHandle Constraint;
    /// <summary>Type id of that constraint; <see cref="CachedManifold.NoConstraint"/> where there is none.</summary>
    public int ConstraintTypeId;
    /// <summary>Whether tests of the pair's shapes keep histories, and whether the pair has one.</summary>
    public bool KeepsHistory, HasHistory;

    /// <summary>Whether the pair's constraint can be written in place.</summary>
    /// <param name="typeId">Type id of the constraint that the pair is to have.</param>
    // A pair whose shapes have become such as keep a history gets it with the changes.
    public readonly bool KeepsConstraint(int typeId) => ConstraintTypeId == typeId && (HasHistory || !KeepsHistory);
}

/// <summary>The pairs of a worker that wait for their contacts, by ids that are used again: as many as batches hold stay in the cache.</summary>
struct TestedPairs(int initialCapacity, BufferPool pool)
{
    QuickList<TestedPair> pairs = new(initialCapacity, pool);
    QuickList<int> freeIds = new(initialCapacity, pool);

    /// <summary>Adds a pair.</summary>
    /// <returns>Its id, until it is taken.</returns>
    public int Add(in TestedPair pair, BufferPool pool)
    {
        if (freeIds.Count == 0)
        {
            pairs.Add(pair, pool);
            return pairs.Count - 1;
        }
        var id = freeIds[freeIds.Count - 1];
        --freeIds.Count;
        pairs[id] = pair;
        return id;
    }

    /// <summary>Takes a pair out.</summary>
    public TestedPair Take(int id, BufferPool pool)
    {
        freeIds.Add(id, pool);
        return pairs[id];
    }

    public void Dispose(BufferPool pool)
    {
        pairs.Dispose(pool);
        freeIds.Dispose(pool);
    }
}
