using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>A vector in double precision.</summary>
readonly struct DoubleVector3(double x, double y, double z)
{
    public readonly double X = x, Y = y, Z = z;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public DoubleVector3(in Vector3 v) : this(v.X, v.Y, v.Z) { }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static DoubleVector3 operator +(in DoubleVector3 a, in DoubleVector3 b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static DoubleVector3 operator -(in DoubleVector3 a, in DoubleVector3 b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static DoubleVector3 operator -(in DoubleVector3 v) => new(-v.X, -v.Y, -v.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static DoubleVector3 operator *(in DoubleVector3 v, double scale) => new(v.X * scale, v.Y * scale, v.Z * scale);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double Dot(in DoubleVector3 a, in DoubleVector3 b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static DoubleVector3 Cross(in DoubleVector3 a, in DoubleVector3 b) =>
        new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    public double Length
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Math.Sqrt(X * X + Y * Y + Z * Z);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector3 ToSingle() => new((float)X, (float)Y, (float)Z);
}
