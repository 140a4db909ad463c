using System;
using System.Runtime.CompilerServices;

namespace BepuPhysics.Collidables;

/// <summary>A point of the grid that hulls are built on: whole numbers below 2^41, which a double holds without rounding.</summary>
struct HullPoint
{
    public double X, Y, Z;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public HullPoint(double x, double y, double z)
    {
        X = x;
        Y = y;
        Z = z;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static HullPoint operator +(in HullPoint a, in HullPoint b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static HullPoint operator -(in HullPoint a, in HullPoint b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static HullPoint operator *(in HullPoint a, double scale) => new(a.X * scale, a.Y * scale, a.Z * scale);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double Dot(in HullPoint a, in HullPoint b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static HullPoint Cross(in HullPoint a, in HullPoint b) =>
        new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double Length(in HullPoint a) => Math.Sqrt(Dot(a, a));

    /// <summary>Normal of a triangle of grid points, twice its area long, each component rounded once.</summary>
    public static HullPoint Normal(in HullPoint a, in HullPoint b, in HullPoint c)
    {
        ExactNormal(a, b, c, out var x, out var y, out var z);
        return new((double)x, (double)y, (double)z);
    }

    /// <summary>Whether a grid point is above (1), in (0) or below (-1) the plane of a triangle, without any rounding.</summary>
    // Differences have 42 bits with their sign, so the sum below has at most 127.
    public static int Side(in HullPoint a, in HullPoint b, in HullPoint c, in HullPoint point)
    {
        ExactNormal(a, b, c, out var x, out var y, out var z);
        var height = x * (long)(point.X - a.X) + y * (long)(point.Y - a.Y) + z * (long)(point.Z - a.Z);
        return Int128.Sign(height);
    }

    static void ExactNormal(in HullPoint a, in HullPoint b, in HullPoint c, out Int128 x, out Int128 y, out Int128 z)
    {
        long ux = (long)(b.X - a.X), uy = (long)(b.Y - a.Y), uz = (long)(b.Z - a.Z);
        long vx = (long)(c.X - a.X), vy = (long)(c.Y - a.Y), vz = (long)(c.Z - a.Z);
        x = (Int128)uy * vz - (Int128)uz * vy;
        y = (Int128)uz * vx - (Int128)ux * vz;
        z = (Int128)ux * vy - (Int128)uy * vx;
    }
}
