using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Three linear rows and an angular one.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct Rows4(in Vector3Wide linear, Vector<float> angular) : IRows<Rows4>
{
    /// <summary>The linear rows.</summary>
    public Vector3Wide Linear = linear;
    /// <summary>The angular row.</summary>
    public Vector<float> Angular = angular;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 operator +(in Rows4 a, in Rows4 b) => new(a.Linear + b.Linear, a.Angular + b.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 operator -(in Rows4 a, in Rows4 b) => new(a.Linear - b.Linear, a.Angular - b.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 operator *(in Rows4 a, Vector<float> scale) => new(a.Linear * scale, a.Angular * scale);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Rows4 a) => Vector.SquareRoot(a.Linear.LengthSquared() + a.Angular * a.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 ClampToPositive(in Rows4 a) => new(Rows3.ClampToPositive(new(a.Linear)).V, Wide.Max(a.Angular, Vector<float>.Zero));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 Min(in Rows4 a, in Rows4 b) => new(Rows3.Min(new(a.Linear), new(b.Linear)).V, Wide.Min(a.Angular, b.Angular));
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 Select(Vector<int> mask, in Rows4 a, in Rows4 b) => new(
        Vector3Wide.Select(mask, a.Linear, b.Linear), Wide.Select(mask, a.Angular, b.Angular));
}

/// <summary>A symmetric 4 x 4 matrix over <see cref="Rows4"/>: [Linear, Coupling; Coupling^T, Angular].</summary>
public struct RowMatrix4 : IRowMatrix<RowMatrix4, Rows4>
{
    /// <summary>Linear rows by linear rows.</summary>
    public Symmetric3x3Wide Linear;
    /// <summary>Linear rows by the angular row.</summary>
    public Vector3Wide Coupling;
    /// <summary>The angular row by itself.</summary>
    public Vector<float> Angular;

    /// <inheritdoc/>
    // By the Schur complement of the angular row: (L - c c^T / a) x = u - c v / a, then y = (v - c x) / a.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows4 Solve(in RowMatrix4 matrix, in Rows4 rightSide)
    {
        // Zero where nothing can turn: then the coupling is zero as well.
        var inverse = Wide.DivideOrZero(Vector<float>.One, matrix.Angular);
        var c = matrix.Coupling;
        var reduced = c * inverse;
        var complement = matrix.Linear - new Symmetric3x3Wide(
            reduced.X * c.X,
            reduced.Y * c.X, reduced.Y * c.Y,
            reduced.Z * c.X, reduced.Z * c.Y, reduced.Z * c.Z);
        var x = new RowFactor3(complement, RowFactor3.Trace(matrix.Linear)).Solve(rightSide.Linear - reduced * rightSide.Angular);
        return new(x, (rightSide.Angular - Vector3Wide.Dot(c, x)) * inverse);
    }
}
