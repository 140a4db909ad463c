using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts on their way to constraints that exist, for as long as it takes to load these.</summary>
/// <remarks>
/// As with <see cref="PairQueue"/>: constraints lie in an order of their own, and a column is spread over ten to twenty cache lines. It is asked for
/// while the contacts of other pairs are found.
/// </remarks>
unsafe struct ContactQueue
{
    const int Length = 16;
    // Contacts between two stages of one pair's.
    const int StageLength = 6;

    struct Update
    {
        public FeatureIds* Features;
        public ConstraintHandle Handle;
        public ContactConstraint Constraint;
        public ConvexContactManifold Manifold;
        public PairMaterialProperties Material;
        public Vector3 FrictionCenter;
    }

    [InlineArray(Length)]
    struct Ring
    {
        Update first;
    }

    Ring updates;
    // Unsigned, so that a place in the ring is a mask.
    uint added;
    uint located;
    uint written;
    bool writesAtOnce;

    /// <summary>Forgets all contacts.</summary>
    /// <param name="isNearby">Whether constraints are so few that they are waited for no longer than a queue takes: then they are written at once.</param>
    public void Clear(bool isNearby)
    {
        added = located = written = 0;
        writesAtOnce = isNearby;
    }

    /// <summary>Adds the contacts of a manifold whose constraint has as many.</summary>
    /// <param name="solver">The constraints.</param>
    /// <param name="features">What the cache remembers the contacts by; it stays where it is until they are written.</param>
    /// <param name="constraint">The constraint.</param>
    /// <param name="manifold">The contacts.</param>
    /// <param name="material">How the surfaces behave.</param>
    /// <param name="frictionCenter">Where friction acts of a patch on several statics, relative to the centre of A; zero for a patch on one.</param>
    public void Add(Solver solver, FeatureIds* features, ConstraintHandle constraint, in ConvexContactManifold manifold, in PairMaterialProperties material,
        in Vector3 frictionCenter = default)
    {
        if (writesAtOnce)
        {
            new ContactConstraint(solver, constraint, manifold.Count).Update(manifold, material, frictionCenter, ref *features);
            return;
        }
        ref var update = ref updates[(int)(added++ % Length)];
        update.Features = features;
        update.Handle = constraint;
        update.Manifold = manifold;
        update.Material = material;
        update.FrictionCenter = frictionCenter;
        Prefetch.Read(solver.Locations.Memory + constraint.Slot);
        Prefetch.Read(features);
        if (added - located > StageLength)
            Locate(solver);
        if (added - written > 2 * StageLength)
            Write();
    }

    /// <summary>Writes all contacts that are left.</summary>
    public void Flush(Solver solver)
    {
        while (located != added)
            Locate(solver);
        while (written != added)
            Write();
    }

    void Locate(Solver solver)
    {
        ref var update = ref updates[(int)(located++ % Length)];
        update.Constraint = new ContactConstraint(solver, update.Handle, update.Manifold.Count);
        update.Constraint.Prefetch();
    }

    void Write()
    {
        ref var update = ref updates[(int)(written++ % Length)];
        update.Constraint.Update(update.Manifold, update.Material, update.FrictionCenter, ref *update.Features);
    }
}
