using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row along what six times the volume between the centres of four bodies gains.</summary>
// 6 V = (b x c) d   with b, c, d the way from A to the others
// J = [ -(gB + gC + gD), 0, gB, 0, gC, 0, gD, 0 ]   over (vA, wA, ...), with gB = c x d, gC = d x b, gD = b x c
// K = the sum of g g / m
struct VolumeGradient : IJacobian<VolumeGradient, FourBodies, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Position | BodyAccess.Linear | BodyAccess.InverseMass;

    /// <summary>Derivatives by the position of B, C and D; that by A is what is missing to zero.</summary>
    public Vector3Wide B, C, D;
    /// <summary>Six times the volume.</summary>
    public Vector<float> Volume;

    readonly Vector3Wide A
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => -(B + C + D);
    }

    /// <summary>The row for the bodies' positions.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Prepare(in FourBodies bodies, out VolumeGradient row)
    {
        var b = bodies.B.Position - bodies.A.Position;
        var c = bodies.C.Position - bodies.A.Position;
        var d = bodies.D.Position - bodies.A.Position;
        row.B = Vector3Wide.Cross(c, d);
        row.C = Vector3Wide.Cross(d, b);
        row.D = Vector3Wide.Cross(b, c);
        row.Volume = Vector3Wide.Dot(row.D, d);
    }

    /// <summary>An error that asks for no longer ways than the tetrahedron is large.</summary>
    // Bodies that have fallen together have a large error and next to no gradient: their ratio is how far they would be sent in one go. g^(1/2) is a
    // length of the tetrahedron as it is, the cube root of the target one of what it is to be.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> Bound(Vector<float> error, in VolumeGradient row, Vector<float> target)
    {
        var gradient = Vector.SquareRoot(row.A.LengthSquared() + row.B.LengthSquared() + row.C.LengthSquared() + row.D.LengthSquared());
        var greatest = gradient * (Vector.SquareRoot(gradient) + RoughCubeRoot(Vector.Abs(target)));
        return Wide.Clamp(error, -greatest, greatest);
    }

    // A third of the exponent, and of the mantissa as if it were its logarithm: within 6 %. Integers hold what is converted: all processors do it alike.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> RoughCubeRoot(Vector<float> value) => Vector.AsVectorSingle(
        Vector.ConvertToInt32Native(Vector.ConvertToSingle(Vector.AsVectorInt32(value)) * new Vector<float>(1 / 3f)) + new Vector<int>(0x2A514067));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in VolumeGradient row, in FourBodies bodies, out Rows1 velocity) => velocity.X =
        Vector3Wide.Dot(bodies.B.Linear - bodies.A.Linear, row.B) + Vector3Wide.Dot(bodies.C.Linear - bodies.A.Linear, row.C) +
        Vector3Wide.Dot(bodies.D.Linear - bodies.A.Linear, row.D);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in VolumeGradient row, ref FourBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += row.A * (impulse.X * bodies.A.InverseMass);
        bodies.B.Linear += row.B * (impulse.X * bodies.B.InverseMass);
        bodies.C.Linear += row.C * (impulse.X * bodies.C.InverseMass);
        bodies.D.Linear += row.D * (impulse.X * bodies.D.InverseMass);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in VolumeGradient row, in FourBodies bodies, out Rows1 inverseMass) => inverseMass.X =
        row.A.LengthSquared() * bodies.A.InverseMass + row.B.LengthSquared() * bodies.B.InverseMass +
        row.C.LengthSquared() * bodies.C.InverseMass + row.D.LengthSquared() * bodies.D.InverseMass;
}
