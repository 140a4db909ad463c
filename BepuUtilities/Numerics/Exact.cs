using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuUtilities;

/// <summary>
/// Scalar vector and quaternion math with a fixed order of operations: the same bits on every CPU, and the same bits as the wide form
/// of each operation.
/// </summary>
/// <remarks>
/// The framework's own Dot, Length, Normalize, Cross, Transform and quaternion product use fused multiply-add or a dot-product
/// instruction where the CPU has one, so they differ between machines; its elementwise operators do not.
/// </remarks>
public static class Exact
{
    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Dot(in Vector3 a, in Vector3 b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Dot(in Vector2 a, in Vector2 b) => a.X * b.X + a.Y * b.Y;

    /// <summary>Inner product of components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Dot(in Quaternion a, in Quaternion b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z + a.W * b.W;

    /// <summary>Cross product, right-handed.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Cross(in Vector3 a, in Vector3 b) =>
        new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    /// <summary>Velocity of a point of a rigid motion, v + w x r; exactly v where nothing turns.</summary>
    public static Vector3 VelocityAt(in Vector3 linear, in Vector3 angular, in Vector3 offset) =>
        angular == default ? linear : linear + Cross(angular, offset);

    /// <summary>Inner product with itself.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float LengthSquared(in Vector3 v) => Dot(v, v);

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Length(in Vector3 v) => MathF.Sqrt(Dot(v, v));

    /// <summary>Euclidean distance between two points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float Distance(in Vector3 a, in Vector3 b) => Length(a - b);

    /// <summary>Squared distance between two points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float DistanceSquared(in Vector3 a, in Vector3 b) => LengthSquared(a - b);

    /// <summary>Vector of length one in the same direction; zero where the squared length is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Normalize(in Vector3 v)
    {
        var length = Length(v);
        return v * (length == 0 ? 0 : 1 / length);
    }

    /// <summary>Smaller value of each component; that of <paramref name="b"/> where either is NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Min(in Vector3 a, in Vector3 b)
    {
        var wideA = a.AsVector128Unsafe();
        var wideB = b.AsVector128Unsafe();
        return Vector128.ConditionalSelect(Vector128.LessThan(wideA, wideB), wideA, wideB).AsVector3();
    }

    /// <summary>Larger value of each component; that of <paramref name="b"/> where either is NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Max(in Vector3 a, in Vector3 b)
    {
        var wideA = a.AsVector128Unsafe();
        var wideB = b.AsVector128Unsafe();
        return Vector128.ConditionalSelect(Vector128.GreaterThan(wideA, wideB), wideA, wideB).AsVector3();
    }

    /// <summary>Linear interpolation from <paramref name="a"/> (amount 0) to <paramref name="b"/> (amount 1).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Lerp(in Vector3 a, in Vector3 b, float amount) => a * (1 - amount) + b * amount;

    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Rotate(in Vector3 v, in Quaternion q)
    {
        var axis = new Vector3(q.X, q.Y, q.Z);
        var t = Cross(axis, v);
        t += t;
        return v + t * q.W + Cross(axis, t);
    }

    /// <summary>Rotates a vector by the reverse of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 RotateByInverse(in Vector3 v, in Quaternion q) => Rotate(v, Conjugate(q));

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quaternion Concatenate(in Quaternion a, in Quaternion b) => new(
        a.W * b.X + a.X * b.W + a.Z * b.Y - a.Y * b.Z,
        a.W * b.Y + a.Y * b.W + a.X * b.Z - a.Z * b.X,
        a.W * b.Z + a.Z * b.W + a.Y * b.X - a.X * b.Y,
        a.W * b.W - a.X * b.X - a.Y * b.Y - a.Z * b.Z);

    /// <summary>The reverse rotation of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quaternion Conjugate(in Quaternion q) => new(-q.X, -q.Y, -q.Z, q.W);

    /// <summary>Quaternion of length one; the identity where the squared length is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quaternion Normalize(in Quaternion q)
    {
        var length = MathF.Sqrt(Dot(q, q));
        if (length == 0)
            return Quaternion.Identity;
        var scale = 1 / length;
        return new(q.X * scale, q.Y * scale, q.Z * scale, q.W * scale);
    }
}
