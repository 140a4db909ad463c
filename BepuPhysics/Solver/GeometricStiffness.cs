using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How the load of point joints stiffens the rotation of the bodies that hang in them.</summary>
// A body that is pulled by a force f at the end of an arm r swings about the pulling direction like a pendulum: the torque r x f changes
// by -G dq under a rotation dq, with G = (f.r) (1 - r r^T / r.r) where the force pulls outward. Its frequency is w^2 = G / I. A light body
// under a heavy load swings so fast that w h passes 2, where no explicit step of length h is stable, however its joints are solved.
//
// Where a substep cannot resolve that motion, it is taken implicitly: inertia I' = I + h^2 (1 - rho) G for the solves of the substep, with
// rho = (I : G) / (h^2 G : G), about (w h)^-2, so that nothing changes where rho >= 1: a motion that the substep resolves is left alone.
//
// The angular velocity is scaled along, since it is the momentum that the step owns: w' = (J + h^2 (1 - rho) G)^-1 J w. A body that hangs turns about its joint
// and takes its own mass along, so J is I + m r^2 with the longest of the arms. With I in its place a small body on a long arm, which turns with what it hangs
// in, lost nearly all of its turn in each substep, and had it back from its joint about axes that G has from the beginning of the step: one that is whirled
// about gained a hundred times its energy.
static class GeometricStiffness
{
    // Part of rho = 1 below which the load of one joint is resolved by far, and is not worth a visit to its bodies.
    const float ResolvedPart = 0.1f;

    /// <summary>How many times the stiffness of their loads joints that are solved at once are given.</summary>
    // Corrections are all that adds energy there, and they are as large as a load of the substep before lets light links swing: its stiffness may have grown
    // fourfold since. Below a fourth of an unresolved swing nothing changes. At 2 one chain of 1,000 explodes on its way from the sweeps, at 4 and 8 none.
    internal const float DirectMargin = 4;

    /// <summary>f.r where the force pulls outward so hard that the substep might not resolve the swing; zero elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> Tension(in Vector3Wide force, in Vector3Wide arm, in Symmetric3x3Wide inverseInertia, in Substep substep)
    {
        var tension = Vector3Wide.Dot(force, arm);
        // The trace is at least the greatest inverse moment, so this is at least h^2 w^2.
        var trace = inverseInertia.XX + inverseInertia.YY + inverseInertia.ZZ;
        var limit = new Vector<float>(ResolvedPart * substep.InverseDt * substep.InverseDt);
        return Wide.Mask(Vector.GreaterThan(tension * trace, limit), tension);
    }

    /// <summary>Change of angular velocity by an impulse across its arm up to which the same impulse along the arm has no <see cref="Tension"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static float LeastTurn(in Substep substep) => ResolvedPart * substep.InverseDt;

    /// <summary>Stiffness of a tension at the end of an arm.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Symmetric3x3Wide Of(Vector<float> tension, in Vector3Wide arm)
    {
        // An arm of zero length has no tension either.
        var perLength = Wide.DivideOrZero(tension, arm.LengthSquared());
        return new(
            tension - perLength * arm.X * arm.X,
            -(perLength * arm.Y * arm.X), tension - perLength * arm.Y * arm.Y,
            -(perLength * arm.Z * arm.X), -(perLength * arm.Z * arm.Y), tension - perLength * arm.Z * arm.Z);
    }

    /// <summary>Replaces the inverse inertia and the angular velocity in lanes whose swing the substep cannot resolve.</summary>
    /// <param name="stiffness">Sum of what the loads stiffen rotation by, N m, world axes.</param>
    /// <param name="inertiaOnArm">Inertia of the mass of the body at the end of its longest arm, kg m2; zero of one that only turns.</param>
    /// <param name="dt">Length of the substep, s.</param>
    /// <param name="inverseInertia">Inverse inertia of the bodies, world axes.</param>
    /// <param name="angular">Their angular velocity.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void Apply(
        in Symmetric3x3Wide stiffness, Vector<float> inertiaOnArm, Vector<float> dt, ref Symmetric3x3Wide inverseInertia, ref Vector3Wide angular)
    {
        var squared = Contract(stiffness, stiffness);
        // A load without bounds stiffens nothing: its bodies are about to be stopped.
        var loaded = Vector.GreaterThan(squared, Vector<float>.Zero) & Vector.LessThan(squared, new Vector<float>(float.PositiveInfinity));
        if (Vector.EqualsAll(loaded, Vector<int>.Zero))
            return;
        // The inertia up to a factor: the adjugate of its inverse, taken to a trace of one. Times the trace and over the determinant it would be the inertia
        // itself; all that is asked for can do without the division.
        var trace = inverseInertia.XX + inverseInertia.YY + inverseInertia.ZZ;
        var adjugate = Adjugate(inverseInertia * Wide.DivideOrZero(Vector<float>.One, trace), out var determinant);
        var perInertia = determinant * trace;
        var added = dt * dt * perInertia - Wide.DivideOrZero(Contract(adjugate, stiffness), squared);
        // A locked axis has a zero inverse inertia, whose inverse says nothing: such bodies stay as they are.
        var turns = Vector.GreaterThan(determinant, Vector<float>.Zero);
        var unresolved = loaded & turns & Vector.GreaterThan(added, Vector<float>.Zero);
        if (Vector.EqualsAll(unresolved, Vector<int>.Zero))
            return;
        var scaled = stiffness * added;
        var stiffened = Symmetric3x3Wide.Invert(adjugate + scaled);
        var onArm = Symmetric3x3Wide.AddDiagonal(adjugate, inertiaOnArm * perInertia);
        angular = Vector3Wide.Select(unresolved, Symmetric3x3Wide.Invert(onArm + scaled) * (onArm * angular), angular);
        inverseInertia = Symmetric3x3Wide.Select(unresolved, stiffened * perInertia, inverseInertia);
    }

    // The inverse times the determinant.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Symmetric3x3Wide Adjugate(in Symmetric3x3Wide m, out Vector<float> determinant)
    {
        var column = Vector3Wide.Cross(new(m.YX, m.YY, m.ZY), new(m.ZX, m.ZY, m.ZZ));
        determinant = Vector3Wide.Dot(new(m.XX, m.YX, m.ZX), column);
        return new(
            column.X,
            column.Y, m.XX * m.ZZ - m.ZX * m.ZX,
            column.Z, m.YX * m.ZX - m.XX * m.ZY, m.XX * m.YY - m.YX * m.YX);
    }

    // A : B, the sum of products of all nine entries.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Contract(in Symmetric3x3Wide a, in Symmetric3x3Wide b)
    {
        var offDiagonal = a.YX * b.YX + a.ZX * b.ZX + a.ZY * b.ZY;
        return a.XX * b.XX + a.YY * b.YY + a.ZZ * b.ZZ + offDiagonal + offDiagonal;
    }
}
