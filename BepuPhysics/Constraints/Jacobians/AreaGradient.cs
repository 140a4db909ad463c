using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A row along what twice the area between the centres of three bodies gains.</summary>
// 2 area = |b x c|   with b and c the way from A to the others,  n = b x c / |b x c|
// J = [ -(gB + gC), 0, gB, 0, gC, 0 ]   over (vA, wA, ...), with gB = c x n, gC = n x b
// K = the sum of g g / m
// Bodies in a line have no n: it is a direction at right angles to the longer of b and c by definition, so that they can be pushed apart.
struct AreaGradient : IJacobian<AreaGradient, ThreeBodies, Rows1, Rows1>
{
    /// <inheritdoc/>
    public static BodyAccess Access => BodyAccess.Position | BodyAccess.Linear | BodyAccess.InverseMass;

    // Squares of areas lose digits below this: what floats can hold, no size of a thing.
    const float LeastAreaSquared = 1e-30f;

    /// <summary>Derivatives by the position of B and C; that by A is what is missing to zero.</summary>
    public Vector3Wide B, C;
    /// <summary>Twice the area.</summary>
    public Vector<float> Area;

    readonly Vector3Wide A
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => -(B + C);
    }

    /// <summary>The row for the bodies' positions.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Prepare(in ThreeBodies bodies, out AreaGradient row)
    {
        var b = bodies.B.Position - bodies.A.Position;
        var c = bodies.C.Position - bodies.A.Position;
        var cross = Vector3Wide.Cross(b, c);
        var areaSquared = cross.LengthSquared();
        row.Area = Vector.SquareRoot(areaSquared);
        var normal = cross * (Vector<float>.One / row.Area);
        var isPlane = Vector.GreaterThan(areaSquared, new Vector<float>(LeastAreaSquared));
        if (!Vector.EqualsAll(isPlane, new Vector<int>(-1)))
        {
            var longer = Vector3Wide.Normalize(Vector3Wide.Select(Vector.GreaterThan(b.LengthSquared(), c.LengthSquared()), b, c));
            Vector3Wide.BuildOrthonormalBasis(longer, out var perpendicular, out _);
            normal = Vector3Wide.Select(isPlane, normal, perpendicular);
        }
        row.B = Vector3Wide.Cross(c, normal);
        row.C = Vector3Wide.Cross(normal, b);
    }

    /// <summary>An error that asks for no longer ways than the triangle is large.</summary>
    // Bodies that have fallen together have a large error and next to no gradient: their ratio is how far they would be sent in one go. g is a length of
    // the triangle as it is, the square root of the target one of what it is to be.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> Bound(Vector<float> error, in AreaGradient row, Vector<float> target)
    {
        var gradientSquared = row.A.LengthSquared() + row.B.LengthSquared() + row.C.LengthSquared();
        // Most are far from the bound, which is no less than g g but for rounding.
        if (Vector.LessThanAll(Vector.Abs(error), gradientSquared * new Vector<float>(0.99f)))
            return error;
        var gradient = Vector.SquareRoot(gradientSquared);
        var greatest = gradient * (gradient + Vector.SquareRoot(target));
        return Wide.Clamp(error, -greatest, greatest);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RelativeVelocity(in AreaGradient row, in ThreeBodies bodies, out Rows1 velocity) => velocity.X =
        Vector3Wide.Dot(bodies.B.Linear - bodies.A.Linear, row.B) + Vector3Wide.Dot(bodies.C.Linear - bodies.A.Linear, row.C);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ApplyImpulse(in AreaGradient row, ref ThreeBodies bodies, in Rows1 impulse)
    {
        bodies.A.Linear += row.A * (impulse.X * bodies.A.InverseMass);
        bodies.B.Linear += row.B * (impulse.X * bodies.B.InverseMass);
        bodies.C.Linear += row.C * (impulse.X * bodies.C.InverseMass);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InverseEffectiveMass(in AreaGradient row, in ThreeBodies bodies, out Rows1 inverseMass) => inverseMass.X =
        row.A.LengthSquared() * bodies.A.InverseMass + row.B.LengthSquared() * bodies.B.InverseMass + row.C.LengthSquared() * bodies.C.InverseMass;
}
