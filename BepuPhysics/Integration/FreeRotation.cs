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

    // What is less is nothing: at this speed, rad/s, a body turns by a degree in fifty years, and an orientation that is off by this is off by less than it
    // can say. The product of this speed and of the square of this component is still a normal float: processors take ten times as long for others, and
    // what lies still would be slower than what moves.
    const float LeastSpeed = 1e-11f;
    const float LeastComponent = 1e-13f;

    // Half of the angle, rad, by which the momentum turns within the body in a substep: a degree takes ten hours at 240 Hz.
    const float LeastPrecession = 1e-9f;

    /// <summary>Turns by the angular velocity, which stays as it is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static QuaternionWide Turn(in QuaternionWide orientation, in Vector3Wide angular, Vector<float> dt) =>
        Tidy(QuaternionWide.Concatenate(orientation, FromRotationVector<AnyAngles>(WithoutDust(angular, LeastSpeed) * dt)));

    /// <summary>Quaternion of a rotation vector; the identity for zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static QuaternionWide FromRotationVector<TAngles>(in Vector3Wide rotation) where TAngles : struct, IAngles
    {
        var half = rotation * new Vector<float>(0.5f);
        var square = half.LengthSquared();
        Wide.SinOverAngle(square, out var sin, out var cos);
        var v = half * sin;
        QuaternionWide turn = new(v.X, v.Y, v.Z, cos);
        if (TAngles.AreSmall)
            return turn;
        var isSmall = Vector.LessThan(square, new Vector<float>(Wide.SinOverAngleLimit));
        if (Vector.EqualsAll(isSmall, Vector<int>.AllBitsSet))
            return turn;
        // A copy, so that what all others go on with need not have an address.
        var copy = rotation;
        return QuaternionWide.Select(isSmall, turn, FromLargeRotation(copy));
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static QuaternionWide FromLargeRotation(in Vector3Wide rotation)
    {
        var angle = rotation.Length();
        Wide.SinCos(angle * new Vector<float>(0.5f), out var sin, out var cos);
        var v = rotation * (sin / angle);
        return new(v.X, v.Y, v.Z, cos);
    }

    // Of unit length again, after a product of two that were so to rounding: 1 / sqrt(1 + e) is 1 - e / 2.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static QuaternionWide Tidy(in QuaternionWide q)
    {
        var scale = new Vector<float>(1.5f) - q.LengthSquared() * new Vector<float>(0.5f);
        QuaternionWide unit;
        unit.X = WithoutDust(q.X * scale, LeastComponent);
        unit.Y = WithoutDust(q.Y * scale, LeastComponent);
        unit.Z = WithoutDust(q.Z * scale, LeastComponent);
        unit.W = WithoutDust(q.W * scale, LeastComponent);
        return unit;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide WithoutDust(in Vector3Wide v, float least)
    {
        Vector3Wide clean;
        clean.X = WithoutDust(v.X, least);
        clean.Y = WithoutDust(v.Y, least);
        clean.Z = WithoutDust(v.Z, least);
        return clean;
    }

    // NaN stays.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> WithoutDust(Vector<float> x, float least) =>
        Vector.AndNot(x, Vector.AsVectorSingle(Vector.LessThan(Vector.Abs(x), new Vector<float>(least))));

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
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static unsafe void Tumble(in Symmetric3x3Wide inverseInertia, PrincipalFrame* frames, Vector<int> indices, Vector<float> dt,
        ref QuaternionWide orientation, ref Vector3Wide angular)
    {
        if (!TryTumble<SmallAngles>(inverseInertia, frames, indices, dt, ref orientation, ref angular))
            TryTumble<AnyAngles>(inverseInertia, frames, indices, dt, ref orientation, ref angular);
    }

    // Nearly all bundles have small angles only: that kernel calls nothing, so what it works with stays in registers. A lane gets the same bits from either.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe bool TryTumble<TAngles>(in Symmetric3x3Wide inverseInertia, PrincipalFrame* frames, Vector<int> indices, Vector<float> dt,
        ref QuaternionWide orientation, ref Vector3Wide angular) where TAngles : struct, IAngles
    {
        var own = WithoutDust(angular, LeastSpeed);
        var tumbles = CanTumble(inverseInertia) & ~Vector.Equals(own.LengthSquared(), Vector<float>.Zero);
        if (Vector.EqualsAll(tumbles, Vector<int>.Zero))
        {
            TurnAll(dt, angular, ref orientation);
            return true;
        }
        var isTilted = PrincipalAxes.AreTilted(inverseInertia, tumbles);
        var tilts = !Vector.EqualsAll(isTilted, Vector<int>.Zero);
        QuaternionWide toBody = default;
        Vector3Wide principal = new(inverseInertia.XX, inverseInertia.YY, inverseInertia.ZZ);
        var frame = orientation;
        if (tilts)
        {
            // Copies: a local whose address is taken is in memory all the time.
            FindPrincipal(inverseInertia, isTilted, frames, indices, orientation, out var found, out var foundPrincipal, out var foundFrame);
            toBody = found;
            principal = foundPrincipal;
            frame = foundFrame;
        }
        var axes = Matrix3x3Wide.FromQuaternion(frame);
        var local = axes * own;

        // Principal axes in cyclic order with the middle one last: a cyclic change of names keeps the frame right-handed.
        var middleX = IsBetween(principal.X, principal.Y, principal.Z);
        var middleY = Vector.AndNot(IsBetween(principal.Y, principal.Z, principal.X), middleX);
        principal = Cycle(principal, middleX, middleY);
        local = Cycle(local, middleX, middleY);

        // Lanes that do not tumble compute with unit inertia, so that nothing is divided by zero in them. All moments are in units of the middle one.
        var one = Vector<float>.One;
        var inverseW = Vector.ConditionalSelect(tumbles, principal.Z, one);
        var inverseU = Vector.ConditionalSelect(tumbles, principal.X, one) / inverseW;
        var inverseV = Vector.ConditionalSelect(tumbles, principal.Y, one) / inverseW;
        var rateU = (inverseU - one) * dt;
        var rateV = (inverseV - one) * dt;
        Vector3Wide momentum = new(local.X / inverseU, local.Y / inverseV, local.Z);
        // With unit inertia nothing turns within the body, and the momentum is the angular velocity: those lanes turn as by it alone.
        var rotation = Vector3Wide.Select(tumbles, Matrix3x3Wide.TransposeTimes(axes, Cycle(momentum, middleY, middleX)), own) * dt;
        var momentumSquared = momentum.LengthSquared();
        var angleSquared = momentumSquared * Vector.Abs(rateU * rateV);
        if (TAngles.AreSmall && !AreSmall(rotation.LengthSquared(), momentumSquared * Wide.Max(rateU * rateU, rateV * rateV), angleSquared))
            return false;
        var about = FromRotationVector<TAngles>(rotation);

        Vector3Wide change;
        QuaternionWide spin;
        if (TAngles.AreSmall)
            Rotate(rateU, rateV, momentum, out change, out spin);
        else
            RotateInSteps(rateU, rateV, CountInnerSteps(Vector.SquareRoot(angleSquared)), momentum, out change, out spin);

        // What changes is added to what there is: to take the velocity itself to another frame and back would cost it a rounding in each step, always the same
        // one, and a thousandth in a minute.
        Vector3Wide localChange = new(change.X * inverseU, change.Y * inverseV, change.Z);
        localChange += QuaternionWide.Displacement(spin, local + localChange);
        var changed = about * (own + Matrix3x3Wide.TransposeTimes(axes, Cycle(localChange, middleY, middleX)));
        angular = Vector3Wide.Select(tumbles, changed, angular);
        var turn = Cycle(new Vector3Wide(spin.X, spin.Y, spin.Z), middleY, middleX);
        spin.X = turn.X;
        spin.Y = turn.Y;
        spin.Z = turn.Z;
        frame = Tidy(QuaternionWide.Concatenate(QuaternionWide.Concatenate(spin, frame), about));
        orientation = frame;
        if (tilts)
        {
            var copy = toBody;
            LeavePrincipal(isTilted, copy, ref orientation);
        }
        return true;
    }

    // What few bundles do is not inlined: the kernel is as much as the inliner takes, and what is a call there would be one for all.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void TurnAll(Vector<float> dt, in Vector3Wide angular, ref QuaternionWide orientation) => orientation = Turn(orientation, angular, dt);

    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe void FindPrincipal(in Symmetric3x3Wide inverseInertia, Vector<int> isTilted, PrincipalFrame* frames, Vector<int> indices,
        in QuaternionWide orientation, out QuaternionWide toBody, out Vector3Wide principal, out QuaternionWide frame)
    {
        PrincipalAxes.Find(inverseInertia, isTilted, frames, indices, out toBody, out principal);
        frame = QuaternionWide.Select(isTilted, QuaternionWide.Concatenate(toBody, orientation), orientation);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void LeavePrincipal(Vector<int> isTilted, in QuaternionWide toBody, ref QuaternionWide frame) =>
        frame = QuaternionWide.Select(isTilted, Tidy(QuaternionWide.Concatenate(QuaternionWide.Conjugate(toBody), frame)), frame);

    /// <summary>What is known of the angles of a bundle.</summary>
    interface IAngles
    {
        /// <summary>Whether no half of any is above .75, and a single inner step will do; a JIT constant.</summary>
        static abstract bool AreSmall { get; }
    }

    readonly struct SmallAngles : IAngles
    {
        public static bool AreSmall => true;
    }

    readonly struct AnyAngles : IAngles
    {
        public static bool AreSmall => false;
    }

    // By the squares of the angle about the momentum, of the greatest one within the body that there can be, and of that by which inner steps are counted.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool AreSmall(Vector<float> about, Vector<float> within, Vector<float> inner)
    {
        // Half of an angle is what sines are taken of, and rounding may let the momentum grow.
        const float greatest = 4 * 0.9f * Wide.SinOverAngleLimit;
        var small = Vector.LessThan(Wide.Max(about, within), new Vector<float>(greatest)) &
            Vector.LessThanOrEqual(inner, new Vector<float>(AnglePerInnerStep * AnglePerInnerStep));
        return Vector.EqualsAll(small, Vector<int>.AllBitsSet);
    }

    // Turns the momentum within the body by u / 2, v, u / 2. Where no body of the bundle turns about v, as where all are symmetric about u, both halves are by
    // the same angle: to a lane it is the same as all of it.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Rotate(Vector<float> rateU, Vector<float> rateV, in Vector3Wide momentum, out Vector3Wide change, out QuaternionWide spin)
    {
        var zero = Vector<float>.Zero;
        var half = new Vector<float>(0.5f);
        change = Vector3Wide.Zero;
        RotateU<SmallAngles>(rateU * half, momentum, ref change, out var s, out var c);
        if (Vector.EqualsAll(rateV, zero))
        {
            Turn(s, c, momentum.Y + change.Y, momentum.Z + change.Z, ref change.Y, ref change.Z);
            spin = new(c * s + s * c, zero, zero, c * c - s * s);
            return;
        }
        spin = new(s, zero, zero, c);
        AppendV<SmallAngles>(rateV, momentum, ref change, ref spin);
        AppendU<SmallAngles>(rateU * half, momentum, ref change, ref spin);
    }

    // As often as there are inner steps. Half-steps in the middle join to whole ones.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void RotateInSteps(Vector<float> rateU, Vector<float> rateV, Vector<float> innerSteps, in Vector3Wide momentum, out Vector3Wide change,
        out QuaternionWide spin)
    {
        var half = new Vector<float>(0.5f);
        var one = Vector<float>.One;
        rateU /= innerSteps;
        rateV /= innerSteps;
        change = Vector3Wide.Zero;
        RotateU<AnyAngles>(rateU * half, momentum, ref change, out var s, out var c);
        spin = new(s, Vector<float>.Zero, Vector<float>.Zero, c);
        for (var i = one; Vector.LessThanAny(i, innerSteps); i += one)
        {
            var active = Vector.LessThan(i, innerSteps);
            var nextChange = change;
            var nextSpin = spin;
            AppendV<AnyAngles>(rateV, momentum, ref nextChange, ref nextSpin);
            AppendU<AnyAngles>(rateU, momentum, ref nextChange, ref nextSpin);
            change = Vector3Wide.Select(active, nextChange, change);
            spin = QuaternionWide.Select(active, nextSpin, spin);
        }
        AppendV<AnyAngles>(rateV, momentum, ref change, ref spin);
        AppendU<AnyAngles>(rateU * half, momentum, ref change, ref spin);
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

    // The body turns about its axis u by rate times L_u; L, fixed in the world, turns the other way in the body. Sine and cosine of half the angle.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void RotateU<TAngles>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, out Vector<float> s, out Vector<float> c)
        where TAngles : struct, IAngles
    {
        Halve<TAngles>(rate * (start.X + change.X), out s, out c);
        Turn(s, c, start.Y + change.Y, start.Z + change.Z, ref change.Y, ref change.Z);
    }

    // The product of quaternions, of which the first is a turn about one axis.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void AppendU<TAngles>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, ref QuaternionWide spin) where TAngles : struct, IAngles
    {
        RotateU<TAngles>(rate, start, ref change, out var s, out var c);
        spin = new(c * spin.X + s * spin.W, c * spin.Y + s * spin.Z, c * spin.Z - s * spin.Y, c * spin.W - s * spin.X);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void RotateV<TAngles>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, out Vector<float> s, out Vector<float> c)
        where TAngles : struct, IAngles
    {
        Halve<TAngles>(rate * (start.Y + change.Y), out s, out c);
        Turn(s, c, start.Z + change.Z, start.X + change.X, ref change.Z, ref change.X);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void AppendV<TAngles>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, ref QuaternionWide spin) where TAngles : struct, IAngles
    {
        RotateV<TAngles>(rate, start, ref change, out var s, out var c);
        spin = new(c * spin.X - s * spin.Z, c * spin.Y + s * spin.W, c * spin.Z + s * spin.X, c * spin.W - s * spin.Y);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Halve<TAngles>(Vector<float> angle, out Vector<float> sin, out Vector<float> cos) where TAngles : struct, IAngles
    {
        var half = WithoutDust(angle * new Vector<float>(0.5f), LeastPrecession);
        if (TAngles.AreSmall)
        {
            // What SinCos does with such angles.
            Wide.SinOverAngle(half * half, out sin, out cos);
            sin *= half;
        }
        else
        {
            Wide.SinCos(half, out sin, out cos);
        }
    }

    // Adds what a vector changes by when it turns: 1 - cos a is 2 sin^2 (a / 2), and loses nothing for small angles.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Turn(Vector<float> s, Vector<float> c, Vector<float> y, Vector<float> z, ref Vector<float> changeY, ref Vector<float> changeZ)
    {
        var twice = s + s;
        var sin = twice * c;
        var versine = twice * s;
        changeY += sin * z - versine * y;
        changeZ -= sin * y + versine * z;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsBetween(Vector<float> x, Vector<float> a, Vector<float> b) =>
        Vector.LessThanOrEqual((x - a) * (x - b), Vector<float>.Zero);

    // (y, z, x) in the first lanes, (z, x, y) in the second, unchanged elsewhere. With the masks exchanged it undoes itself.
    // By components: the inliner takes so much of a kernel, and no more.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Cycle(in Vector3Wide v, Vector<int> once, Vector<int> twice)
    {
        Vector3Wide cycled;
        cycled.X = Vector.ConditionalSelect(once, v.Y, Vector.ConditionalSelect(twice, v.Z, v.X));
        cycled.Y = Vector.ConditionalSelect(once, v.Z, Vector.ConditionalSelect(twice, v.X, v.Y));
        cycled.Z = Vector.ConditionalSelect(once, v.X, Vector.ConditionalSelect(twice, v.Y, v.Z));
        return cycled;
    }
}
