using System;

namespace BepuPhysics.CollisionDetection;

// How far the time may go on.
ref partial struct ImpactPair
{
    // How many times farther a body that turns reaches than the other one is away, from which on it counts how the other one moves in its frame.
    const double FarReach = 16;

    // Rounds after which both count how the other one moves in their frames. What goes along what turns, and comes no nearer, as a ball along a plate, comes
    // at it with all of its speed for the world's axes.
    const int PlainRounds = 24;

    /// <summary>A time in which the shapes cannot cross a gap along the normal; infinite where they cannot in the time that is left, s.</summary>
    readonly double LongestSafe(double width, int round, double left)
    {
        var closing = DoubleVector3.Dot(linear, normal);
        if (!a.Turns && !b.Turns)
            return closing > 0 ? width / closing : double.PositiveInfinity;
        // Most are too far apart for the fastest of their points.
        var fastest = closing + a.SurfaceSpeed + b.SurfaceSpeed;
        if (fastest <= 0 || fastest * left < width)
            return double.PositiveInfinity;
        var dt = LongestSafeBySpeeds(width, closing, left);
        var offset = offsetB - centerA;
        if (IsFarReaching(a, b, offset, round))
            dt = Math.Max(dt, LongestSafeInFrame(a, b, normal, offset, -linear, width));
        if (IsFarReaching(b, a, offset, round))
            dt = Math.Max(dt, LongestSafeInFrame(b, a, -normal, -offset, linear, width));
        return dt;
    }

    readonly bool IsFarReaching(in ImpactBody body, in ImpactBody other, in DoubleVector3 offset, int round) =>
        body.Turns && !b.Core.IsPlane && (round >= PlainRounds || body.Reach > FarReach * (offset.Length + other.Reach));

    /// <summary>
    /// As <see cref="LongestSafe"/>, in the frame of a body that turns: the ends of a long one are fast, but not near what is beside its middle.
    /// </summary>
    /// <remarks>
    /// In that frame the body rests, and so does the plane. A point p of the other one, from the centre of the body, moves with v - w x p, along the plane's
    /// normal at a rate that is greatest at a farthest point of the other shape; what Coriolis and centrifugal accelerations, the other one's own turn, and
    /// the change of w (the body's spin about the axis about which it is round is none of its frame) make of it is a bound for p that is twice as far.
    /// </remarks>
    /// <param name="body">The body.</param>
    /// <param name="other">The other one.</param>
    /// <param name="n">Unit direction from the one to the other.</param>
    /// <param name="offset">Centre of the other body from that of the body, m.</param>
    /// <param name="velocity">Velocity of the other body against the body, m/s.</param>
    /// <param name="width">The gap, m.</param>
    static double LongestSafeInFrame(in ImpactBody body, in ImpactBody other, in DoubleVector3 n, in DoubleVector3 offset, in DoubleVector3 velocity,
        double width)
    {
        var frame = body.Moving;
        var turn = other.Turns ? frame - other.Angular : frame;
        var across = DoubleVector3.Cross(n, turn);
        var size = across.Length;
        var closing = DoubleVector3.Dot(n, DoubleVector3.Cross(frame, offset) - velocity) + (size > 0 ? other.Extent(across * (1 / size)) * size : 0);
        double frameSpeed = frame.Length, speed = velocity.Length, away = offset.Length + other.Reach;
        var own = other.Speed * other.Reach;
        var acceleration = own * other.Speed + 2 * frameSpeed * (speed + own) + frameSpeed * (frameSpeed + body.Speed) * 2 * away;
        var dt = SolveQuadratic(0.5 * acceleration, closing, width);
        return speed > 0 ? Math.Min(dt, away / speed) : dt;
    }

    readonly double LongestSafeBySpeeds(double width, double closing, double left)
    {
        double greatest = closing, linearPart = closing, quadratic = 0, revolved = width;
        Add(a, normal, ref linearPart, ref quadratic, ref greatest, ref revolved);
        Add(b, -normal, ref linearPart, ref quadratic, ref greatest, ref revolved);
        if (revolved > 0 && closing <= 0)
            return double.PositiveInfinity;
        var dt = SolveQuadratic(quadratic, linearPart, width);
        if (greatest <= 0)
            return double.PositiveInfinity;
        dt = Math.Max(dt, width / greatest);
        if (revolved > 0)
            dt = Math.Max(dt, revolved / closing);
        return dt > left ? dt : TryLater(width, closing, dt);
    }

    static void Add(
        in ImpactBody body, in DoubleVector3 n, ref double linear, ref double quadratic, ref double greatest, ref double revolved)
    {
        if (!body.Turns)
            return;
        body.BoundApproach(n, out var bodyLinear, out var bodyQuadratic, out var bodyGreatest);
        linear += bodyLinear;
        quadratic += bodyQuadratic;
        greatest += bodyGreatest;
        revolved -= body.GreatestExtent(n) - body.Extent(n);
    }

    // When q t^2 + p t first is c, for q >= 0 and c > 0.
    static double SolveQuadratic(double q, double p, double c)
    {
        if (q <= 0)
            return p > 0 ? c / p : double.PositiveInfinity;
        var root = Math.Sqrt(p * p + 4 * q * c);
        return p > 0 ? 2 * c / (p + root) : (root - p) / (2 * q);
    }

    /// <summary>A time as long as one that is safe, or longer, by where the shapes reach later.</summary>
    /// <remarks>
    /// A body that turns by an angle A reaches along n as it does along n(s) = n0 + n1(s) in its first frame, of which n0 is along the
    /// axis, and n1 turns by A. With the chord's weights p and q, n1(s) = p n1(0) + q n1(A), p + q at most 1 / cos(A / 2), so that n(s) =
    /// p n(0) + q n(A) - (p + q - 1) n0. A support function is convex and linear in lengths: it is at most what the chord says, and the
    /// excess of p + q times what it is at its ends and along -n0.
    /// </remarks>
    readonly double TryLater(double width, double closing, double dt)
    {
        const int Tries = 4;
        const double MaximumAngle = 1.5;
        double extentA = 0, extentB = 0, axialA = 0, axialB = 0;
        if (a.Turns)
        {
            extentA = a.Extent(normal);
            axialA = Math.Max(0, a.ExtentAlongAxis(normal));
        }
        if (b.Turns)
        {
            extentB = b.Extent(-normal);
            axialB = Math.Max(0, b.ExtentAlongAxis(-normal));
        }
        var excess = Math.Max(0, extentA) + axialA + Math.Max(0, extentB) + axialB;
        // Half of the width for the excess, A^2 / 8 of what there is.
        var angle = excess * MaximumAngle * MaximumAngle < 4 * width ? MaximumAngle : 2 * Math.Sqrt(width / excess);
        var later = angle / Math.Max(a.Speed, b.Speed);
        for (int i = 0; i < Tries && later > dt * 1.25; ++i)
        {
            var moved = closing * later;
            var bent = 0.0;
            if (a.Turns)
                AddLater(a, normal, later, extentA, axialA, ref moved, ref bent);
            if (b.Turns)
                AddLater(b, -normal, later, extentB, axialB, ref moved, ref bent);
            var used = Math.Max(0, moved) + bent;
            if (used <= width)
                return later;
            later *= Math.Max(0.1, 0.9 * width / used);
        }
        return dt;
    }

    static void AddLater(in ImpactBody body, in DoubleVector3 n, double dt, double extent, double axial, ref double moved, ref double bent)
    {
        var later = body.ExtentAfter(n, dt);
        var eighth = body.Speed * dt * body.Speed * dt * 0.125;
        // 1 / cos(A / 2) - 1, by cos x >= 1 - x^2 / 2.
        bent += eighth / (1 - eighth) * (Math.Max(0, Math.Max(extent, later)) + axial);
        moved += later - extent;
    }
}
