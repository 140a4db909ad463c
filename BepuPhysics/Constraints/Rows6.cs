using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Three linear rows and three angular ones.</summary>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
public struct Rows6(in Vector3Wide linear, in Vector3Wide angular) : IRows<Rows6>
{
    /// <summary>The linear rows.</summary>
    public Vector3Wide Linear = linear;
    /// <summary>The angular rows.</summary>
    public Vector3Wide Angular = angular;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows6 operator +(in Rows6 a, in Rows6 b) => new(a.Linear + b.Linear, a.Angular + b.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows6 operator -(in Rows6 a, in Rows6 b) => new(a.Linear - b.Linear, a.Angular - b.Angular);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows6 operator *(in Rows6 a, Vector<float> scale) => new(a.Linear * scale, a.Angular * scale);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Rows6 a) => Vector.SquareRoot(a.Linear.LengthSquared() + a.Angular.LengthSquared());
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows6 ClampToPositive(in Rows6 a) => new(
        Rows3.ClampToPositive(new(a.Linear)).V, Rows3.ClampToPositive(new(a.Angular)).V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows6 Min(in Rows6 a, in Rows6 b) => new(
        Rows3.Min(new(a.Linear), new(b.Linear)).V, Rows3.Min(new(a.Angular), new(b.Angular)).V);
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Rows6 Select(Vector<int> mask, in Rows6 a, in Rows6 b) => new(
        Vector3Wide.Select(mask, a.Linear, b.Linear), Vector3Wide.Select(mask, a.Angular, b.Angular));
}

/// <summary>A symmetric 6 x 6 matrix over <see cref="Rows6"/>: [Linear, Coupling; Coupling^T, Angular].</summary>
public struct RowMatrix6 : IRowMatrix<RowMatrix6, Rows6>
{
    /// <summary>Linear rows by linear rows.</summary>
    public Symmetric3x3Wide Linear;
    /// <summary>Linear rows by angular rows.</summary>
    public Matrix3x3Wide Coupling;
    /// <summary>Angular rows by angular rows.</summary>
    public Symmetric3x3Wide Angular;

    /// <inheritdoc/>
    // By the Schur complement of the angular block: (L - C A^-1 C^T) x = u - C A^-1 v, then y = A^-1 v - A^-1 C^T x.
    // A JIT root of its own: with it, a joint's kernel has more locals than the JIT tracks, and the rest would live in memory.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Rows6 Solve(in RowMatrix6 matrix, in Rows6 rightSide)
    {
        var angular = new RowFactor3(matrix.Angular, RowFactor3.Trace(matrix.Angular));
        // C A^-1, row by row: A is symmetric.
        var reduced = new Matrix3x3Wide(angular.Solve(matrix.Coupling.X), angular.Solve(matrix.Coupling.Y), angular.Solve(matrix.Coupling.Z));
        var complement = matrix.Linear - Matrix3x3Wide.TimesTranspose(reduced, matrix.Coupling);
        var x = new RowFactor3(complement, RowFactor3.Trace(matrix.Linear)).Solve(rightSide.Linear - reduced * rightSide.Angular);
        return new(x, angular.Solve(rightSide.Angular) - Matrix3x3Wide.TransposeTimes(reduced, x));
    }
}
