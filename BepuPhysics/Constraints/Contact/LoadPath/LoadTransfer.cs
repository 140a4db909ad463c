using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Hands the momentum that a body has left to its supports.</summary>
// The supports have to take the impulse -P and the torque -L about the centre of the body. Along the mean normal of the supports, and about the two
// axes at right angles to it, the normals do: one unknown per contact, three equations, of which the change with the least sum of squares is taken,
//   d = J^T (J J^T)^-1 (force, tipping moments),   J_i = (n_i . n, (r_i x n_i) . x, (r_i x n_i) . y),
// with arms in units of the body. A contact that would pull is left at zero and the others share what it does not take. Across the normal friction
// does, shared by load.
//
// What the normals carry is no more than the load: a least change of squares may press one side against the other, and what is pressed so has
// friction that no weight pays for.
static class LoadTransfer
{
    // Rounds in which contacts that would pull are taken out.
    const int Rounds = 4;
    // Part of its trace that is added to the diagonal of the system: contacts in a row leave it singular.
    const float Regularization = 1e-5f;

    /// <summary>Finds the impulses after the transfer for the supports of one body.</summary>
    /// <param name="supports">Its supports, as they were read.</param>
    /// <param name="linear">Momentum that is to become zero, N s.</param>
    /// <param name="angular">Angular momentum that is to become zero, N m s.</param>
    /// <param name="radius">Greatest distance of a contact from the centre, m.</param>
    internal static void Find(Span<LoadSupport> supports, Vector3 linear, Vector3 angular, float radius)
    {
        var normal = MeanNormal(supports, out var load);
        var force = -Exact.Dot(linear, normal);
        var wanted = MathHelper.Max(0, load + force);
        var carried = MathHelper.Max(0, Along(supports, normal, before: true) + force);
        var moment = -angular;
        ShareFriction(supports, -(linear + normal * force), wanted, load, ref moment);
        SolveNormals(supports, normal, force, moment, radius);
        Cap(supports, normal, carried);
        Clamp(supports);
    }

    internal static Vector3 MeanNormal(Span<LoadSupport> supports, out float load)
    {
        load = 0;
        Vector3 weighted = default, plain = default;
        foreach (ref var support in supports)
        {
            var share = support.Load;
            load += share;
            weighted += support.Normal * share;
            plain += support.Normal;
        }
        return Exact.Normalize(Exact.LengthSquared(weighted) > 0 ? weighted : plain);
    }

    static void ShareFriction(Span<LoadSupport> supports, Vector3 across, float wanted, float load, ref Vector3 moment)
    {
        foreach (ref var support in supports)
        {
            var share = load > 0 ? support.Load / load : 1f / supports.Length;
            var friction = support.FrictionBefore + across * share;
            friction -= support.Normal * Exact.Dot(friction, support.Normal);
            support.FrictionAfter = Limit(friction, support.Friction * wanted * share);
            moment -= Exact.Cross(support.Center, support.FrictionAfter - support.FrictionBefore);
        }
    }

    static void SolveNormals(Span<LoadSupport> supports, Vector3 normal, float force, Vector3 moment, float radius)
    {
        var inverseRadius = radius > 0 ? 1 / radius : 0;
        var goal = new Vector3(force, 0, 0);
        Axes(normal, out var x, out var y);
        goal.Y = Exact.Dot(moment, x) * inverseRadius;
        goal.Z = Exact.Dot(moment, y) * inverseRadius;
        // A bit for each contact that is at zero; its share of the goal is what it takes to bring it there. Open ones are there from the beginning.
        foreach (ref var support in supports)
            support.Pulled = support.Open;
        for (int round = 0; round < Rounds; ++round)
        {
            Symmetric3x3 system = default;
            var left = goal;
            foreach (ref var support in supports)
            {
                for (int i = 0; i < support.Count; ++i)
                {
                    var row = Row(support, i, normal, x, y, inverseRadius);
                    if ((support.Pulled & 1 << i) != 0)
                    {
                        left += row * support.Before[i];
                        continue;
                    }
                    AddSquare(ref system, row);
                }
            }
            if (!TrySolve(system, left, out var multipliers))
                break;
            var changed = false;
            foreach (ref var support in supports)
            {
                for (int i = 0; i < support.Count; ++i)
                {
                    if ((support.Pulled & 1 << i) != 0)
                    {
                        support.After[i] = 0;
                        continue;
                    }
                    support.After[i] = support.Before[i] + Exact.Dot(Row(support, i, normal, x, y, inverseRadius), multipliers);
                    if (support.After[i] >= 0)
                        continue;
                    support.Pulled |= 1 << i;
                    support.After[i] = 0;
                    changed = true;
                }
            }
            if (!changed)
                break;
        }
    }

    internal static void AddSquare(ref Symmetric3x3 system, Vector3 row)
    {
        system.XX += row.X * row.X;
        system.YX += row.Y * row.X;
        system.YY += row.Y * row.Y;
        system.ZX += row.Z * row.X;
        system.ZY += row.Z * row.Y;
        system.ZZ += row.Z * row.Z;
    }

    internal static bool TrySolve(Symmetric3x3 system, Vector3 goal, out Vector3 solution)
    {
        solution = default;
        var trace = system.XX + system.YY + system.ZZ;
        if (!(trace > 0))
            return false;
        system.XX += trace * Regularization;
        system.YY += trace * Regularization;
        system.ZZ += trace * Regularization;
        solution = Symmetric3x3.Invert(system) * goal;
        return true;
    }

    internal static Vector3 Row(in LoadSupport support, int contact, Vector3 normal, Vector3 x, Vector3 y, float inverseRadius)
    {
        var torque = Exact.Cross(support.Arms[contact], support.Normal) * inverseRadius;
        return new(Exact.Dot(support.Normal, normal), Exact.Dot(torque, x), Exact.Dot(torque, y));
    }

    internal static void Axes(Vector3 normal, out Vector3 x, out Vector3 y)
    {
        x = MathF.Abs(normal.X) < 0.7f ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
        x = Exact.Normalize(x - normal * Exact.Dot(x, normal));
        y = Exact.Cross(normal, x);
    }

    // Sum of what the normals carry along their mean.
    static float Along(Span<LoadSupport> supports, Vector3 normal, bool before)
    {
        float sum = 0;
        foreach (ref var support in supports)
        {
            var slope = Exact.Dot(support.Normal, normal);
            for (int i = 0; i < support.Count; ++i)
                sum += (before ? support.Before[i] : support.After[i]) * slope;
        }
        return sum;
    }

    static void Cap(Span<LoadSupport> supports, Vector3 normal, float wanted)
    {
        var sum = Along(supports, normal, before: false);
        if (!(sum > wanted))
            return;
        var scale = wanted / sum;
        foreach (ref var support in supports)
        {
            for (int i = 0; i < support.Count; ++i)
                support.After[i] *= scale;
        }
    }

    static void Clamp(Span<LoadSupport> supports)
    {
        foreach (ref var support in supports)
        {
            float load = 0, lever = 0;
            for (int i = 0; i < support.Count; ++i)
            {
                load += support.After[i];
                lever += support.After[i] * Exact.Distance(support.Arms[i], support.Center);
            }
            support.FrictionAfter = Limit(support.FrictionAfter, support.Friction * load);
            var twist = support.Friction * lever;
            support.TwistAfter = Math.Clamp(support.TwistBefore, -twist, twist);
        }
    }

    internal static Vector3 Limit(Vector3 value, float length)
    {
        var squared = Exact.LengthSquared(value);
        return squared > length * length ? value * (length / MathF.Sqrt(squared)) : value;
    }
}
