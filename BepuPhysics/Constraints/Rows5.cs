using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Three linear rows and two angular ones.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct Rows5(in Vector3Wide linear, in Vector2Wide angular) : IRows<Rows5>
{
    /// <summary>The linear rows.</summary>
    public Vector3Wide Linear = linear;
    /// <summary>The angular rows.</summary>
    public Vector2Wide Angular = angular;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows5 operator +(in Rows5 a, in Rows5 b) => new(a.Linear + b.Linear, a.Angular + b.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows5 operator -(in Rows5 a, in Rows5 b) => new(a.Linear - b.Linear, a.Angular - b.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows5 operator *(in Rows5 a, Vector<float> scale) => new(a.Linear * scale, a.Angular * scale);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Rows5 a) => Vector.SquareRoot(a.Linear.LengthSquared() + a.Angular.LengthSquared());
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows5 ClampToPositive(in Rows5 a) => new(
        Rows3.ClampToPositive(new(a.Linear)).V, Rows2.ClampToPositive(new(a.Angular)).V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows5 Min(in Rows5 a, in Rows5 b) => new(
        Rows3.Min(new(a.Linear), new(b.Linear)).V, Rows2.Min(new(a.Angular), new(b.Angular)).V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows5 Select(Vector<int> mask, in Rows5 a, in Rows5 b) => new(
        Vector3Wide.Select(mask, a.Linear, b.Linear), Vector2Wide.Select(mask, a.Angular, b.Angular));
}

/// <summary>A symmetric 5 x 5 matrix over <see cref="Rows5"/>: [Linear, Coupling^T; Coupling, Angular].</summary>
public struct RowMatrix5 : IRowMatrix<RowMatrix5, Rows5>
{
    /// <summary>Linear rows by linear rows.</summary>
    public Symmetric3x3Wide Linear;
    /// <summary>Angular rows by linear rows.</summary>
    public Matrix2x3Wide Coupling;
    /// <summary>Angular rows by angular rows.</summary>
    public Symmetric2x2Wide Angular;

    /// <inheritdoc/>
    // By the Schur complement of the angular block: (L - C^T A^-1 C) x = u - C^T A^-1 v, then y = A^-1 v - A^-1 C x.
    // A JIT root of its own: with it, a joint's kernel has more locals than the JIT tracks, and the rest would live in memory.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Rows5 Solve(in RowMatrix5 matrix, in Rows5 rightSide)
    {
        var angular = new RowFactor2(matrix.Angular);
        // A^-1 C, column by column.
        var columnX = angular.Solve(new(matrix.Coupling.X.X, matrix.Coupling.Y.X));
        var columnY = angular.Solve(new(matrix.Coupling.X.Y, matrix.Coupling.Y.Y));
        var columnZ = angular.Solve(new(matrix.Coupling.X.Z, matrix.Coupling.Y.Z));
        var reduced = new Matrix2x3Wide(new(columnX.X, columnY.X, columnZ.X), new(columnX.Y, columnY.Y, columnZ.Y));
        var complement = matrix.Linear - Matrix2x3Wide.TransposeTimesSymmetric(reduced, matrix.Coupling);
        var x = new RowFactor3(complement, RowFactor3.Trace(matrix.Linear)).Solve(
            rightSide.Linear - Matrix2x3Wide.TransposeTimes(reduced, rightSide.Angular));
        return new(x, angular.Solve(rightSide.Angular) - reduced * x);
    }
}
