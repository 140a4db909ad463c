using System;
using System.Numerics;

namespace DemoTests.CollisionDetection.References;

/// <summary>A vector of doubles.</summary>
readonly record struct Double3(double X, double Y, double Z)
{
    public Double3(Vector3 v) : this(v.X, v.Y, v.Z) { }

    public double this[int i] => i == 0 ? X : i == 1 ? Y : Z;

    public double Length => Math.Sqrt(Dot(this, this));

    public static Double3 operator +(Double3 a, Double3 b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    public static Double3 operator -(Double3 a, Double3 b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    public static Double3 operator -(Double3 v) => new(-v.X, -v.Y, -v.Z);

    public static Double3 operator *(Double3 v, double scale) => new(v.X * scale, v.Y * scale, v.Z * scale);

    public static double Dot(Double3 a, Double3 b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

    public static Double3 Cross(Double3 a, Double3 b) => new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    /// <summary>A rotated unit axis; the quaternion is normalised here, as that of floats is so only to their rounding.</summary>
    public static Double3 RotatedAxis(Quaternion q, int axis)
    {
        double x = q.X, y = q.Y, z = q.Z, w = q.W;
        var scale = 2 / (x * x + y * y + z * z + w * w);
        return axis switch
        {
            0 => new(1 - scale * (y * y + z * z), scale * (x * y + z * w), scale * (x * z - y * w)),
            1 => new(scale * (x * y - z * w), 1 - scale * (x * x + z * z), scale * (y * z + x * w)),
            _ => new(scale * (x * z + y * w), scale * (y * z - x * w), 1 - scale * (x * x + y * y)),
        };
    }
}
