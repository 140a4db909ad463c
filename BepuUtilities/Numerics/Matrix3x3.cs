using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A 3x3 matrix, by rows. As a rotation its rows are the rotated axes: row vectors are multiplied from the left.</summary>
public partial struct Matrix3x3
{
    /// <summary>First row.</summary>
    public Vector3 X;
    /// <summary>Second row.</summary>
    public Vector3 Y;
    /// <summary>Third row.</summary>
    public Vector3 Z;

    /// <summary>Builds from rows.</summary>
    public Matrix3x3(in Vector3 x, in Vector3 y, in Vector3 z)
    {
        X = x;
        Y = y;
        Z = z;
    }

    /// <summary>No rotation, no scale.</summary>
    public static Matrix3x3 Identity => new(Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ);

    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes (row X is the rotated unit X, ...).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 FromQuaternion(in Quaternion q)
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
        return new(
            new(1 - (yy + zz), xy + wz, xz - wy),
            new(xy - wz, 1 - (xx + zz), yz + wx),
            new(xz + wy, yz - wx, 1 - (xx + yy)));
    }

    /// <summary>Transforms a column vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 operator *(in Matrix3x3 m, in Vector3 v) => new(Exact.Dot(m.X, v), Exact.Dot(m.Y, v), Exact.Dot(m.Z, v));

    /// <summary>Transforms a column vector by the transpose, that is, a row vector by the matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 TransposeTimes(in Matrix3x3 m, in Vector3 v) => m.X * v.X + m.Y * v.Y + m.Z * v.Z;

    /// <summary>Matrix product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 operator *(in Matrix3x3 a, in Matrix3x3 b) =>
        new(TransposeTimes(b, a.X), TransposeTimes(b, a.Y), TransposeTimes(b, a.Z));

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 operator *(in Matrix3x3 m, float scale) => new(m.X * scale, m.Y * scale, m.Z * scale);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 operator +(in Matrix3x3 a, in Matrix3x3 b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 operator -(in Matrix3x3 a, in Matrix3x3 b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    /// <summary>Rows exchanged for columns.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 Transpose(in Matrix3x3 m) =>
        new(new(m.X.X, m.Y.X, m.Z.X), new(m.X.Y, m.Y.Y, m.Z.Y), new(m.X.Z, m.Y.Z, m.Z.Z));

    /// <summary>Determinant.</summary>
    public static float Determinant(in Matrix3x3 m) => Exact.Dot(m.X, Exact.Cross(m.Y, m.Z));

    /// <summary>Inverse; zero where the determinant is zero.</summary>
    public static Matrix3x3 Invert(in Matrix3x3 m)
    {
        // The columns of the inverse are the cross products of the rows over the determinant.
        var x = Exact.Cross(m.Y, m.Z);
        var determinant = Exact.Dot(m.X, x);
        var scale = determinant == 0 ? 0 : 1 / determinant;
        return Transpose(new(x * scale, Exact.Cross(m.Z, m.X) * scale, Exact.Cross(m.X, m.Y) * scale));
    }
}
