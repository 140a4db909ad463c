using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>Balls about shapes, which must meet before the shapes do.</summary>
static class ImpactBalls
{
    // More than the distance at which shapes count as touching, by both radii.
    const double Slack = 8 * ImpactPair.TouchingPart;

    /// <summary>A time before which two balls are apart by more than what counts as touching; infinite where they never meet.</summary>
    /// <param name="offset">From the centre of the one that moves to that of the other, m.</param>
    /// <param name="linear">Velocity of the one that moves, m/s.</param>
    /// <param name="radii">Both radii together, m.</param>
    public static double FirstMeeting(in DoubleVector3 offset, in DoubleVector3 linear, double radii)
    {
        var reach = radii * (1 + Slack);
        var apart = DoubleVector3.Dot(offset, offset) - reach * reach;
        if (apart <= 0)
            return 0;
        // |offset - linear t| = reach, of which the smaller root is meant: q t^2 - 2 p t + apart = 0.
        double p = DoubleVector3.Dot(offset, linear), q = DoubleVector3.Dot(linear, linear);
        var discriminant = p * p - q * apart;
        return p > 0 && discriminant >= 0 ? apart / (p + Math.Sqrt(discriminant)) : double.PositiveInfinity;
    }
}
