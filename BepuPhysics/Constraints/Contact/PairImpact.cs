using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>The impact of two bodies at the contacts of one manifold.</summary>
// Poisson's hypothesis: first the impulses that stop the approach, at all contacts at once, so that a box that lands flat stays flat; then e
// times the same once more. Where the first are exact, what they leave is at right angles to them, and of the energy that they took e^2
// comes back. Friction comes with both parts, within the cone of the patch.
//
// What the sweeps leave over, and friction that pushes contacts back together, may give a little energy more than there was; the impulses
// are then scaled. With impulses x and relative velocities u before and u' after, the kinetic energy changes by x (u + u') / 2: so the scale
// -2 x u / x (u' - u) changes nothing. No impact adds energy, and so no sequence of impacts does.
ref struct PairImpact
{
    const int MaximumContacts = 4;
    const int MaximumRows = MaximumContacts + 2;
    // A patch converges by about a factor of two a sweep.
    const int Sweeps = 24;
    // With the normal impulses given, friction is one block.
    const int FrictionSweeps = 2;

    readonly ContactRows contacts;
    readonly BodyInertia inertiaA;
    readonly BodyInertia inertiaB;
    // The normal rows, then the two of friction.
    readonly Span<ContactRow> rows;
    readonly Span<float> before;
    readonly Span<float> velocities;
    readonly Span<float> impulses;
    // What a unit impulse in a row adds to the velocity of another.
    readonly Span<float> coupling;
    int normalCount;
    int count;

    PairImpact(in ContactRows contacts, Span<ContactRow> rows, Span<float> numbers)
    {
        this.contacts = contacts;
        inertiaA = contacts.InertiaA;
        inertiaB = contacts.InertiaB;
        this.rows = rows;
        numbers.Clear();
        before = numbers[..MaximumRows];
        velocities = numbers.Slice(MaximumRows, MaximumRows);
        impulses = numbers.Slice(2 * MaximumRows, MaximumRows);
        coupling = numbers[(3 * MaximumRows)..];
    }

    /// <summary>Lets a pair bounce at those of its contacts that meet within the substep.</summary>
    /// <param name="contacts">The contacts.</param>
    /// <param name="pair">The pair, with the time at which it bounces.</param>
    /// <param name="dt">Length of the substep.</param>
    /// <param name="changeA">What the velocity of A gains.</param>
    /// <param name="changeB">What the velocity of B gains.</param>
    internal static void Find(in ContactRows contacts, in BouncingPair pair, float dt, out BodyVelocity changeA, out BodyVelocity changeB)
    {
        Span<ContactRow> rows = stackalloc ContactRow[MaximumRows];
        Span<float> numbers = stackalloc float[MaximumRows * (MaximumRows + 3)];
        Span<Vector3> arms = stackalloc Vector3[MaximumContacts];
        var impact = new PairImpact(contacts, rows, numbers);
        // The velocity has gained what the acceleration of the whole substep gives. A parabola has gained half of that when the substep begins.
        var notYet = 0.5f - pair.Time / dt;
        for (int i = 0; i < pair.ContactCount; ++i)
        {
            var row = contacts.NormalRow(i);
            var velocity = row.Along(contacts.VelocityA, contacts.VelocityB);
            if (!(contacts.Gap(i, row) - pair.Reach(MathHelper.Max(-velocity, 0), dt) <= 0))
                continue;
            arms[impact.count] = contacts.Arm(i);
            impact.Add(row, velocity - row.Along(pair.GainA, pair.GainB) * notYet);
        }
        impact.normalCount = impact.count;
        impact.SolveNormals(impact.normalCount > 1 ? Sweeps : 1);
        if (contacts.Friction > 0)
            impact.AddFriction(arms);
        impact.Return(pair.Coefficient);
        impact.Sum(out changeA, out changeB);
    }

    void Add(in ContactRow row, float velocity)
    {
        var index = count++;
        rows[index] = row;
        before[index] = velocity;
        velocities[index] = velocity;
        var responseA = row.ResponseOfA(inertiaA, 1);
        var responseB = row.ResponseOfB(inertiaB, 1);
        for (int i = 0; i < count; ++i)
        {
            var coupled = rows[i].Along(responseA, responseB);
            Coupling(index, i) = coupled;
            Coupling(i, index) = coupled;
            velocities[index] += coupled * impulses[i];
        }
    }

    readonly ref float Coupling(int row, int column) => ref coupling[row * MaximumRows + column];

    readonly void Push(int row, float change)
    {
        impulses[row] += change;
        for (int i = 0; i < count; ++i)
            velocities[i] += Coupling(row, i) * change;
    }

    readonly void SolveNormals(int sweeps)
    {
        for (int sweep = 0; sweep < sweeps; ++sweep)
        {
            for (int i = 0; i < normalCount; ++i)
            {
                // Bodies that cannot be moved in this row have nothing to stop.
                var inverseMass = Coupling(i, i);
                if (inverseMass > 0)
                    Push(i, MathHelper.Max(-impulses[i], -velocities[i] / inverseMass));
            }
        }
    }

    readonly float SumOfNormals()
    {
        float sum = 0;
        for (int i = 0; i < normalCount; ++i)
            sum += impulses[i];
        return sum;
    }

    void AddFriction(ReadOnlySpan<Vector3> arms)
    {
        var sum = SumOfNormals();
        if (!(sum > 0))
            return;
        Vector3 center = default;
        for (int i = 0; i < normalCount; ++i)
            center += arms[i] * (impulses[i] / sum);
        var normal = contacts.Normal;
        // Any two tangents do: the friction of a patch is a vector.
        var x = Exact.Normalize(Exact.Cross(normal, MathF.Abs(normal.X) < MathF.Abs(normal.Y) ? Vector3.UnitX : Vector3.UnitY));
        AddTangent(contacts.Row(center, x));
        AddTangent(contacts.Row(center, Exact.Cross(normal, x)));
        for (int sweep = 0; sweep < Sweeps; ++sweep)
        {
            SolveNormals(1);
            SolveFriction();
        }
    }

    void AddTangent(in ContactRow row) => Add(row, row.Along(contacts.VelocityA, contacts.VelocityB));

    readonly void SolveFriction()
    {
        var x = normalCount;
        var y = normalCount + 1;
        var determinant = Coupling(x, x) * Coupling(y, y) - Coupling(x, y) * Coupling(x, y);
        if (!(determinant > 0))
            return;
        var totalX = impulses[x] - (Coupling(y, y) * velocities[x] - Coupling(x, y) * velocities[y]) / determinant;
        var totalY = impulses[y] - (Coupling(x, x) * velocities[y] - Coupling(x, y) * velocities[x]) / determinant;
        var length = MathF.Sqrt(totalX * totalX + totalY * totalY);
        var maximum = contacts.Friction * SumOfNormals();
        var scale = length > maximum ? maximum / length : 1;
        Push(x, totalX * scale - impulses[x]);
        Push(y, totalY * scale - impulses[y]);
    }

    readonly void Return(float coefficient)
    {
        for (int i = 0; i < normalCount; ++i)
            Push(i, impulses[i] * coefficient);
        for (int sweep = 0; sweep < FrictionSweeps && count > normalCount; ++sweep)
            SolveFriction();
    }

    readonly void Sum(out BodyVelocity changeA, out BodyVelocity changeB)
    {
        float taken = 0;
        float added = 0;
        for (int i = 0; i < count; ++i)
        {
            taken -= 2 * impulses[i] * before[i];
            // Not from the velocities: they hold the rounding of all sweeps.
            for (int j = 0; j < count; ++j)
                added += impulses[i] * impulses[j] * Coupling(i, j);
        }
        var scale = added > taken ? MathHelper.Max(0, taken / added) : 1;
        changeA = default;
        changeB = default;
        for (int i = 0; i < count; ++i)
        {
            var responseA = rows[i].ResponseOfA(inertiaA, impulses[i] * scale);
            changeA.Linear += responseA.Linear;
            changeA.Angular += responseA.Angular;
            var responseB = rows[i].ResponseOfB(inertiaB, impulses[i] * scale);
            changeB.Linear += responseB.Linear;
            changeB.Angular += responseB.Angular;
        }
    }
}
