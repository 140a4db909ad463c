using System;
using System.Numerics;

namespace Demos.References;

/// <summary>Vector in double precision for references: shares no code with the engine.</summary>
public readonly record struct Double3(double X, double Y, double Z)
{
    public static readonly Double3 Zero = new(0, 0, 0);

    public double LengthSquared => X * X + Y * Y + Z * Z;

    public double Length => Math.Sqrt(LengthSquared);

    public bool IsFinite => double.IsFinite(X) && double.IsFinite(Y) && double.IsFinite(Z);

    public static Double3 operator +(Double3 a, Double3 b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    public static Double3 operator -(Double3 a, Double3 b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    public static Double3 operator -(Double3 a) => new(-a.X, -a.Y, -a.Z);

    public static Double3 operator *(Double3 a, double scale) => new(a.X * scale, a.Y * scale, a.Z * scale);

    public static implicit operator Double3(Vector3 v) => new(v.X, v.Y, v.Z);

    public static double Dot(Double3 a, Double3 b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

    public static Double3 Cross(Double3 a, Double3 b) => new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    /// <summary>Component by component product.</summary>
    public static Double3 Scale(Double3 a, Double3 b) => new(a.X * b.X, a.Y * b.Y, a.Z * b.Z);
}
