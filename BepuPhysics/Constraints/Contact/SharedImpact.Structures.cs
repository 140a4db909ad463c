using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// Impacts of bodies that take structures of joints along. What an impulse of one row adds to the velocities of all is worked out once for each row, by a solve
// of its structures; sweeps then see numbers alone. In the end the structures are asked once more, for what all impulses make of their bodies.
unsafe partial struct SharedImpact
{
    // Pairs of an impact with structures: each row of them is a solve.
    const int MaximumPairsOfStructures = 32;
    // Part of what a blow would do to a body without its joints below which they leave it nothing but what they are off by: of two bodies of one structure that
    // is rigid, or of one that is held by the ground.
    const float LeastShare = 1e-3f;

    void BeginStructures()
    {
        // Two rows of friction may be added for each patch.
        stride = rows.Count + 2 * patches.Count;
        if (!couplings.Span.Allocated)
        {
            couplings = new(stride * stride, pool);
            changes = new(bodies.Count, pool);
        }
        couplings.EnsureCapacity(stride * stride, pool);
        couplings.Count = stride * stride;
        changes.EnsureCapacity(bodies.Count, pool);
        changes.Count = bodies.Count;
        Couple(0);
    }

    // Rows from one on are new.
    readonly void Couple(int first)
    {
        for (int j = first; j < rows.Count; ++j)
        {
            FindChanges(rows[j]);
            if (!IsMobile(rows[j]))
                rows[j].InverseMass = 0;
            for (int i = 0; i < rows.Count; ++i)
            {
                ref var other = ref rows[i];
                var velocity = other.Along.Along(changes[other.A], changes[other.B]);
                couplings[i * stride + j] = velocity;
                // Of two that are new each has its own.
                if (i < first)
                    couplings[j * stride + i] = velocity;
            }
        }
        for (int j = first; j < rows.Count; ++j)
        {
            ref var row = ref rows[j];
            row.InverseMass = row.InverseMass > 0 ? couplings[j * stride + j] : 0;
            row.Now = row.Before;
            for (int i = 0; i < first; ++i)
                row.Now += couplings[j * stride + i] * rows[i].Impulse;
        }
    }

    readonly void FindChanges(in Row row)
    {
        for (int i = 0; i < bodies.Count; ++i)
            changes[i] = default;
        changes[row.A] = row.Along.ResponseOfA(bodies[row.A].Inertia, 1);
        changes[row.B] = row.Along.ResponseOfB(bodies[row.B].Inertia, 1);
        int islandA = IslandOf(row.A), islandB = IslandOf(row.B);
        if (islandA >= 0)
            structures.BeginBlow(islandA);
        if (islandB >= 0 && islandB != islandA)
            structures.BeginBlow(islandB);
        if (islandA >= 0)
            structures.Push(bodies[row.A].Part, changes[row.A]);
        if (islandB >= 0)
            structures.Push(bodies[row.B].Part, changes[row.B]);
        if (islandA >= 0)
            structures.EndBlow(islandA);
        if (islandB >= 0 && islandB != islandA)
            structures.EndBlow(islandB);
        for (int i = 0; i < bodies.Count; ++i)
        {
            var island = IslandOf(i);
            if (island >= 0 && (island == islandA || island == islandB))
                changes[i] = structures.ChangeOf(bodies[i].Part);
        }
    }

    // By the changes that its unit impulse makes.
    readonly bool IsMobile(in Row row)
    {
        BodyVelocity none = default;
        BodyVelocity freeA = row.Along.ResponseOfA(bodies[row.A].Inertia, 1), freeB = row.Along.ResponseOfB(bodies[row.B].Inertia, 1);
        float ofA = row.Along.Along(changes[row.A], none), ofB = row.Along.Along(none, changes[row.B]);
        float ofFreeA = row.Along.Along(freeA, none), ofFreeB = row.Along.Along(none, freeB);
        if (IslandOf(row.A) >= 0 && IslandOf(row.A) == IslandOf(row.B))
            return ofA + ofB > LeastShare * (ofFreeA + ofFreeB);
        return ofA > LeastShare * ofFreeA || ofB > LeastShare * ofFreeB;
    }

    readonly int IslandOf(int body) => bodies[body].Part >= 0 ? structures.IslandOfPart(bodies[body].Part) : -1;

    // Returns what one of them does to the other.
    readonly float CoupleTangents(int first)
    {
        Couple(first);
        return couplings[first * stride + first + 1];
    }

    readonly void PushStructures(int index, float change)
    {
        for (int i = 0; i < rows.Count; ++i)
            rows[i].Now += couplings[i * stride + index] * change;
    }

    // Changes are those of free bodies.
    readonly void SumStructures()
    {
        for (int i = 0; i < bodies.Count; ++i)
        {
            if (!TryGetStructure(i, out var island))
                continue;
            structures.BeginBlow(island);
            for (int j = i; j < bodies.Count; ++j)
            {
                if (IslandOf(j) == island)
                    structures.Push(bodies[j].Part, bodies[j].Change);
            }
            structures.EndBlow(island);
            for (int j = i; j < bodies.Count; ++j)
            {
                if (IslandOf(j) == island)
                    bodies[j].Change = structures.ChangeOf(bodies[j].Part);
            }
        }
    }

    /// <summary>Bounces by so much less that an energy is paid; what does not bounce pays nothing.</summary>
    /// <param name="owed">The energy, J; nothing is given back where it is negative.</param>
    /// <returns>The scale of the blow.</returns>
    // With impulses x and relative velocities u before and u' after, x as much more adds the energy x u'.
    internal readonly float Pay(float owed)
    {
        if (!(owed > 0))
            return 1;
        var coefficient = 1f;
        for (int i = 0; i < patches.Count; ++i)
            coefficient = MathHelper.Min(coefficient, patches[i].Coefficient);
        float returned = 0;
        for (int i = 0; i < rows.Count; ++i)
        {
            ref var row = ref rows[i];
            returned += row.Impulse * (row.Before + row.Along.Along(bodies[row.A].Change, bodies[row.B].Change));
        }
        var most = coefficient / (1 + coefficient);
        var scale = 1 - (owed < most * returned ? owed / returned : most);
        for (int i = 0; i < rows.Count; ++i)
            rows[i].Impulse *= scale;
        for (int i = 0; i < bodies.Count; ++i)
            bodies[i].Change = new(bodies[i].Change.Linear * scale, bodies[i].Change.Angular * scale);
        return scale;
    }

    /// <summary>Whether joints leave a pair that takes part nothing to stop.</summary>
    internal readonly bool IsHeld(int index)
    {
        for (int i = patches[index].First; i < patches[index].End; ++i)
        {
            if (rows[i].InverseMass > 0)
                return false;
        }
        return patches[index].End > patches[index].First;
    }

    /// <summary>Whether another pair may take part.</summary>
    internal readonly bool HasRoom => patches.Count < (hasStructures ? MaximumPairsOfStructures : MaximumPairs);

    /// <summary>Whether any body that takes part is in a structure of joints.</summary>
    internal readonly bool HasStructures => hasStructures;

    /// <summary>Whether structures that take part are moved along their joints: what does not bounce goes on with who stopped it, wherever that is.</summary>
    internal readonly bool GoesAlongJoints
    {
        get
        {
            for (int i = 0; i < patches.Count; ++i)
            {
                if (patches[i].Coefficient > Restitution.LeastCoefficient)
                    return hasStructures;
            }
            return false;
        }
    }

    /// <summary>The structure of a body, if it is the first one of it.</summary>
    /// <param name="index">Which of those that take part.</param>
    /// <param name="island">The structure, whose last blow is that of the impact.</param>
    internal readonly bool TryGetStructure(int index, out int island)
    {
        island = IslandOf(index);
        for (int i = 0; i < index && island >= 0; ++i)
        {
            if (IslandOf(i) == island)
                return false;
        }
        return island >= 0;
    }
}
