using System;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>How far a joint that is off corrects itself in a substep.</summary>
// All that it is off by, as a rule. But velocities are solved for as bodies lie: what turns a body far, or moves it by its own size, brings its joints
// somewhere else than it was meant to, they are further off than before, and the next correction is greater. A game that puts the parts of a ragdoll together
// a foot apart, or moves one of them, has such errors; what a joint is off by after a substep of any motion that a substep can follow is far below.
//
// Nor is what no motion has made corrected in one substep h: it would be corrected with C / h, whose energy C^2 / (2 K h^2) comes from nowhere. Rows whose
// derivatives jump have such errors (the twist of a rack's pinion jumps where that has swung by half a turn, by up to half a tooth), and so have light bodies
// at the end of arms that whip, which no substep follows. A motion that turns a joint by w h on an arm r leaves it off by (w h)^2 r / 2, a part w h / 2 of the
// way that it goes: a twentieth, if a substep follows it. What is beyond that, and more than joints are off by anyway, goes with a time constant.
static class Correction
{
    // Of a body's size, and of a radian.
    const double GreatestPart = 0.2;
    // Of the way that bodies go about a joint in a substep, which they leave it off by.
    const double OwnPart = 0.05;
    // Of what a joint is off by beyond that, s. At .02 s, the time of the sweeps, 8 of 600 trees of racks gain energy, and none at .1 s.
    const double BeyondTime = 0.1;

    /// <summary>Lessens what the rows of a joint are after.</summary>
    internal static void Limit(in JointLane joint, in BodySet set, float dt)
    {
        double linear = 0, angular = 0;
        for (int row = 0; row < joint.RowCount; ++row)
        {
            if (joint.IsLinear(row))
                linear += joint.Target(row) * joint.Target(row);
            else
                angular += joint.Target(row) * joint.Target(row);
        }
        var part = 1d;
        if (IsSmall(joint.BodyCount, ref joint.References, linear * dt * dt, angular * dt * dt, set.LocalInertias))
            return;
        // Those that have bounds go at the rate of the sweeps already.
        double way = double.PositiveInfinity, turn = double.PositiveInfinity;
        if (joint.Limit == RowLimit.None)
            (way, turn) = Motion(joint, set.MotionStates, dt);
        if (linear > 0)
        {
            var reach = Reach(joint, set.LocalInertias);
            part = PartOf(Math.Sqrt(linear) * dt, way + turn * reach, reach, dt);
        }
        if (angular > 0)
            part = Math.Min(part, PartOf(Math.Sqrt(angular) * dt, turn, 1, dt));
        for (int row = 0; row < joint.RowCount && part < 1; ++row)
            joint.Target(row) *= part;
    }

    // How far the bodies of a joint move against the first one, and turn, in a substep.
    static (double Way, double Turn) Motion(in JointLane joint, Buffer<MotionState> motions, float dt)
    {
        double way = 0, turn = 0;
        ref var first = ref motions[joint.Body(0)].Velocity;
        for (int slot = 0; slot < joint.BodyCount; ++slot)
        {
            ref var velocity = ref motions[joint.Body(slot)].Velocity;
            way = Math.Max(way, Exact.LengthSquared(velocity.Linear - first.Linear));
            turn = Math.Max(turn, Exact.LengthSquared(velocity.Angular));
        }
        return (Math.Sqrt(way) * dt, Math.Sqrt(turn) * dt);
    }

    /// <summary>Whether errors are no more than joints are off by anyway, by the radii of gyration alone: what the reach is at least.</summary>
    /// <param name="bodyCount">Number of the joint's bodies.</param>
    /// <param name="references">Reference to the first of them in the type batch.</param>
    /// <param name="linear">Square of the error along directions.</param>
    /// <param name="angular">Square of that about axes.</param>
    /// <param name="inertias">Of all bodies.</param>
    internal static bool IsSmall(int bodyCount, ref int references, double linear, double angular, Buffer<BodyInertia> inertias)
    {
        const double squared = (double)JointNeed.Tolerance * JointNeed.Tolerance;
        if (angular > squared)
            return false;
        for (int slot = 0; slot < bodyCount && linear > 0; ++slot)
        {
            ref var inertia = ref inertias[JointLane.Body(ref references, slot)];
            ref var inverse = ref inertia.InverseInertiaTensor;
            var trace = (double)inverse.XX + inverse.YY + inverse.ZZ;
            if (inertia.InverseMass > 0 && linear * trace > squared * 3 * inertia.InverseMass)
                return false;
        }
        return true;
    }

    // Of an error. Size is that of the bodies, or a radian.
    static double PartOf(double error, double way, double size, float dt)
    {
        var atOnce = OwnPart * way + JointNeed.Tolerance * size;
        var part = error > atOnce ? (atOnce + (error - atOnce) * Math.Min(1, dt / BeyondTime)) / error : 1;
        return Math.Min(part, GreatestPart * size / error);
    }

    /// <summary>What an error along directions is judged by: the least radius of gyration of a body about where the joint holds it.</summary>
    // A body without an arm is not turned by what moves it, and counts only where there are no others: by the size of the largest, about the axis that it turns
    // about with the most effort. What is not turned at all, and moved, has no size.
    internal static double Reach(in JointLane joint, Buffer<BodyInertia> inertias)
    {
        var least = double.PositiveInfinity;
        for (int slot = 0; slot < joint.BodyCount; ++slot)
        {
            ref var inertia = ref inertias[joint.Body(slot)];
            if (!(inertia.InverseMass > 0))
                continue;
            ref var inverse = ref inertia.InverseInertiaTensor;
            // The angular part of a row along a direction is as long as its arm. Those about axes have none.
            double arm = 0;
            for (int row = 0; row < joint.RowCount; ++row)
            {
                if (joint.IsLinear(row))
                    arm = Math.Max(arm, joint.ArmSquared(row, slot));
            }
            var trace = (double)inverse.XX + inverse.YY + inverse.ZZ;
            if (arm > 0 && trace > 0)
                least = Math.Min(least, 3 * inertia.InverseMass / trace + arm);
        }
        return Math.Sqrt(double.IsFinite(least) ? least : ReachWithoutArms(joint, inertias));
    }

    static double ReachWithoutArms(in JointLane joint, Buffer<BodyInertia> inertias)
    {
        double greatest = 0;
        for (int slot = 0; slot < joint.BodyCount; ++slot)
        {
            ref var inertia = ref inertias[joint.Body(slot)];
            ref var inverse = ref inertia.InverseInertiaTensor;
            if (inertia.InverseMass > 0)
                greatest = Math.Max(greatest, inertia.InverseMass / Math.Min(Math.Min((double)inverse.XX, inverse.YY), inverse.ZZ));
        }
        return greatest == 0 ? double.PositiveInfinity : greatest;
    }
}
