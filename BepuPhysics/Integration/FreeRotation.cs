using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Turns a bundle of bodies for one substep, in each of the angular integration modes.</summary>
// The gyroscopic mode. Split the kinetic energy of a free rigid body around its middle moment of inertia I_m:
//
//   H = L.L / (2 I_m)  +  (1/I_u - 1/I_m) L_u^2 / 2  +  (1/I_v - 1/I_m) L_v^2 / 2,      u, v: the two other principal axes.
//
// The first term alone turns the body about L, which stays as it is, and commutes with the others. The second and third turn the body
// about its own axes u and v. All three are exact rotations, so Strang's composition u/2, v, u/2 of the last two, n times, and the first
// once, is explicit, reversible, keeps |L|, keeps the energy without drift, and is exact for symmetric bodies, for which one of the
// differences is zero. Splitting around another axis loses the balance between the two differences: a thin rod fails by a factor of 600.
// (McLachlan, Explicit Lie-Poisson integration and the Euler equations, Physical Review Letters 71, 1993, for the splitting itself.)
static class FreeRotation
{
    /// <summary>Greatest angle, rad, by which an inner step turns L within the body, about; and the greatest number of inner steps.</summary>
    const float AnglePerInnerStep = 0.25f;
    const int MaximumInnerSteps = 32;

    /// <summary>Turns by the angular velocity, which stays as it is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static QuaternionWide Turn(in QuaternionWide orientation, in Vector3Wide angular, Vector<float> dt) =>
        QuaternionWide.Normalize(QuaternionWide.Concatenate(orientation, FromRotationVector(angular * dt)));

    /// <summary>Quaternion of a rotation vector; the identity for zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static QuaternionWide FromRotationVector(in Vector3Wide rotation)
    {
        var angle = rotation.Length();
        Wide.SinCos(angle * new Vector<float>(0.5f), out var sin, out var cos);
        // sin(a / 2) / a tends to 1/2; the angle is exactly zero before the division could lose anything.
        var v = rotation * Vector.ConditionalSelect(Vector.GreaterThan(angle, Vector<float>.Zero), sin / angle, new Vector<float>(0.5f));
        return new(v.X, v.Y, v.Z, cos);
    }

    /// <summary>Turns by the angular velocity, then sets the angular velocity that has the same momentum in the new orientation.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void TurnKeepingMomentum(
        in Symmetric3x3Wide inverseInertia, Vector<float> dt, ref QuaternionWide orientation, ref Vector3Wide angular)
    {
        var turned = Turn(orientation, angular, dt);
        var free = CanTumble(inverseInertia);
        var momentum = orientation * (Symmetric3x3Wide.Invert(inverseInertia) * (QuaternionWide.Conjugate(orientation) * angular));
        var kept = turned * (inverseInertia * (QuaternionWide.Conjugate(turned) * momentum));
        angular = Vector3Wide.Select(free, kept, angular);
        orientation = turned;
    }

    /// <summary>Turns a free body, with its angular momentum and its energy kept.</summary>
    /// <param name="inverseInertia">In the bodies' frames.</param>
    /// <param name="frames">Principal frames of all bodies, as far as they are known; null where there is no room for them.</param>
    /// <param name="indices">Indices of the bodies.</param>
    /// <param name="dt">Time, s.</param>
    /// <param name="orientation">Orientation.</param>
    /// <param name="angular">Angular velocity.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static unsafe void Tumble(in Symmetric3x3Wide inverseInertia, PrincipalFrame* frames, Vector<int> indices, Vector<float> dt,
        ref QuaternionWide orientation, ref Vector3Wide angular)
    {
        var turned = Turn(orientation, angular, dt);
        var tumbles = CanTumble(inverseInertia);
        if (Vector.EqualsAll(tumbles, Vector<int>.Zero))
        {
            orientation = turned;
            return;
        }
        PrincipalAxes.Find(inverseInertia, tumbles, frames, indices, out var toBody, out var principal);
        var frame = QuaternionWide.Concatenate(toBody, orientation);
        var local = QuaternionWide.Conjugate(frame) * angular;

        // Principal axes in cyclic order with the middle one last: a cyclic change of names keeps the frame right-handed.
        var middleX = IsBetween(principal.X, principal.Y, principal.Z);
        var middleY = Vector.AndNot(IsBetween(principal.Y, principal.Z, principal.X), middleX);
        principal = Cycle(principal, middleX, middleY);
        local = Cycle(local, middleX, middleY);

        // Lanes that do not tumble compute with unit inertia, so that nothing is divided by zero in them.
        var one = Vector<float>.One;
        principal = Vector3Wide.Select(tumbles, principal, new(one, one, one));
        Vector3Wide momentum = new(local.X / principal.X, local.Y / principal.Y, local.Z / principal.Z);
        var speed = angular.Length();
        // Rounding in a change of frame must not change the length of what it turns: over a minute it would add up.
        momentum *= Ratio(speed, local.Length());
        var momentumInWorld = frame * Cycle(momentum, middleY, middleX);
        var length = momentum.Length();
        momentumInWorld *= Ratio(length, momentumInWorld.Length());

        var rateU = principal.X - principal.Z;
        var rateV = principal.Y - principal.Z;
        var innerSteps = CountInnerSteps(length * Vector.SquareRoot(Vector.Abs(rateU * rateV)) * dt);
        var innerDt = dt / innerSteps;
        var spin = QuaternionWide.Identity;
        // Half-steps of u at both ends of each inner step: those in the middle join to whole ones.
        var half = new Vector<float>(0.5f);
        RotateU(rateU * innerDt * half, ref momentum, ref spin);
        var count = innerSteps;
        for (var i = one; Vector.LessThanAny(i, innerSteps); i += one)
        {
            var active = Vector.LessThan(i, count);
            var nextMomentum = momentum;
            var nextSpin = spin;
            RotateV(rateV * innerDt, ref nextMomentum, ref nextSpin);
            RotateU(rateU * innerDt, ref nextMomentum, ref nextSpin);
            momentum = Vector3Wide.Select(active, nextMomentum, momentum);
            spin = QuaternionWide.Select(active, nextSpin, spin);
        }
        RotateV(rateV * innerDt, ref momentum, ref spin);
        RotateU(rateU * innerDt * half, ref momentum, ref spin);
        momentum *= Ratio(length, momentum.Length());

        var inPrincipal = Cycle(new Vector3Wide(spin.X, spin.Y, spin.Z), middleY, middleX);
        spin = new(inPrincipal.X, inPrincipal.Y, inPrincipal.Z, spin.W);
        var about = FromRotationVector(momentumInWorld * (principal.Z * dt));
        frame = QuaternionWide.Normalize(QuaternionWide.Concatenate(QuaternionWide.Concatenate(spin, frame), about));

        Vector3Wide velocity = new(momentum.X * principal.X, momentum.Y * principal.Y, momentum.Z * principal.Z);
        var inWorld = frame * Cycle(velocity, middleY, middleX);
        inWorld *= Ratio(velocity.Length(), inWorld.Length());
        angular = Vector3Wide.Select(tumbles, inWorld, angular);
        var result = QuaternionWide.Normalize(QuaternionWide.Concatenate(QuaternionWide.Conjugate(toBody), frame));
        orientation = QuaternionWide.Select(tumbles, result, turned);
    }

    // Nothing to conserve for bodies that turn the same way about every axis, or that cannot turn about some.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> CanTumble(in Symmetric3x3Wide m)
    {
        var zero = Vector<float>.Zero;
        var diagonal = Vector.Equals(m.YX, zero) & Vector.Equals(m.ZX, zero) & Vector.Equals(m.ZY, zero);
        var isotropic = diagonal & Vector.Equals(m.XX, m.YY) & Vector.Equals(m.YY, m.ZZ);
        var turns = Vector.GreaterThan(m.XX, zero) & Vector.GreaterThan(m.YY, zero) & Vector.GreaterThan(m.ZZ, zero);
        return Vector.AndNot(turns, isotropic);
    }

    // Number of inner steps as a float: a whole number from 1 to the maximum.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> CountInnerSteps(Vector<float> angle)
    {
        var wanted = Wide.Min(angle * new Vector<float>(1 / AnglePerInnerStep), new Vector<float>(MaximumInnerSteps));
        var whole = Vector.ConvertToSingle(Vector.ConvertToInt32(wanted));
        var up = Vector.ConditionalSelect(Vector.LessThan(whole, wanted), whole + Vector<float>.One, whole);
        return Wide.Max(up, Vector<float>.One);
    }

    // The body turns about its axis u by rate times L_u; L, fixed in the world, turns the other way in the body.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void RotateU(Vector<float> rate, ref Vector3Wide l, ref QuaternionWide spin)
    {
        Wide.SinCos(rate * l.X * new Vector<float>(0.5f), out var s, out var c);
        Double(s, c, out var sin, out var cos);
        (l.Y, l.Z) = (cos * l.Y + sin * l.Z, cos * l.Z - sin * l.Y);
        spin = QuaternionWide.Concatenate(new(s, Vector<float>.Zero, Vector<float>.Zero, c), spin);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void RotateV(Vector<float> rate, ref Vector3Wide l, ref QuaternionWide spin)
    {
        Wide.SinCos(rate * l.Y * new Vector<float>(0.5f), out var s, out var c);
        Double(s, c, out var sin, out var cos);
        (l.Z, l.X) = (cos * l.Z + sin * l.X, cos * l.X - sin * l.Z);
        spin = QuaternionWide.Concatenate(new(Vector<float>.Zero, s, Vector<float>.Zero, c), spin);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Double(Vector<float> s, Vector<float> c, out Vector<float> sin, out Vector<float> cos)
    {
        sin = (s + s) * c;
        cos = Vector<float>.One - (s + s) * s;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsBetween(Vector<float> x, Vector<float> a, Vector<float> b) =>
        Vector.LessThanOrEqual((x - a) * (x - b), Vector<float>.Zero);

    // (y, z, x) in the first lanes, (z, x, y) in the second, unchanged elsewhere. With the masks exchanged it undoes itself.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Cycle(in Vector3Wide v, Vector<int> once, Vector<int> twice) => Vector3Wide.Select(
        once, new(v.Y, v.Z, v.X), Vector3Wide.Select(twice, new(v.Z, v.X, v.Y), v));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Ratio(Vector<float> wanted, Vector<float> actual) =>
        Vector.ConditionalSelect(Vector.GreaterThan(actual, Vector<float>.Zero), wanted / actual, Vector<float>.One);
}
