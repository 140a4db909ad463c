using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How a joint closes a gap that it is added with.</summary>
// A joint that is off by C holds the energy of a spring, w^2 C K^-1 C / 2, and w is as great as a substep can hold: a metre between two bodies of a kilogram
// is worth nine kilojoules at the default setting, and they come together at 69 m/s. That is nothing that a motion has made: a rope that is cut and joined
// again a second later has metres at once.
//
// So a joint that is added, or enabled, with a gap is damped until that is closed, with its stiffness kept: it bears what it would, and comes to where it would
// rest no faster than its bodies can follow. What opens later, by a load or because a game moves a body, is corrected as ever: who pulls a rope by the pose
// of a kinematic body wants it to come along. So how small the gap has been is kept, coarsely: one of a joint with a kinematic body that becomes much greater
// while the bodies approach each other is another one. What their motion opens is not: it is the last that is to be closed at once.
static class JointGap
{
    // Time constant with which a gap closes, s.
    const float Time = 0.2f;
    // Radii of gyration, or radians, by which correcting a gap moves or turns a body in a second at most.
    const float Speed = 5;
    /// <summary>What is no gap: the way that correcting it makes for a body, in radii of gyration or radians.</summary>
    internal const float Near = 0.05f;

    // Half octaves of the square of the way, from that which is no gap: up to 2700 radii. What is farther away has the last one, as what is new has.
    const int LevelShift = 22;
    const int Last = EncodedBody.GapMask >> EncodedBody.GapShift;
    // Levels by which a gap may grow: to between 1.7 and 2.4 times the way. How far it is for a body changes with its turn.
    const int Growth = 3;
    /// <summary>The same as a part of the way.</summary>
    internal const float GreatestGrowth = 2;

    /// <summary>Notes how small gaps have been; nothing where there is none any more, or another one.</summary>
    /// <param name="noted">What was noted before, as it is in references.</param>
    /// <param name="waySquared">Square of the way; zero where there is no gap.</param>
    /// <param name="isFixed">Lanes in which a game may move one of the bodies by its pose alone, kinematic ones.</param>
    /// <param name="opens">Lanes in which the bodies move so that there will be more of it.</param>
    internal static Vector<int> Follow(Vector<int> noted, Vector<float> waySquared, Vector<int> isFixed, Vector<int> opens)
    {
        var nearest = (BitConverter.SingleToInt32Bits(Near * Near) >> LevelShift) - 1;
        var level = (Vector.AsVectorInt32(waySquared) >> LevelShift) - new Vector<int>(nearest);
        level = Least(level, new Vector<int>(Last));
        var before = noted >> EncodedBody.GapShift;
        var stays = Vector.GreaterThan(before, Vector<int>.Zero) & Vector.GreaterThan(waySquared, Vector<float>.Zero) &
            ~(Vector.AndNot(isFixed, opens) & Vector.GreaterThan(level, before + new Vector<int>(Growth)));
        return stays & (Wide.Select(opens, level, Least(level, before)) << EncodedBody.GapShift);
    }

    static Vector<int> Least(Vector<int> a, Vector<int> b) => Vector.ConditionalSelect(Vector.LessThan(a, b), a, b);

    /// <summary>Part of a gap that is closed in a second, 1/s.</summary>
    /// <param name="way">The way that correcting it makes for a body, in radii of gyration or radians; above zero.</param>
    internal static double RateOf(double way) => Math.Min(1 / Time, Speed / way);

    /// <summary>The same, as a part of what a spring would close.</summary>
    /// <param name="waySquared">Square of the way.</param>
    /// <param name="softness">The spring.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> PartOf(Vector<float> waySquared, in SoftnessWide softness)
    {
        var rate = Wide.Min(new Vector<float>(1 / Time), new Vector<float>(Speed) / Vector.SquareRoot(waySquared));
        return Wide.Min(Vector<float>.One, rate / softness.ErrorToVelocity);
    }

    /// <summary>Lanes in which a way is that of a gap.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> IsFar(Vector<float> waySquared) => Vector.GreaterThan(waySquared, new Vector<float>(Near * Near));

    /// <summary>Square of the way that a body goes in a second, in radii of gyration, or that it turns by, rad: the greater of the two.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> WaySquared(in SolverBodyWide body)
    {
        var trace = body.InverseInertia.XX + body.InverseInertia.YY + body.InverseInertia.ZZ;
        var scale = new Vector<float>(3) * body.InverseMass;
        var linear = Wide.Mask(Vector.GreaterThan(scale, Vector<float>.Zero), body.Linear.LengthSquared() * trace / scale);
        return Wide.Max(linear, body.Angular.LengthSquared());
    }
}
