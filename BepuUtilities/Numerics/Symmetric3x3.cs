using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A symmetric 3x3 matrix, by its lower triangle; inertia tensors and their inverses.</summary>
public partial struct Symmetric3x3
{
    /// <summary>Row X, column X.</summary>
    public float XX;
    /// <summary>Row Y, column X.</summary>
    public float YX;
    /// <summary>Row Y, column Y.</summary>
    public float YY;
    /// <summary>Row Z, column X.</summary>
    public float ZX;
    /// <summary>Row Z, column Y.</summary>
    public float ZY;
    /// <summary>Row Z, column Z.</summary>
    public float ZZ;

    /// <summary>Builds from the lower triangle, row by row.</summary>
    public Symmetric3x3(float xx, float yx, float yy, float zx, float zy, float zz)
    {
        XX = xx;
        YX = yx;
        YY = yy;
        ZX = zx;
        ZY = zy;
        ZZ = zz;
    }

    /// <summary>Diagonal matrix.</summary>
    public static Symmetric3x3 Diagonal(float xx, float yy, float zz) => new(xx, 0, yy, 0, 0, zz);

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 operator *(in Symmetric3x3 m, in Vector3 v) => new(
        m.XX * v.X + m.YX * v.Y + m.ZX * v.Z,
        m.YX * v.X + m.YY * v.Y + m.ZY * v.Z,
        m.ZX * v.X + m.ZY * v.Y + m.ZZ * v.Z);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3 operator +(in Symmetric3x3 a, in Symmetric3x3 b) =>
        new(a.XX + b.XX, a.YX + b.YX, a.YY + b.YY, a.ZX + b.ZX, a.ZY + b.ZY, a.ZZ + b.ZZ);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3 operator -(in Symmetric3x3 a, in Symmetric3x3 b) =>
        new(a.XX - b.XX, a.YX - b.YX, a.YY - b.YY, a.ZX - b.ZX, a.ZY - b.ZY, a.ZZ - b.ZZ);

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3 operator *(in Symmetric3x3 m, float scale) =>
        new(m.XX * scale, m.YX * scale, m.YY * scale, m.ZX * scale, m.ZY * scale, m.ZZ * scale);

    /// <summary>Determinant.</summary>
    public static float Determinant(in Symmetric3x3 m) =>
        Exact.Dot(new Vector3(m.XX, m.YX, m.ZX), Exact.Cross(new(m.YX, m.YY, m.ZY), new(m.ZX, m.ZY, m.ZZ)));

    /// <summary>transpose(r) * m * r: with the rotated axes in the rows of r, a local tensor in world axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3 RotationSandwich(in Matrix3x3 r, in Symmetric3x3 m)
    {
        // t = m * r, by rows.
        var tX = r.X * m.XX + r.Y * m.YX + r.Z * m.ZX;
        var tY = r.X * m.YX + r.Y * m.YY + r.Z * m.ZY;
        var tZ = r.X * m.ZX + r.Y * m.ZY + r.Z * m.ZZ;
        return new(
            r.X.X * tX.X + r.Y.X * tY.X + r.Z.X * tZ.X,
            r.X.Y * tX.X + r.Y.Y * tY.X + r.Z.Y * tZ.X,
            r.X.Y * tX.Y + r.Y.Y * tY.Y + r.Z.Y * tZ.Y,
            r.X.Z * tX.X + r.Y.Z * tY.X + r.Z.Z * tZ.X,
            r.X.Z * tX.Y + r.Y.Z * tY.Y + r.Z.Z * tZ.Y,
            r.X.Z * tX.Z + r.Y.Z * tY.Z + r.Z.Z * tZ.Z);
    }

    /// <summary>A tensor given in local axes, in world axes: R * local * transpose(R).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3 RotateInverseInertia(in Symmetric3x3 local, in Quaternion orientation) =>
        RotationSandwich(Matrix3x3.FromQuaternion(orientation), local);

    /// <summary>Inverse of a positive semidefinite matrix of any magnitude; zero where the determinant is zero.</summary>
    public static Symmetric3x3 Invert(in Symmetric3x3 matrix)
    {
        // As the wide form: scaled by a power of two first, so that the determinant neither overflows nor underflows.
        const int exponentMask = 0xFF << 23;
        var trace = BitConverter.SingleToInt32Bits(matrix.XX + matrix.YY + matrix.ZZ);
        var power = BitConverter.Int32BitsToSingle((254 << 23) - (trace & exponentMask));
        var m = matrix * power;
        var column = Exact.Cross(new(m.YX, m.YY, m.ZY), new(m.ZX, m.ZY, m.ZZ));
        var determinant = Exact.Dot(new Vector3(m.XX, m.YX, m.ZX), column);
        if (determinant == 0)
            return default;
        var scale = power / determinant;
        return new(
            column.X * scale,
            column.Y * scale, (m.XX * m.ZZ - m.ZX * m.ZX) * scale,
            column.Z * scale, (m.YX * m.ZX - m.XX * m.ZY) * scale, (m.XX * m.YY - m.YX * m.YX) * scale);
    }
}
