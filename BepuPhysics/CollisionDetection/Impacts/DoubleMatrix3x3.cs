using System;
using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>A rotation in double precision, as the axes that it turns those of the world into.</summary>
struct DoubleMatrix3x3
{
    public DoubleVector3 X, Y, Z;

    /// <summary>The rotation of a quaternion of any length but zero.</summary>
    public static DoubleMatrix3x3 FromQuaternion(in Quaternion q)
    {
        double x = q.X, y = q.Y, z = q.Z, w = q.W;
        var twice = 2 / (x * x + y * y + z * z + w * w);
        double xx = x * x * twice, yy = y * y * twice, zz = z * z * twice;
        double xy = x * y * twice, yz = y * z * twice, zx = z * x * twice;
        double xw = x * w * twice, yw = y * w * twice, zw = z * w * twice;
        return new()
        {
            X = new(1 - yy - zz, xy + zw, zx - yw),
            Y = new(xy - zw, 1 - xx - zz, yz + xw),
            Z = new(zx + yw, yz - xw, 1 - xx - yy),
        };
    }

    /// <summary>The rotation about a unit axis, by sine and cosine of its angle.</summary>
    public static DoubleMatrix3x3 FromAxis(in DoubleVector3 axis, double sine, double cosine)
    {
        var rest = 1 - cosine;
        double x = axis.X, y = axis.Y, z = axis.Z;
        double xs = x * sine, ys = y * sine, zs = z * sine;
        double xy = x * y * rest, yz = y * z * rest, zx = z * x * rest;
        return new()
        {
            X = new(cosine + x * x * rest, xy + zs, zx - ys),
            Y = new(xy - zs, cosine + y * y * rest, yz + xs),
            Z = new(zx + ys, yz - xs, cosine + z * z * rest),
        };
    }

    /// <summary>Turns a vector.</summary>
    public readonly DoubleVector3 Turn(in DoubleVector3 v) => new(
        X.X * v.X + Y.X * v.Y + Z.X * v.Z,
        X.Y * v.X + Y.Y * v.Y + Z.Y * v.Z,
        X.Z * v.X + Y.Z * v.Y + Z.Z * v.Z);

    /// <summary>Turns a vector back.</summary>
    public readonly DoubleVector3 TurnBack(in DoubleVector3 v) =>
        new(DoubleVector3.Dot(X, v), DoubleVector3.Dot(Y, v), DoubleVector3.Dot(Z, v));

    /// <summary>The rotation that another one does first.</summary>
    public readonly DoubleMatrix3x3 After(in DoubleMatrix3x3 first) => new() { X = Turn(first.X), Y = Turn(first.Y), Z = Turn(first.Z) };

    const double QuarterTurn = 1.5707963267948966, QuarterTurnRest = 6.123233995736766e-17;
    // Up to here the number of quarter turns times the rounding of the first part is below 1e-16.
    const double LargestPlainAngle = 1e5;

    /// <summary>
    /// Sine and cosine of an angle, to a few roundings: by the series, within an eighth of a turn of the nearest quarter.
    /// </summary>
    // The framework's own are those of each system's C library.
    public static void SineAndCosine(double angle, out double sine, out double cosine)
    {
        if (!(Math.Abs(angle) <= LargestPlainAngle))
            angle %= 4 * QuarterTurn;
        var quarters = (long)(angle / QuarterTurn + (angle < 0 ? -0.5 : 0.5));
        var x = angle - quarters * QuarterTurn - quarters * QuarterTurnRest;
        var xx = x * x;
        var s = 1 - xx * (1.0 / 210) * (1 - xx * (1.0 / 272));
        s = 1 - xx * (1.0 / 72) * (1 - xx * (1.0 / 110) * (1 - xx * (1.0 / 156) * s));
        s = x * (1 - xx * (1.0 / 6) * (1 - xx * (1.0 / 20) * (1 - xx * (1.0 / 42) * s)));
        var c = 1 - xx * (1.0 / 182) * (1 - xx * (1.0 / 240));
        c = 1 - xx * (1.0 / 56) * (1 - xx * (1.0 / 90) * (1 - xx * (1.0 / 132) * c));
        c = 1 - xx * (1.0 / 2) * (1 - xx * (1.0 / 12) * (1 - xx * (1.0 / 30) * c));
        (sine, cosine) = (quarters & 3) switch
        {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        };
    }
}
