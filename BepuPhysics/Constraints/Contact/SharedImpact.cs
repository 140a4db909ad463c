using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>One impact: of two bodies, or of more that meet at the same time.</summary>
// Poisson's hypothesis: first the impulses that stop the approach, at all contacts at once, so that a box that lands flat stays flat, on one tile or
// on several; then e times the same once more. Where the first are exact, what they leave is at right angles to them, and of the energy that they took e^2
// comes back. Friction comes with both parts, within the cone of each patch.
//
// Which contact bears how much is unknown where a body has more than its freedoms, and does not matter: the sum is known, and with it all velocities.
//
// What the sweeps leave over, and friction that pushes contacts back together, may give a little energy more than there was; the impulses
// are then scaled. With impulses x and relative velocities u before and u' after, the kinetic energy changes by x (u + u') / 2: so the scale
// -2 x u / x (u' - u) changes nothing. No impact adds energy, and so no sequence of impacts does.
//
// Bodies in joints take their structures along (SharedImpact.Structures.cs); rows then see each other by what one does to all others.
unsafe partial struct SharedImpact(ImpactStructures structures, BufferPool pool)
{
    // A patch converges by about a factor of two a sweep; one on bodies of little inertia for its breadth is slower.
    const int MaximumSweeps = 256;
    // Pairs of one impact.
    const int MaximumPairs = 256;
    // What a sweep changes, of the greatest speed of approach, from which on it changes nothing but rounding.
    const float RoundingShare = 2e-7f;
    // With the normal impulses given, friction is one block for each patch.
    const int FrictionSweeps = 2;

    struct Body
    {
        // In the active set; -1 for a static.
        public int Index;
        public bool IsFixed;
        // Part of a structure of joints, or -1.
        public int Part;
        public BodyInertia Inertia;
        public BodyVelocity Velocity;
        public BodyVelocity Change;
    }

    struct Row
    {
        public ContactRow Along;
        public Vector3 Arm;
        // Bodies by their places in the list.
        public int A;
        public int B;
        // Velocity before the impact.
        public float Before;
        // Velocity as it is, where there are structures.
        public float Now;
        public float Impulse;
        // What a unit impulse adds to the velocity.
        public float InverseMass;
    }

    struct Meeting
    {
        public int Pair;
        public float Coefficient;
        public float Friction;
        public Vector3 Normal;
        public Vector3 OffsetB;
        // Of the normal rows.
        public int First;
        public int End;
        // Of the two rows of friction; -1 without.
        public int Tangent;
        // Direction of the first; that of the second is across.
        public Vector3 Direction;
        // What a unit impulse in one of these adds to the velocity of the other.
        public float Coupling;
    }

    QuickList<Body> bodies = new(4, pool);
    QuickList<Row> rows = new(16, pool);
    QuickList<Meeting> patches = new(4, pool);
    // What a unit impulse of a row adds to the velocity of another, where there are structures.
    QuickList<float> couplings;
    // What a unit impulse of the row that is looked at adds to the bodies.
    QuickList<BodyVelocity> changes;
    // Length of a row of the couplings.
    int stride;
    bool hasStructures;
    float time;
    float dt;
    // Greatest speed of approach, and in any row.
    float speed, greatestSpeed;
    // Whether any pair bounces.
    bool bounces;

    internal void Dispose()
    {
        bodies.Dispose(pool);
        rows.Dispose(pool);
        patches.Dispose(pool);
        if (!couplings.Span.Allocated)
            return;
        couplings.Dispose(pool);
        changes.Dispose(pool);
    }

    /// <summary>Begins an impact.</summary>
    /// <param name="time">When it is, s from the beginning of the substep.</param>
    /// <param name="dt">Length of the substep.</param>
    internal void Begin(float time, float dt)
    {
        this.time = time;
        this.dt = dt;
        speed = greatestSpeed = 0;
        bounces = hasStructures = false;
        bodies.Count = rows.Count = patches.Count = 0;
    }

    /// <summary>Number of pairs that take part.</summary>
    internal readonly int PairCount => patches.Count;

    /// <summary>A pair that takes part.</summary>
    internal readonly int Pair(int index) => patches[index].Pair;

    /// <summary>What a pair that takes part is pushed apart by, N s.</summary>
    internal readonly float NormalImpulse(int index)
    {
        float sum = 0;
        for (int i = patches[index].First; i < patches[index].End; ++i)
            sum += rows[i].Impulse;
        return sum;
    }

    /// <summary>What friction pushes A of a pair that takes part with, N s.</summary>
    internal readonly Vector3 FrictionImpulse(int index)
    {
        ref var patch = ref patches[index];
        if (patch.Tangent < 0)
            return default;
        return patch.Direction * rows[patch.Tangent].Impulse + Exact.Cross(patch.Normal, patch.Direction) * rows[patch.Tangent + 1].Impulse;
    }

    /// <summary>Number of bodies that take part.</summary>
    internal readonly int BodyCount => bodies.Count;

    /// <summary>What the impact makes of a body.</summary>
    /// <param name="index">Which of those that take part.</param>
    /// <param name="body">Its index in the active set.</param>
    /// <param name="change">What its velocity gains.</param>
    /// <returns>Whether it moves, and is in no structure.</returns>
    internal readonly bool TryGetChange(int index, out int body, out BodyVelocity change)
    {
        body = bodies[index].Index;
        change = bodies[index].Change;
        return !bodies[index].IsFixed && bodies[index].Part < 0;
    }

    /// <summary>Adds those contacts of a pair that meet within the substep.</summary>
    /// <param name="index">The pair.</param>
    /// <param name="pair">What is known of it.</param>
    /// <param name="contacts">Its contacts.</param>
    internal void Add(int index, in BouncingPair pair, in ContactRows contacts)
    {
        var a = PlaceOf(contacts.A, contacts.InertiaA, contacts.VelocityA, false);
        var b = PlaceOf(contacts.B, contacts.InertiaB, contacts.VelocityB, contacts.IsFixedB);
        var first = rows.Count;
        bounces |= pair.Coefficient > 0;
        // The velocity has gained what the acceleration of the whole substep gives. A parabola has gained half of that when the substep begins.
        var notYet = 0.5f - time / dt;
        var gainA = bodies[a].Part >= 0 ? structures.GainOf(bodies[a].Part) : pair.GainInA;
        var gainB = bodies[b].Part >= 0 ? structures.GainOf(bodies[b].Part) : pair.GainInB;
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            var row = pair.Rows[i];
            var velocity = row.Along(contacts.VelocityA, contacts.VelocityB);
            if (!(contacts.Gap(i, row) - pair.ReachOfAlike(MathHelper.Max(-velocity, 0), dt) <= 0))
                continue;
            velocity -= row.Along(gainA, gainB) * notYet;
            speed = MathHelper.Max(speed, -velocity);
            AddRow(row, contacts.Arm(i), a, b, velocity);
        }
        patches.Add(
            new()
            {
                Pair = index,
                Coefficient = pair.Coefficient,
                Friction = contacts.Friction,
                Normal = contacts.Normal,
                OffsetB = contacts.OffsetB,
                First = first,
                End = rows.Count,
                Tangent = -1,
            }, pool);
    }

    int PlaceOf(int index, in BodyInertia inertia, in BodyVelocity velocity, bool isFixed)
    {
        for (int i = 0; i < bodies.Count; ++i)
        {
            if (bodies[i].Index == index)
                return i;
        }
        var part = isFixed ? -1 : structures.PartOf(index);
        hasStructures |= part >= 0;
        bodies.Add(
            new()
            {
                Index = index,
                IsFixed = isFixed,
                Part = part,
                Inertia = part >= 0 ? structures.InertiaOf(part) : inertia,
                Velocity = velocity,
            }, pool);
        return bodies.Count - 1;
    }

    void AddRow(in ContactRow along, Vector3 arm, int a, int b, float before)
    {
        greatestSpeed = MathHelper.Max(greatestSpeed, MathF.Abs(before));
        var inverseMass = along.Along(along.ResponseOfA(bodies[a].Inertia, 1), along.ResponseOfB(bodies[b].Inertia, 1));
        rows.Add(new() { Along = along, Arm = arm, A = a, B = b, Before = before, InverseMass = inverseMass }, pool);
    }

    /// <summary>Finds what the pairs that were added make of their bodies.</summary>
    internal void Solve()
    {
        if (hasStructures)
            BeginStructures();
        // One row is exact.
        Settle(rows.Count > 1 ? MaximumSweeps : 1);
        if (AddFriction())
            Settle(MaximumSweeps);
        if (bounces)
        {
            for (int i = 0; i < patches.Count; ++i)
                Return(patches[i]);
            for (int i = 0; i < FrictionSweeps; ++i)
                SolveFriction();
        }
        Sum();
    }

    readonly void Settle(int sweeps)
    {
        // What grazes slides much faster than it approaches, and so does its rounding. Only what bounces needs to be finer.
        var rounding = RoundingShare * (bounces ? speed : greatestSpeed);
        while (sweeps-- > 0 && MathHelper.Max(SolveNormals(), SolveFriction()) > rounding)
        {
        }
    }

    readonly float Velocity(in Row row) => hasStructures ? row.Now : row.Before + row.Along.Along(bodies[row.A].Change, bodies[row.B].Change);

    readonly void Push(int index, float change)
    {
        ref var row = ref rows[index];
        row.Impulse += change;
        if (hasStructures)
            PushStructures(index, change);
        else
            Apply(row, change);
    }

    readonly void Apply(in Row row, float impulse)
    {
        ref var a = ref bodies[row.A];
        ref var b = ref bodies[row.B];
        Add(ref a.Change, row.Along.ResponseOfA(a.Inertia, impulse));
        Add(ref b.Change, row.Along.ResponseOfB(b.Inertia, impulse));
    }

    static void Add(ref BodyVelocity velocity, in BodyVelocity change)
    {
        velocity.Linear += change.Linear;
        velocity.Angular += change.Angular;
    }

    // The greatest change of a velocity.
    readonly float SolveNormals()
    {
        float greatest = 0;
        for (int i = 0; i < patches.Count; ++i)
        {
            for (int j = patches[i].First; j < patches[i].End; ++j)
            {
                ref var row = ref rows[j];
                // Bodies that cannot be moved in this row have nothing to stop.
                if (!(row.InverseMass > 0))
                    continue;
                var change = MathHelper.Max(-row.Impulse, -Velocity(row) / row.InverseMass);
                Push(j, change);
                greatest = MathHelper.Max(greatest, MathF.Abs(change) * row.InverseMass);
            }
        }
        return greatest;
    }

    bool AddFriction()
    {
        var any = false;
        for (int i = 0; i < patches.Count; ++i)
        {
            ref var patch = ref patches[i];
            var sum = NormalImpulse(i);
            if (!(sum > 0 && patch.Friction > 0))
                continue;
            any = true;
            Vector3 center = default;
            for (int j = patch.First; j < patch.End; ++j)
                center += rows[j].Arm * (rows[j].Impulse / sum);
            // Any two tangents do: the friction of a patch is a vector.
            var x = ContactRow.Across(patch.Normal);
            patch.Tangent = rows.Count;
            patch.Direction = x;
            AddTangent(patch, center, x);
            AddTangent(patch, center, Exact.Cross(patch.Normal, x));
            if (hasStructures)
            {
                patch.Coupling = CoupleTangents(patch.Tangent);
                continue;
            }
            ref var row = ref rows[patch.Tangent];
            patch.Coupling = rows[patch.Tangent + 1].Along.Along(
                row.Along.ResponseOfA(bodies[row.A].Inertia, 1), row.Along.ResponseOfB(bodies[row.B].Inertia, 1));
        }
        return any;
    }

    void AddTangent(in Meeting patch, Vector3 center, Vector3 direction)
    {
        var along = ContactRow.At(center, direction, patch.OffsetB);
        var (a, b) = (rows[patch.First].A, rows[patch.First].B);
        AddRow(along, center, a, b, along.Along(bodies[a].Velocity, bodies[b].Velocity));
    }

    // The greatest change of a velocity.
    readonly float SolveFriction()
    {
        float greatest = 0;
        for (int i = 0; i < patches.Count; ++i)
        {
            ref var patch = ref patches[i];
            if (patch.Tangent < 0)
                continue;
            ref var x = ref rows[patch.Tangent];
            ref var y = ref rows[patch.Tangent + 1];
            var determinant = x.InverseMass * y.InverseMass - patch.Coupling * patch.Coupling;
            if (!(determinant > 0))
                continue;
            var (velocityX, velocityY) = (Velocity(x), Velocity(y));
            var totalX = x.Impulse - (y.InverseMass * velocityX - patch.Coupling * velocityY) / determinant;
            var totalY = y.Impulse - (x.InverseMass * velocityY - patch.Coupling * velocityX) / determinant;
            var length = MathF.Sqrt(totalX * totalX + totalY * totalY);
            var maximum = patch.Friction * NormalImpulse(i);
            var scale = length > maximum ? maximum / length : 1;
            var (changeX, changeY) = (totalX * scale - x.Impulse, totalY * scale - y.Impulse);
            Push(patch.Tangent, changeX);
            Push(patch.Tangent + 1, changeY);
            greatest = MathHelper.Max(greatest, MathHelper.Max(MathF.Abs(changeX) * x.InverseMass, MathF.Abs(changeY) * y.InverseMass));
        }
        return greatest;
    }

    readonly void Return(in Meeting patch)
    {
        for (int i = patch.First; i < patch.End; ++i)
            Push(i, rows[i].Impulse * patch.Coefficient);
    }

    readonly void Sum()
    {
        // Not what the sweeps have summed up: that holds the rounding of all of them.
        SumChanges();
        float taken = 0;
        float added = 0;
        for (int i = 0; i < rows.Count; ++i)
        {
            ref var row = ref rows[i];
            taken -= 2 * row.Impulse * row.Before;
            added += row.Impulse * row.Along.Along(bodies[row.A].Change, bodies[row.B].Change);
        }
        if (!(added > taken))
            return;
        var scale = MathHelper.Max(0, taken / added);
        for (int i = 0; i < rows.Count; ++i)
            rows[i].Impulse *= scale;
        SumChanges();
    }

    readonly void SumChanges()
    {
        for (int i = 0; i < bodies.Count; ++i)
            bodies[i].Change = default;
        for (int i = 0; i < rows.Count; ++i)
            Apply(rows[i], rows[i].Impulse);
        if (hasStructures)
            SumStructures();
    }
}
