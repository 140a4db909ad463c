using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Solves symmetric positive semidefinite systems larger than 3x3 by blocks, so that no larger matrix type is needed.</summary>
/// <remarks>
/// The system [A B; transpose(B) D] [x; y] = [u; v] is reduced to x by the Schur complement of D:
/// (A - B D^-1 transpose(B)) x = u - B D^-1 v, then y = D^-1 v - D^-1 transpose(B) x.
/// A block that is zero (infinite mass) yields a zero solution for its rows, as inversion does.
/// </remarks>
public static class Blocks
{
    /// <summary>Six rows: A, B and D are 3x3.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Solve(
        in Symmetric3x3Wide a, in Matrix3x3Wide b, in Symmetric3x3Wide d, in Vector3Wide u, in Vector3Wide v, out Vector3Wide x, out Vector3Wide y)
    {
        var inverseD = Symmetric3x3Wide.Invert(d);
        var w = b * inverseD;
        x = Symmetric3x3Wide.Invert(a - Matrix3x3Wide.TimesTranspose(w, b)) * (u - w * v);
        y = inverseD * v - Matrix3x3Wide.TransposeTimes(w, x);
    }

    /// <summary>Five rows: A is 3x3, D is 2x2, B is given by its transpose.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Solve(
        in Symmetric3x3Wide a, in Matrix2x3Wide transposeB, in Symmetric2x2Wide d, in Vector3Wide u, in Vector2Wide v, out Vector3Wide x, out Vector2Wide y)
    {
        var inverseD = Symmetric2x2Wide.Invert(d);
        var transposeW = inverseD * transposeB;
        var complement = a - Matrix2x3Wide.TransposeTimesSymmetric(transposeW, transposeB);
        x = Symmetric3x3Wide.Invert(complement) * (u - Matrix2x3Wide.TransposeTimes(transposeW, v));
        y = inverseD * v - transposeW * x;
    }

    /// <summary>Four rows: A is 3x3, B is a column, D is a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Solve(
        in Symmetric3x3Wide a, in Vector3Wide b, Vector<float> d, in Vector3Wide u, Vector<float> v, out Vector3Wide x, out Vector<float> y)
    {
        var inverseD = Wide.DivideOrZero(Vector<float>.One, d);
        var w = b * inverseD;
        var complement = new Symmetric3x3Wide(
            a.XX - w.X * b.X,
            a.YX - w.Y * b.X, a.YY - w.Y * b.Y,
            a.ZX - w.Z * b.X, a.ZY - w.Z * b.Y, a.ZZ - w.Z * b.Z);
        x = Symmetric3x3Wide.Invert(complement) * (u - w * v);
        y = inverseD * v - Vector3Wide.Dot(w, x);
    }
}
