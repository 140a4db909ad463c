using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>One number per row of a constraint: a velocity, an error or an impulse, for a bundle of constraints.</summary>
public interface IRows<TRows> where TRows : unmanaged, IRows<TRows>
{
    /// <summary>Sum.</summary>
    static abstract TRows operator +(in TRows a, in TRows b);
    /// <summary>Difference.</summary>
    static abstract TRows operator -(in TRows a, in TRows b);
    /// <summary>Product with one factor per lane.</summary>
    static abstract TRows operator *(in TRows a, Vector<float> scale);
    /// <summary>Euclidean length over the rows.</summary>
    static abstract Vector<float> Length(in TRows a);
    /// <summary>Row by row, the larger of the value and zero.</summary>
    static abstract TRows ClampToPositive(in TRows a);
    /// <summary>Row by row, the smaller of two values.</summary>
    static abstract TRows Min(in TRows a, in TRows b);
    /// <summary>The first in lanes where the mask is set, the second elsewhere.</summary>
    static abstract TRows Select(Vector<int> mask, in TRows a, in TRows b);
}

/// <summary>A symmetric matrix over the rows of a constraint: the inverse of its effective mass, K = J M^-1 J^T.</summary>
public interface IRowMatrix<TMatrix, TRows> where TMatrix : unmanaged where TRows : unmanaged
{
    /// <summary>K^-1 times a vector; zero where K is zero, as between two bodies that nothing moves.</summary>
    static abstract TRows Solve(in TMatrix matrix, in TRows rightSide);
}

/// <summary>One row; also the 1 x 1 matrix over it.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct Rows1(Vector<float> x) : IRows<Rows1>, IRowMatrix<Rows1, Rows1>
{
    /// <summary>The row.</summary>
    public Vector<float> X = x;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 operator +(in Rows1 a, in Rows1 b) => new(a.X + b.X);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 operator -(in Rows1 a, in Rows1 b) => new(a.X - b.X);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 operator *(in Rows1 a, Vector<float> scale) => new(a.X * scale);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Rows1 a) => Vector.Abs(a.X);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 ClampToPositive(in Rows1 a) => new(Wide.Max(a.X, Vector<float>.Zero));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 Min(in Rows1 a, in Rows1 b) => new(Wide.Min(a.X, b.X));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 Select(Vector<int> mask, in Rows1 a, in Rows1 b) => new(Wide.Select(mask, a.X, b.X));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows1 Solve(in Rows1 matrix, in Rows1 rightSide) =>
        new(Vector.ConditionalSelect(Vector.GreaterThan(matrix.X, Vector<float>.Zero), rightSide.X / matrix.X, Vector<float>.Zero));
}

/// <summary>Three rows.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct Rows3(in Vector3Wide v) : IRows<Rows3>
{
    /// <summary>The rows.</summary>
    public Vector3Wide V = v;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 operator +(in Rows3 a, in Rows3 b) => new(a.V + b.V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 operator -(in Rows3 a, in Rows3 b) => new(a.V - b.V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 operator *(in Rows3 a, Vector<float> scale) => new(a.V * scale);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Rows3 a) => a.V.Length();
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 ClampToPositive(in Rows3 a) =>
        new(new(Wide.Max(a.V.X, Vector<float>.Zero), Wide.Max(a.V.Y, Vector<float>.Zero), Wide.Max(a.V.Z, Vector<float>.Zero)));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 Min(in Rows3 a, in Rows3 b) =>
        new(new(Wide.Min(a.V.X, b.V.X), Wide.Min(a.V.Y, b.V.Y), Wide.Min(a.V.Z, b.V.Z)));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 Select(Vector<int> mask, in Rows3 a, in Rows3 b) => new(Vector3Wide.Select(mask, a.V, b.V));
}

/// <summary>A symmetric 3 x 3 matrix over three rows.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct RowMatrix3(in Symmetric3x3Wide m) : IRowMatrix<RowMatrix3, Rows3>
{
    /// <summary>The matrix.</summary>
    public Symmetric3x3Wide M = m;

    // Below, the determinant of a matrix of trace 1 to 2 is made of rounding, and the inverse of noise: the arm of a joint is hundreds of times the
    // radius of its body, or nothing but rotations can move the point.
    const float LeastDeterminant = 1f / (1 << 20);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows3 Solve(in RowMatrix3 matrix, in Rows3 rightSide)
    {
        var solution = Symmetric3x3Wide.InvertWithDeterminant(matrix.M, out var determinant) * rightSide.V;
        var isSingular = Vector.LessThanOrEqual(determinant, new Vector<float>(LeastDeterminant));
        if (!Vector.EqualsAll(isSingular, Vector<int>.Zero))
        {
            // Copies: a local whose address is taken is in memory all the time.
            Symmetric3x3Wide singular = matrix.M;
            Vector3Wide right = rightSide.V, regular = solution;
            SolveSingular(singular, right, isSingular, ref regular);
            solution = regular;
        }
        return new(solution);
    }

    // Only the lanes that are so.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SolveSingular(in Symmetric3x3Wide matrix, in Vector3Wide rightSide, Vector<int> mask, ref Vector3Wide solution) =>
        solution = Vector3Wide.Select(mask, new RowFactor3(matrix, RowFactor3.Trace(matrix)).Solve(rightSide), solution);
}
