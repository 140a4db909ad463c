using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What a constant angular velocity makes of an orientation.</summary>
static class BodyTurn
{
    /// <summary>The rotation in a time.</summary>
    /// <param name="angular">Angular velocity, rad/s.</param>
    /// <param name="time">The time, s.</param>
    public static DoubleMatrix3x3 Of(in DoubleVector3 angular, double time)
    {
        var speed = angular.Length;
        var isTurned = speed > 0;
        DoubleMatrix3x3.SineAndCosine(speed * time, out var sine, out var cosine);
        return DoubleMatrix3x3.FromAxis(isTurned ? angular * (1 / speed) : default, isTurned ? sine : 0, isTurned ? cosine : 1);
    }

    /// <summary>An orientation after a time.</summary>
    /// <param name="orientation">The orientation; unit length.</param>
    /// <param name="angular">Angular velocity, rad/s.</param>
    /// <param name="time">The time, s.</param>
    public static Quaternion Turn(in Quaternion orientation, in DoubleVector3 angular, double time)
    {
        var speed = angular.Length;
        if (!(speed > 0) || time == 0)
            return orientation;
        DoubleMatrix3x3.SineAndCosine(speed * time * 0.5, out var sine, out var cosine);
        var axis = (angular * (sine / speed)).ToSingle();
        return Exact.Normalize(Exact.Concatenate(orientation, new Quaternion(axis, (float)cosine)));
    }

    const double WholeTurn = 6.283185307179586;

    /// <summary>The turn from one orientation to another that is most like one that is expected: its axis, as long as its angle in rad.</summary>
    /// <param name="from">The one; unit length.</param>
    /// <param name="to">The other; unit length.</param>
    /// <param name="expected">What is expected, rad.</param>
    public static DoubleVector3 Between(in Quaternion from, in Quaternion to, in DoubleVector3 expected)
    {
        // In doubles: of a small turn floats would leave little.
        double x = to.W * (double)-from.X + to.X * (double)from.W + to.Y * (double)-from.Z - to.Z * (double)-from.Y;
        double y = to.W * (double)-from.Y + to.Y * (double)from.W + to.Z * (double)-from.X - to.X * (double)-from.Z;
        double z = to.W * (double)-from.Z + to.Z * (double)from.W + to.X * (double)-from.Y - to.Y * (double)-from.X;
        double w = to.W * (double)from.W + to.X * (double)from.X + to.Y * (double)from.Y + to.Z * (double)from.Z;
        var axis = new DoubleVector3(x, y, z);
        if (w < 0)
            (axis, w) = (-axis, -w);
        var sine = axis.Length;
        if (!(sine > 0))
            return default;
        // What a float knows of half of the angle, and what is left of it.
        double half = MathHelper.Atan2((float)sine, (float)w);
        DoubleMatrix3x3.SineAndCosine(half, out var s, out var c);
        half += (sine * c - w * s) / Math.Sqrt(sine * sine + w * w);
        var turns = Math.Round((DoubleVector3.Dot(axis, expected) / sine - 2 * half) / WholeTurn);
        return axis * ((2 * half + turns * WholeTurn) / sine);
    }
}
