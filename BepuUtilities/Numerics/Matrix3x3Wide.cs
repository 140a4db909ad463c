using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of 3x3 matrices, by rows.</summary>
/// <remarks>
/// Rotations are stored as in <see cref="FromQuaternion"/>: the rows are the rotated axes. <see cref="TransposeTimes"/> then rotates
/// from local to world, the product with a column vector from world to local.
/// </remarks>
public partial struct Matrix3x3Wide : IWide<Matrix3x3>
{
    /// <summary>First row.</summary>
    public Vector3Wide X;
    /// <summary>Second row.</summary>
    public Vector3Wide Y;
    /// <summary>Third row.</summary>
    public Vector3Wide Z;

    /// <summary>Builds from rows.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Matrix3x3Wide(in Vector3Wide x, in Vector3Wide y, in Vector3Wide z)
    {
        X = x;
        Y = y;
        Z = z;
    }

    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes (row X is the rotated unit X, ...).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide FromQuaternion(in QuaternionWide q)
    {
        var x2 = q.X + q.X;
        var y2 = q.Y + q.Y;
        var z2 = q.Z + q.Z;
        var xx = q.X * x2;
        var xy = q.X * y2;
        var xz = q.X * z2;
        var yy = q.Y * y2;
        var yz = q.Y * z2;
        var zz = q.Z * z2;
        var wx = q.W * x2;
        var wy = q.W * y2;
        var wz = q.W * z2;
        var one = Vector<float>.One;
        return new(
            new(one - (yy + zz), xy + wz, xz - wy),
            new(xy - wz, one - (xx + zz), yz + wx),
            new(xz + wy, yz - wx, one - (xx + yy)));
    }

    /// <summary>The matrix of the cross product from the left: Skew(v) * u = v x u for a column u.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide Skew(in Vector3Wide v)
    {
        var zero = Vector<float>.Zero;
        return new(new(zero, -v.Z, v.Y), new(v.Z, zero, -v.X), new(-v.Y, v.X, zero));
    }

    /// <summary>Skew(v) * m for a symmetric m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide Skew(in Vector3Wide v, in Symmetric3x3Wide m) => new(
        new(v.Y * m.ZX - v.Z * m.YX, v.Y * m.ZY - v.Z * m.YY, v.Y * m.ZZ - v.Z * m.ZY),
        new(v.Z * m.XX - v.X * m.ZX, v.Z * m.YX - v.X * m.ZY, v.Z * m.ZX - v.X * m.ZZ),
        new(v.X * m.YX - v.Y * m.XX, v.X * m.YY - v.Y * m.YX, v.X * m.ZY - v.Y * m.ZX));

    /// <summary>Transforms a column vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(in Matrix3x3Wide m, in Vector3Wide v) =>
        new(Vector3Wide.Dot(m.X, v), Vector3Wide.Dot(m.Y, v), Vector3Wide.Dot(m.Z, v));

    /// <summary>Transforms a column vector by the transpose, that is, a row vector by the matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide TransposeTimes(in Matrix3x3Wide m, in Vector3Wide v) => m.X * v.X + m.Y * v.Y + m.Z * v.Z;

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide operator +(in Matrix3x3Wide a, in Matrix3x3Wide b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide operator -(in Matrix3x3Wide a, in Matrix3x3Wide b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    /// <summary>Opposite.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide operator -(in Matrix3x3Wide m) => new(-m.X, -m.Y, -m.Z);

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide operator *(in Matrix3x3Wide m, Vector<float> scale) => new(m.X * scale, m.Y * scale, m.Z * scale);

    /// <summary>Matrix product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide operator *(in Matrix3x3Wide a, in Matrix3x3Wide b) =>
        new(TransposeTimes(b, a.X), TransposeTimes(b, a.Y), TransposeTimes(b, a.Z));

    /// <summary>Product with a symmetric matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide operator *(in Matrix3x3Wide m, in Symmetric3x3Wide s) => new(s * m.X, s * m.Y, s * m.Z);

    /// <summary>Product of a and the transpose of b.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide MultiplyByTranspose(in Matrix3x3Wide a, in Matrix3x3Wide b) => new(b * a.X, b * a.Y, b * a.Z);

    /// <summary>a * transpose(b), when that product is known to be symmetric.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide TimesTranspose(in Matrix3x3Wide a, in Matrix3x3Wide b) => new(
        Vector3Wide.Dot(a.X, b.X),
        Vector3Wide.Dot(a.Y, b.X), Vector3Wide.Dot(a.Y, b.Y),
        Vector3Wide.Dot(a.Z, b.X), Vector3Wide.Dot(a.Z, b.Y), Vector3Wide.Dot(a.Z, b.Z));

    /// <summary>Rows exchanged for columns.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide Transpose(in Matrix3x3Wide m) =>
        new(new(m.X.X, m.Y.X, m.Z.X), new(m.X.Y, m.Y.Y, m.Z.Y), new(m.X.Z, m.Y.Z, m.Z.Z));
}
