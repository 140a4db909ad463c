using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>When a ball that does not overlap another ball, or a half-space, comes as near as a distance: in closed form.</summary>
static class BallImpact
{
    // What overlap is told by: beyond rounding, by all lengths there are. And the least distance that counts as touching, by the same.
    const double OverlapPart = 1e-12, RoundingPart = 4e-12;

    /// <summary>Two balls.</summary>
    /// <param name="offset">From the centre of the one that moves to that of the other, m.</param>
    /// <param name="linear">Velocity of the one that moves, m/s.</param>
    /// <param name="radii">Both radii together, m.</param>
    /// <param name="touching">Distance that counts as touching, where they begin farther apart than twice that, m.</param>
    /// <param name="time">When they touch, s; infinite if they never do.</param>
    /// <returns>Whether they are apart at the beginning.</returns>
    public static bool TryMeet(in DoubleVector3 offset, in DoubleVector3 linear, double radii, double touching, out double time)
    {
        time = double.PositiveInfinity;
        double distance = DoubleVector3.Dot(offset, offset), p = DoubleVector3.Dot(offset, linear);
        // Most are apart, and pass each other or part: that takes no root.
        var far = radii + touching * 2;
        if (distance > far * far)
        {
            var reach = radii + touching;
            time = FirstTime(distance, p, linear, reach);
            return true;
        }
        distance = Math.Sqrt(distance);
        var lengths = distance + radii;
        if (!(distance - radii > lengths * OverlapPart))
            return false;
        // What begins as good as in touch has an impact only if it comes nearer still.
        touching = Math.Max((distance - radii) * 0.5, lengths * RoundingPart);
        time = Math.Max(0, FirstTime(distance * distance, p, linear, radii + touching));
        return true;
    }

    // |offset - linear t| = reach, of which the smaller root is meant: q t^2 - 2 p t + apart = 0.
    static double FirstTime(double squaredDistance, double p, in DoubleVector3 linear, double reach)
    {
        if (!(p > 0))
            return double.PositiveInfinity;
        var apart = squaredDistance - reach * reach;
        var discriminant = p * p - DoubleVector3.Dot(linear, linear) * apart;
        return discriminant >= 0 ? apart / (p + Math.Sqrt(discriminant)) : double.PositiveInfinity;
    }

    /// <summary>A ball above a half-space.</summary>
    /// <param name="height">Height of the ball's centre above the plane, m.</param>
    /// <param name="approach">Speed at which that becomes less, m/s.</param>
    /// <param name="radius">Radius of the ball, m.</param>
    /// <param name="touching">Distance that counts as touching, where it begins farther away than twice that, m.</param>
    /// <param name="time">When it touches, s; infinite if it never does.</param>
    /// <returns>Whether they are apart at the beginning.</returns>
    public static bool TryLand(double height, double approach, double radius, double touching, out double time)
    {
        time = double.PositiveInfinity;
        var gap = height - radius;
        if (!(gap > (Math.Abs(height) + radius) * OverlapPart))
            return false;
        if (approach > 0)
            time = (gap - Math.Min(touching, gap * 0.5)) / approach;
        return true;
    }
}
