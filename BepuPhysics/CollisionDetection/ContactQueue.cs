using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts on their way to constraints that exist, for as long as it takes to load these.</summary>
/// <remarks>
/// As with <see cref="PairQueue"/>: constraints lie in an order of their own, and a column is spread over ten to twenty cache lines. It is asked for
/// while the contacts of other pairs are found.
/// </remarks>
struct ContactQueue
{
    const int Length = 16;
    // Contacts between two stages of one pair's.
    const int StageLength = 6;

    struct Update
    {
        public int CacheIndex;
        public ConstraintHandle Handle;
        public ContactConstraint Constraint;
        public ConvexContactManifold Manifold;
        public PairMaterialProperties Material;
    }

    [InlineArray(Length)]
    struct Ring
    {
        Update first;
    }

    Ring updates;
    int added;
    int located;
    int written;

    /// <summary>Adds the contacts of a pair whose constraint has as many.</summary>
    /// <param name="cache">The pairs.</param>
    /// <param name="solver">The constraints.</param>
    /// <param name="cacheIndex">Index of the pair.</param>
    /// <param name="constraint">Its constraint.</param>
    /// <param name="manifold">Its contacts.</param>
    /// <param name="material">How its surfaces behave.</param>
    public unsafe void Add(in PairCache cache, Solver solver, int cacheIndex, ConstraintHandle constraint, in ConvexContactManifold manifold,
        in PairMaterialProperties material)
    {
        ref var update = ref updates[added++ % Length];
        update.CacheIndex = cacheIndex;
        update.Handle = constraint;
        update.Manifold = manifold;
        update.Material = material;
        Prefetch.Read(solver.Locations.Memory + constraint.Slot);
        Prefetch.Read(cache.Pairs.Values.Memory + cacheIndex);
        if (added - located > StageLength)
            Locate(solver);
        if (added - written > 2 * StageLength)
            Write(cache);
    }

    /// <summary>Writes all contacts that are left.</summary>
    public void Flush(in PairCache cache, Solver solver)
    {
        while (located != added)
            Locate(solver);
        while (written != added)
            Write(cache);
    }

    void Locate(Solver solver)
    {
        ref var update = ref updates[located++ % Length];
        update.Constraint = new ContactConstraint(solver, update.Handle, update.Manifold.Count);
        update.Constraint.Prefetch();
    }

    void Write(in PairCache cache)
    {
        ref var update = ref updates[written++ % Length];
        ref var features = ref cache.Pairs.Values[update.CacheIndex].Features;
        update.Constraint.ReadImpulses(features, out var impulses);
        update.Constraint.Write(update.Manifold, update.Material);
        update.Constraint.WriteImpulses(impulses, update.Manifold, ref features);
    }
}
