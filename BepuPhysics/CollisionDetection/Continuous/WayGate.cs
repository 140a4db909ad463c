using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tells by the ways of two centres alone that shapes cannot meet, which is so for most pairs: then there is nothing to sweep.</summary>
// It lets pass whatever a sweep might find to touch, and more: so no answer depends on it.
struct WayGate
{
    // For the rounding of what is a float elsewhere, as a part of both reaches: less than what balls about shapes have to spare (ImpactBalls).
    const double Slack = 1e-6;

    // How far the shapes reach from their centres, and what counts as touching, m: both together, and A alone.
    double reach, reachOfA;
    // Of a half-space that does not move: its normal. Of another static: its bounds.
    DoubleVector3 first, second;
    bool isPlane, isStatic;

    /// <summary>How far B reaches from its centre, m; infinite if it is a half-space.</summary>
    public double ReachOfB { get; private set; }

    /// <summary>Says how far the shapes reach.</summary>
    /// <param name="a">From the centre of A, m.</param>
    /// <param name="b">From that of B, m; infinite if it is a half-space.</param>
    /// <param name="touching">Distance that counts as touching, m.</param>
    public void Set(double a, double b, double touching)
    {
        reach = (a + b) * (1 + Slack) + touching;
        reachOfA = a * (1 + 16 * Slack) + 2 * touching;
        ReachOfB = b;
        isPlane = isStatic = false;
    }

    /// <summary>Says that B is a half-space that does not move.</summary>
    /// <param name="plane">The half-space.</param>
    /// <param name="orientation">Its orientation.</param>
    public void SetPlane(in HalfSpace plane, in Quaternion orientation)
    {
        first = DoubleMatrix3x3.FromQuaternion(orientation).Turn(new(plane.Normal));
        isPlane = true;
    }

    /// <summary>Says that B does not move.</summary>
    /// <param name="min">Lower corner of its bounds, m.</param>
    /// <param name="max">Upper corner of its bounds, m.</param>
    public void SetStatic(in DoubleVector3 min, in DoubleVector3 max)
    {
        first = min - Rounding(min);
        second = max + Rounding(max);
        isStatic = true;
    }

    // Of bounds, which are floats.
    static DoubleVector3 Rounding(in DoubleVector3 v) => new DoubleVector3(Math.Abs(v.X), Math.Abs(v.Y), Math.Abs(v.Z)) * Slack;

    /// <summary>Whether the shapes may meet in a time.</summary>
    /// <param name="a">Where A begins, m.</param>
    /// <param name="b">Where B begins, m.</param>
    /// <param name="linearA">Velocity of A, m/s.</param>
    /// <param name="linearB">Velocity of B, m/s.</param>
    /// <param name="dt">The time, s.</param>
    /// <param name="spare">By how much they may come nearer than that says, m.</param>
    public readonly bool MayMeet(
        in DoubleVector3 a, in DoubleVector3 b, in DoubleVector3 linearA, in DoubleVector3 linearB, double dt, double spare = 0)
    {
        if (isPlane)
        {
            var height = DoubleVector3.Dot(first, a - b);
            return Math.Min(height, height + DoubleVector3.Dot(first, linearA) * dt) <= reachOfA + spare;
        }
        if (isStatic)
        {
            var end = a + linearA * dt;
            var nearest = reachOfA + spare;
            if (IsBeside(a.X, end.X, first.X, second.X, nearest) || IsBeside(a.Y, end.Y, first.Y, second.Y, nearest) ||
                IsBeside(a.Z, end.Z, first.Z, second.Z, nearest))
                return false;
        }
        return ImpactBalls.FirstMeeting(b - a, linearA - linearB, reach + spare) <= dt;
    }

    /// <summary>Time up to which the shapes cannot meet, of a time that is looked at, s: infinite if they cannot in all of it.</summary>
    /// <inheritdoc cref="MayMeet"/>
    public readonly double ApartUntil(
        in DoubleVector3 a, in DoubleVector3 b, in DoubleVector3 linearA, in DoubleVector3 linearB, double dt, double spare)
    {
        if (!MayMeet(a, b, linearA, linearB, dt, spare))
            return double.PositiveInfinity;
        if (!isPlane)
            return ImpactBalls.FirstMeeting(b - a, linearA - linearB, reach + spare);
        double above = DoubleVector3.Dot(first, a - b) - (reachOfA + spare), approach = -DoubleVector3.Dot(first, linearA);
        return above > 0 && approach > 0 ? above / approach : 0;
    }

    static bool IsBeside(double start, double end, double min, double max, double reach) =>
        Math.Max(start, end) + reach < min || Math.Min(start, end) - reach > max;
}
