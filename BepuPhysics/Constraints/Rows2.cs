using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Two rows.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct Rows2(in Vector2Wide v) : IRows<Rows2>
{
    /// <summary>The rows.</summary>
    public Vector2Wide V = v;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 operator +(in Rows2 a, in Rows2 b) => new(a.V + b.V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 operator -(in Rows2 a, in Rows2 b) => new(a.V - b.V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 operator *(in Rows2 a, Vector<float> scale) => new(a.V * scale);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Rows2 a) => a.V.Length();
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 ClampToPositive(in Rows2 a) => new(new(Wide.Max(a.V.X, Vector<float>.Zero), Wide.Max(a.V.Y, Vector<float>.Zero)));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 Min(in Rows2 a, in Rows2 b) => new(new(Wide.Min(a.V.X, b.V.X), Wide.Min(a.V.Y, b.V.Y)));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 Select(Vector<int> mask, in Rows2 a, in Rows2 b) => new(Vector2Wide.Select(mask, a.V, b.V));
}

/// <summary>A symmetric 2 x 2 matrix over two rows.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct RowMatrix2(in Symmetric2x2Wide m) : IRowMatrix<RowMatrix2, Rows2>
{
    /// <summary>The matrix.</summary>
    public Symmetric2x2Wide M = m;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows2 Solve(in RowMatrix2 matrix, in Rows2 rightSide) => new(new RowFactor2(matrix.M).Solve(rightSide.V));
}
