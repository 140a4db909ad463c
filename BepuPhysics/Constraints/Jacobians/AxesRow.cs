using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row about the angle between an axis a of A and an axis b of B.</summary>
// J = [ 0, n^T, 0, -n^T ]   over (vA, wA, vB, wB), with n = a x b / |a x b|: what the angle loses
// Axes that are parallel, either way, have no n of their own: it is a direction at right angles to a, by definition.
struct AxesRow : IJacobian<AxesRow, TwoBodies, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Orientation | BodyAccess.Angular | BodyAccess.InverseInertia;

    /// <inheritdoc/>
    public static bool IsLinear(int row) => false;

    // Radians. Rounding of two unit vectors of floats turns them by a fifth of this.
    const float ParallelSine = 1e-6f;

    /// <summary>Axis of A crossed with axis of B, made a unit vector.</summary>
    public Vector3Wide Axis;
    /// <summary>Sine of the angle between the axes; not negative.</summary>
    public Vector<float> Sine;
    /// <summary>Cosine of the angle between the axes.</summary>
    public Vector<float> Cosine;

    /// <summary>The row for two axes in the bodies' frames.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Prepare(in TwoBodies bodies, in Vector3Wide localAxisA, in Vector3Wide localAxisB, out AxesRow row)
    {
        var axisA = bodies.A.Orientation * localAxisA;
        var axisB = bodies.B.Orientation * localAxisB;
        var cross = Vector3Wide.Cross(axisA, axisB);
        row.Sine = cross.Length();
        row.Cosine = Vector3Wide.Dot(axisA, axisB);
        row.Axis = cross * (Vector<float>.One / row.Sine);
        var isParallel = Vector.LessThan(row.Sine, new Vector<float>(ParallelSine));
        if (!Vector.EqualsAll(isParallel, Vector<int>.Zero))
        {
            Vector3Wide.BuildOrthonormalBasis(axisA, out var perpendicular, out _);
            row.Axis = Vector3Wide.Select(isParallel, perpendicular, row.Axis);
        }
    }

    /// <summary>What the angle between the axes lacks to a quarter turn, radians; negative where it is more.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> LackOfQuarterTurn(in AxesRow row)
    {
        // Most are near a quarter turn: there the cosine says it, and nothing waits for the root and a division.
        var square = row.Cosine * row.Cosine;
        var lack = row.Cosine * Wide.AsinOverSine(square);
        var isFar = Vector.GreaterThan(square, new Vector<float>(Wide.AsinOverSineLimit));
        return Vector.EqualsAll(isFar, Vector<int>.Zero) ?
            lack : Wide.Select(isFar, Wide.CopySign(Wide.AtanOfQuarter(Vector.Abs(row.Cosine), row.Sine), row.Cosine), lack);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AxesRow row, in TwoBodies bodies, out Rows1 velocity) =>
        velocity.X = AngularRow.RelativeVelocity(row.Axis, bodies);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in AxesRow row, ref TwoBodies bodies, in Rows1 impulse) =>
        AngularRow.ApplyImpulse(row.Axis, ref bodies, impulse.X);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in AxesRow row, in TwoBodies bodies, out Rows1 inverseMass) =>
        inverseMass.X = AngularRow.InverseEffectiveMass(row.Axis, bodies);
}
