using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of matrices of two rows and three columns: the Jacobian of two constraint rows.</summary>
public partial struct Matrix2x3Wide
{
    /// <summary>First row.</summary>
    public Vector3Wide X;
    /// <summary>Second row.</summary>
    public Vector3Wide Y;

    /// <summary>Builds from rows.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Matrix2x3Wide(in Vector3Wide x, in Vector3Wide y)
    {
        X = x;
        Y = y;
    }

    /// <summary>Transforms a column vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator *(in Matrix2x3Wide m, in Vector3Wide v) => new(Vector3Wide.Dot(m.X, v), Vector3Wide.Dot(m.Y, v));

    /// <summary>Transforms a column vector by the transpose: constraint impulses to impulses on a body.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide TransposeTimes(in Matrix2x3Wide m, in Vector2Wide v) => m.X * v.X + m.Y * v.Y;

    /// <summary>Product with a symmetric matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x3Wide operator *(in Matrix2x3Wide m, in Symmetric3x3Wide s) => new(s * m.X, s * m.Y);

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x3Wide operator *(in Matrix2x3Wide m, Vector<float> scale) => new(m.X * scale, m.Y * scale);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x3Wide operator +(in Matrix2x3Wide a, in Matrix2x3Wide b) => new(a.X + b.X, a.Y + b.Y);

    /// <summary>a * transpose(b), when that product is known to be symmetric.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide TimesTranspose(in Matrix2x3Wide a, in Matrix2x3Wide b) =>
        new(Vector3Wide.Dot(a.X, b.X), Vector3Wide.Dot(a.Y, b.X), Vector3Wide.Dot(a.Y, b.Y));

    /// <summary>transpose(a) * b, when that product is known to be symmetric.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide TransposeTimesSymmetric(in Matrix2x3Wide a, in Matrix2x3Wide b) => new(
        a.X.X * b.X.X + a.Y.X * b.Y.X,
        a.X.Y * b.X.X + a.Y.Y * b.Y.X, a.X.Y * b.X.Y + a.Y.Y * b.Y.Y,
        a.X.Z * b.X.X + a.Y.Z * b.Y.X, a.X.Z * b.X.Y + a.Y.Z * b.Y.Y, a.X.Z * b.X.Z + a.Y.Z * b.Y.Z);

    /// <summary>m * s * transpose(m): the inverse effective mass of two rows.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide Sandwich(in Matrix2x3Wide m, in Symmetric3x3Wide s) => TimesTranspose(m * s, m);
}
