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
// The angular velocity is scaled along, w' = I'^-1 I w, since it is the momentum that the step owns.
static class GeometricStiffness
{
    /// <summary>Adds the stiffness of one force at the end of one arm.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Add(in Vector3Wide force, in Vector3Wide arm, ref Symmetric3x3Wide stiffness)
    {
        var tension = Wide.Max(Vector3Wide.Dot(force, arm), Vector<float>.Zero);
        // An arm of zero length has no tension either, so nothing is added.
        var perLength = Wide.DivideOrZero(tension, arm.LengthSquared());
        stiffness.XX += tension - perLength * arm.X * arm.X;
        stiffness.YX -= perLength * arm.Y * arm.X;
        stiffness.YY += tension - perLength * arm.Y * arm.Y;
        stiffness.ZX -= perLength * arm.Z * arm.X;
        stiffness.ZY -= perLength * arm.Z * arm.Y;
        stiffness.ZZ += tension - perLength * arm.Z * arm.Z;
    }

    /// <summary>Replaces the inverse inertia and the angular velocity in lanes whose swing the substep cannot resolve.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void Apply(in Symmetric3x3Wide stiffness, Vector<float> dt, ref Symmetric3x3Wide inverseInertia, ref Vector3Wide angular)
    {
        var squared = Contract(stiffness, stiffness);
        var loaded = Vector.GreaterThan(squared, Vector<float>.Zero);
        if (Vector.EqualsAll(loaded, Vector<int>.Zero))
            return;
        var inertia = Symmetric3x3Wide.Invert(inverseInertia);
        var resolved = Wide.DivideOrZero(Contract(inertia, stiffness), squared);
        var added = dt * dt - resolved;
        // A locked axis has a zero inverse inertia, whose inverse says nothing: such bodies stay as they are.
        var turns = Vector.GreaterThan(Contract(inertia, inertia), Vector<float>.Zero);
        var unresolved = loaded & turns & Vector.GreaterThan(added, Vector<float>.Zero);
        if (Vector.EqualsAll(unresolved, Vector<int>.Zero))
            return;
        var stiffened = Symmetric3x3Wide.Invert(inertia + stiffness * added);
        angular = Vector3Wide.Select(unresolved, stiffened * (inertia * angular), angular);
        inverseInertia = Symmetric3x3Wide.Select(unresolved, stiffened, inverseInertia);
    }

    // A : B, the sum of products of all nine entries.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Contract(in Symmetric3x3Wide a, in Symmetric3x3Wide b)
    {
        var offDiagonal = a.YX * b.YX + a.ZX * b.ZX + a.ZY * b.ZY;
        return a.XX * b.XX + a.YY * b.YY + a.ZZ * b.ZZ + offDiagonal + offDiagonal;
    }
}
