using System;
using System.Numerics;

namespace Demos.References;

/// <summary>Rotation in double precision. As a rotation it takes body axes to world axes: world = q * body * conjugate(q).</summary>
public readonly record struct DoubleQuaternion(double X, double Y, double Z, double W)
{
    public static readonly DoubleQuaternion Identity = new(0, 0, 0, 1);

    public double Length => Math.Sqrt(X * X + Y * Y + Z * Z + W * W);

    public DoubleQuaternion Conjugate => new(-X, -Y, -Z, W);

    public static DoubleQuaternion operator +(DoubleQuaternion a, DoubleQuaternion b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z, a.W + b.W);

    public static DoubleQuaternion operator *(DoubleQuaternion q, double scale) => new(q.X * scale, q.Y * scale, q.Z * scale, q.W * scale);

    /// <summary>Hamilton product: as rotations, b is applied first.</summary>
    public static DoubleQuaternion operator *(DoubleQuaternion a, DoubleQuaternion b) => new(
        a.W * b.X + a.X * b.W + a.Y * b.Z - a.Z * b.Y,
        a.W * b.Y - a.X * b.Z + a.Y * b.W + a.Z * b.X,
        a.W * b.Z + a.X * b.Y - a.Y * b.X + a.Z * b.W,
        a.W * b.W - a.X * b.X - a.Y * b.Y - a.Z * b.Z);

    public static implicit operator DoubleQuaternion(Quaternion q) => new(q.X, q.Y, q.Z, q.W);

    public static DoubleQuaternion FromAxisAngle(Double3 unitAxis, double angle)
    {
        double sine = Math.Sin(angle / 2);
        return new(unitAxis.X * sine, unitAxis.Y * sine, unitAxis.Z * sine, Math.Cos(angle / 2));
    }

    public static DoubleQuaternion Normalize(DoubleQuaternion q) => q * (1 / q.Length);

    /// <summary>Body to world.</summary>
    public Double3 Rotate(Double3 v)
    {
        var axis = new Double3(X, Y, Z);
        var turned = Double3.Cross(axis, v) * 2;
        return v + turned * W + Double3.Cross(axis, turned);
    }

    /// <summary>World to body.</summary>
    public Double3 RotateBack(Double3 v) => Conjugate.Rotate(v);

    /// <summary>Smallest angle that takes one attitude to the other, in radians; q and -q are the same attitude.</summary>
    public static double AngleBetween(DoubleQuaternion a, DoubleQuaternion b)
    {
        // atan2 stays exact for small angles, where the arc cosine of the dot product loses half of the digits.
        var difference = Normalize(a) * Normalize(b).Conjugate;
        return 2 * Math.Atan2(new Double3(difference.X, difference.Y, difference.Z).Length, Math.Abs(difference.W));
    }
}
