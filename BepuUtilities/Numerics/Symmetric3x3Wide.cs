using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of symmetric 3x3 matrices, by their lower triangles.</summary>
public partial struct Symmetric3x3Wide : IWide<Symmetric3x3>
{
    /// <summary>Row X, column X.</summary>
    public Vector<float> XX;
    /// <summary>Row Y, column X.</summary>
    public Vector<float> YX;
    /// <summary>Row Y, column Y.</summary>
    public Vector<float> YY;
    /// <summary>Row Z, column X.</summary>
    public Vector<float> ZX;
    /// <summary>Row Z, column Y.</summary>
    public Vector<float> ZY;
    /// <summary>Row Z, column Z.</summary>
    public Vector<float> ZZ;

    /// <summary>Builds from the lower triangle, row by row.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Symmetric3x3Wide(Vector<float> xx, Vector<float> yx, Vector<float> yy, Vector<float> zx, Vector<float> zy, Vector<float> zz)
    {
        XX = xx;
        YX = yx;
        YY = yy;
        ZX = zx;
        ZY = zy;
        ZZ = zz;
    }

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(in Symmetric3x3Wide m, in Vector3Wide v) => new(
        m.XX * v.X + m.YX * v.Y + m.ZX * v.Z,
        m.YX * v.X + m.YY * v.Y + m.ZY * v.Z,
        m.ZX * v.X + m.ZY * v.Y + m.ZZ * v.Z);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide operator +(in Symmetric3x3Wide a, in Symmetric3x3Wide b) =>
        new(a.XX + b.XX, a.YX + b.YX, a.YY + b.YY, a.ZX + b.ZX, a.ZY + b.ZY, a.ZZ + b.ZZ);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide operator -(in Symmetric3x3Wide a, in Symmetric3x3Wide b) =>
        new(a.XX - b.XX, a.YX - b.YX, a.YY - b.YY, a.ZX - b.ZX, a.ZY - b.ZY, a.ZZ - b.ZZ);

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide operator *(in Symmetric3x3Wide m, Vector<float> scale) =>
        new(m.XX * scale, m.YX * scale, m.YY * scale, m.ZX * scale, m.ZY * scale, m.ZZ * scale);

    /// <summary>Skew(v) * m * transpose(Skew(v)): how an inertia acts at the end of an arm v.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide SkewSandwich(in Vector3Wide v, in Symmetric3x3Wide m)
    {
        // t = Skew(v) * m; its XX is not needed.
        var tXY = v.Y * m.ZY - v.Z * m.YY;
        var tXZ = v.Y * m.ZZ - v.Z * m.ZY;
        var tYX = v.Z * m.XX - v.X * m.ZX;
        var tYY = v.Z * m.YX - v.X * m.ZY;
        var tYZ = v.Z * m.ZX - v.X * m.ZZ;
        var tZX = v.X * m.YX - v.Y * m.XX;
        var tZY = v.X * m.YY - v.Y * m.YX;
        var tZZ = v.X * m.ZY - v.Y * m.ZX;
        return new(
            v.Y * tXZ - v.Z * tXY,
            v.Y * tYZ - v.Z * tYY, v.Z * tYX - v.X * tYZ,
            v.Y * tZZ - v.Z * tZY, v.Z * tZX - v.X * tZZ, v.X * tZY - v.Y * tZX);
    }

    /// <summary>transpose(v) * m * v.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> VectorSandwich(in Vector3Wide v, in Symmetric3x3Wide m) => Vector3Wide.Dot(v, m * v);

    /// <summary>transpose(r) * m * r: with the rotated axes in the rows of r, a local tensor in world axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide RotationSandwich(in Matrix3x3Wide r, in Symmetric3x3Wide m)
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
    public static Symmetric3x3Wide RotateInverseInertia(in Symmetric3x3Wide local, in QuaternionWide orientation) =>
        RotationSandwich(Matrix3x3Wide.FromQuaternion(orientation), local);

    /// <summary>Adds a scalar to the diagonal.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide AddDiagonal(in Symmetric3x3Wide m, Vector<float> value) =>
        new(m.XX + value, m.YX, m.YY + value, m.ZX, m.ZY, m.ZZ + value);

    /// <summary>
    /// Inverse of a positive semidefinite matrix of any magnitude; zero where the determinant is zero, so that a constraint between
    /// bodies of infinite mass yields no impulse instead of NaN.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide Invert(in Symmetric3x3Wide matrix) => InvertWithDeterminant(matrix, out _);

    /// <summary>As <see cref="Invert(in Symmetric3x3Wide)"/>; also says how near to singular the matrix is.</summary>
    /// <param name="matrix">Matrix to invert.</param>
    /// <param name="determinant">Determinant of the matrix times the power of two with which its trace is from 1 to 2: at most 8/27.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide InvertWithDeterminant(in Symmetric3x3Wide matrix, out Vector<float> determinant)
    {
        var power = Wide.NormalizingPowerOfTwo(matrix.XX + matrix.YY + matrix.ZZ);
        var m = matrix * power;

        // The columns of the adjugate are the cross products of the rows.
        var column = Vector3Wide.Cross(new(m.YX, m.YY, m.ZY), new(m.ZX, m.ZY, m.ZZ));
        determinant = Vector3Wide.Dot(new(m.XX, m.YX, m.ZX), column);
        var scale = Wide.DivideOrZero(power, determinant);
        return new(
            column.X * scale,
            column.Y * scale, (m.XX * m.ZZ - m.ZX * m.ZX) * scale,
            column.Z * scale, (m.YX * m.ZX - m.XX * m.ZY) * scale, (m.XX * m.YY - m.YX * m.YX) * scale);
    }

    /// <summary>Picks <paramref name="a"/> where the mask is set, <paramref name="b"/> elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide Select(Vector<int> mask, in Symmetric3x3Wide a, in Symmetric3x3Wide b) => new(
        Wide.Select(mask, a.XX, b.XX),
        Wide.Select(mask, a.YX, b.YX), Wide.Select(mask, a.YY, b.YY),
        Wide.Select(mask, a.ZX, b.ZX), Wide.Select(mask, a.ZY, b.ZY), Wide.Select(mask, a.ZZ, b.ZZ));
}
