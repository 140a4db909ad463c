using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>How far a joint that is off corrects itself in a substep.</summary>
// All that it is off by, as a rule. But velocities are solved for as bodies lie: what turns a body far, or moves it by its own size, brings its joints
// somewhere else than it was meant to, they are further off than before, and the next correction is greater. A game that puts the parts of a ragdoll together
// a foot apart, or moves one of them, has such errors; what a joint is off by after a substep of any motion that a substep can follow is far below.
static unsafe class Correction
{
    // Of a body's size, and of a radian.
    const double GreatestPart = 0.2;

    /// <summary>Lessens what the rows of a joint are after.</summary>
    internal static void Limit(
        in DirectNode node, TypeProcessor processor, DirectPair* jacobian, DirectRow* rows, in QuickList<DirectBody> bodies,
        Buffer<BodyInertia> inertias, float dt)
    {
        double linear = 0, angular = 0;
        for (int row = 0; row < node.RowCount; ++row)
        {
            if (processor.IsLinear(row))
                linear += rows[row].Target * rows[row].Target;
            else
                angular += rows[row].Target * rows[row].Target;
        }
        var part = 1d;
        if (linear > 0)
            part = Reach(node, processor, jacobian, bodies, inertias) * GreatestPart / (Math.Sqrt(linear) * dt);
        if (angular > 0)
            part = Math.Min(part, GreatestPart / (Math.Sqrt(angular) * dt));
        for (int row = 0; row < node.RowCount && part < 1; ++row)
            rows[row].Target *= part;
    }

    /// <summary>What an error along directions is judged by: the least radius of gyration of a body about where the joint holds it.</summary>
    // A body without an arm is not turned by what moves it, and counts only where there are no others: by the size of the largest, about the axis that it turns
    // about with the most effort. What is not turned at all, and moved, has no size.
    internal static double Reach(
        in DirectNode node, TypeProcessor processor, DirectPair* jacobian, in QuickList<DirectBody> bodies, Buffer<BodyInertia> inertias)
    {
        double least = double.PositiveInfinity, greatest = 0;
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            var reference = bodies[node.Bodies[slot]].Reference;
            ref var inertia = ref inertias[reference & EncodedBody.IndexMask];
            if (!(inertia.InverseMass > 0))
                continue;
            ref var inverse = ref inertia.InverseInertiaTensor;
            // The angular part of a row along a direction is as long as its arm. Those about axes have none.
            double arm = 0;
            for (int row = 0; row < node.RowCount; ++row)
            {
                if (processor.IsLinear(row))
                    arm = Math.Max(arm, DirectPair.AngularLengthSquared(jacobian[row * node.BodyCount + slot]));
            }
            var trace = (double)inverse.XX + inverse.YY + inverse.ZZ;
            if (arm > 0 && trace > 0)
                least = Math.Min(least, 3 * inertia.InverseMass / trace + arm);
            greatest = Math.Max(greatest, inertia.InverseMass / Math.Min(Math.Min((double)inverse.XX, inverse.YY), inverse.ZZ));
        }
        return Math.Sqrt(double.IsFinite(least) || greatest == 0 ? least : greatest);
    }
}
