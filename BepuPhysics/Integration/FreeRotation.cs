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
static partial class FreeRotation
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

    // Angles, rad, up to which sine and cosine are those of small angles, and one inner step is enough, whatever a sum in another order rounds to.
    const float GreatestSlowAngle = 1.4f;
    const float GreatestSingleAngle = AnglePerInnerStep * 0.99f;

    /// <summary>Turns by the angular velocity, which stays as it is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static QuaternionWide Turn(in QuaternionWide orientation, in Vector3Wide angular, Vector<float> dt) =>
        Tidy(QuaternionWide.Concatenate(orientation, FromRotationVector(WithoutDust(angular, LeastSpeed) * dt)));

    /// <summary>Quaternion of a rotation vector; the identity for zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static QuaternionWide FromRotationVector(in Vector3Wide rotation)
    {
        var half = rotation * new Vector<float>(0.5f);
        var square = half.LengthSquared();
        var isSmall = Vector.LessThan(square, new Vector<float>(Wide.SinOverAngleLimit));
        Wide.SinOverAngle(square, out var sin, out var cos);
        var v = half * sin;
        QuaternionWide turn = new(v.X, v.Y, v.Z, cos);
        if (Vector.EqualsAll(isSmall, Vector<int>.AllBitsSet))
            return turn;
        // A copy, so that what all others go on with need not have an address.
        var copy = rotation;
        return QuaternionWide.Select(isSmall, turn, FromLargeRotation(copy));
    }

    // Of rotations up to the greatest slow angle, with the same bits.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static QuaternionWide FromSmallRotation(in Vector3Wide rotation)
    {
        var half = rotation * new Vector<float>(0.5f);
        Wide.SinOverAngle(half.LengthSquared(), out var sin, out var cos);
        var v = half * sin;
        return new(v.X, v.Y, v.Z, cos);
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
        var unit = q * (new Vector<float>(1.5f) - q.LengthSquared() * new Vector<float>(0.5f));
        var axis = WithoutDust(new Vector3Wide(unit.X, unit.Y, unit.Z), LeastComponent);
        return new(axis.X, axis.Y, axis.Z, WithoutDust(unit.W, LeastComponent));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide WithoutDust(in Vector3Wide v, float least) => new(WithoutDust(v.X, least), WithoutDust(v.Y, least), WithoutDust(v.Z, least));

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
    // Nearly all bodies turn by little in a substep, and the inertia of most is diagonal in their own frame. For these nothing is called, since all that lives
    // across a call would be in memory, even where that call hardly ever comes. What is read is read part by part: a copy of a whole is made by wider
    // registers than it was written by, and waits for that.
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static unsafe void Tumble(in Symmetric3x3Wide inverseInertia, PrincipalFrame* frames, Vector<int> indices, Vector<float> dt,
        ref QuaternionWide orientation, ref Vector3Wide angular)
    {
        if (AreAllAboutY(inverseInertia))
        {
            TumbleAboutY(inverseInertia, frames, indices, dt, ref orientation, ref angular);
            return;
        }
        Vector3Wide own = new(angular.X, angular.Y, angular.Z);
        own = WithoutDust(own, LeastSpeed);
        QuaternionWide frame = new(orientation.X, orientation.Y, orientation.Z, orientation.W);
        var turning = own * dt;
        var slow = new Vector<float>(GreatestSlowAngle * GreatestSlowAngle);
        if (!Vector.LessThanAll(turning.LengthSquared(), slow) ||
            !Vector.EqualsAll(IsDiagonal(inverseInertia), Vector<int>.AllBitsSet))
        {
            TumbleAny(inverseInertia, frames, indices, dt, ref orientation, ref angular);
            return;
        }
        var tumbles = Tumbles(inverseInertia, own);
        if (Vector.EqualsAll(tumbles, Vector<int>.Zero))
        {
            orientation = Tidy(QuaternionWide.Concatenate(frame, FromSmallRotation(turning)));
            return;
        }
        var local = QuaternionWide.Conjugate(frame) * own;
        Split(new(inverseInertia.XX, inverseInertia.YY, inverseInertia.ZZ), tumbles, dt, ref local, out var order, out var inverse, out var rate,
            out var momentum);
        var worldTurn = (frame * order.FromCycle(momentum)) * dt;
        var square = momentum.LengthSquared();
        var isSlow = Vector.LessThan(Wide.Max(worldTurn.LengthSquared(), square * Wide.Max(rate.X * rate.X, rate.Y * rate.Y)), slow) &
            Vector.LessThan(square * Vector.Abs(rate.X * rate.Y), new Vector<float>(GreatestSingleAngle * GreatestSingleAngle));
        if (!Vector.EqualsAll(isSlow, Vector<int>.AllBitsSet))
        {
            TumbleAny(inverseInertia, frames, indices, dt, ref orientation, ref angular);
            return;
        }
        RotateSlowly(rate.X, rate.Y, momentum, out var change, out var spin);
        var turnedAngular = Join(order, inverse, FromSmallRotation(worldTurn), own, local, change, spin, ref frame);
        if (!Vector.EqualsAll(tumbles, Vector<int>.AllBitsSet))
        {
            QuaternionWide still = new(orientation.X, orientation.Y, orientation.Z, orientation.W);
            frame = QuaternionWide.Select(tumbles, frame, Tidy(QuaternionWide.Concatenate(still, FromSmallRotation(turning))));
            turnedAngular = Vector3Wide.Select(tumbles, turnedAngular, angular);
        }
        angular = turnedAngular;
        orientation = frame;
    }

    // As above, for any bodies and any speed.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe void TumbleAny(in Symmetric3x3Wide inverseInertia, PrincipalFrame* frames, Vector<int> indices, Vector<float> dt,
        ref QuaternionWide orientation, ref Vector3Wide angular)
    {
        var own = WithoutDust(angular, LeastSpeed);
        var tumbles = Tumbles(inverseInertia, own);
        var turned = orientation;
        if (!Vector.EqualsAll(tumbles, Vector<int>.AllBitsSet))
        {
            turned = Turn(orientation, angular, dt);
            if (Vector.EqualsAll(tumbles, Vector<int>.Zero))
            {
                orientation = turned;
                return;
            }
        }
        var isTilted = PrincipalAxes.Find(inverseInertia, tumbles, frames, indices, out var toBody, out var principal);
        var tilts = !Vector.EqualsAll(isTilted, Vector<int>.Zero);
        var frame = orientation;
        if (tilts)
            frame = QuaternionWide.Select(isTilted, QuaternionWide.Concatenate(toBody, orientation), orientation);
        var local = QuaternionWide.Conjugate(frame) * own;
        Split(principal, tumbles, dt, ref local, out var order, out var inverse, out var rate, out var momentum);
        var about = FromRotationVector((frame * order.FromCycle(momentum)) * dt);
        var innerSteps = CountInnerSteps(Vector.SquareRoot(momentum.LengthSquared() * Vector.Abs(rate.X * rate.Y)));
        Rotate(rate.X, rate.Y, innerSteps, momentum, out var change, out var spin);
        angular = Vector3Wide.Select(tumbles, Join(order, inverse, about, own, local, change, spin, ref frame), angular);
        if (tilts)
            frame = QuaternionWide.Select(isTilted, Tidy(QuaternionWide.Concatenate(QuaternionWide.Conjugate(toBody), frame)), frame);
        orientation = QuaternionWide.Select(tumbles, frame, turned);
    }

    // Which of a body's principal axes has the middle moment: axes in cyclic order with that one last, as a cyclic change of names keeps a frame right-handed.
    struct AxisOrder
    {
        public Vector<int> MiddleX, MiddleY;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide ToCycle(in Vector3Wide v) => Cycle(v, MiddleX, MiddleY);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector3Wide FromCycle(in Vector3Wide v) => Cycle(v, MiddleY, MiddleX);
    }

    // Rates: how far the momentum turns about u and v within the time, for what it is about them.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Split(Vector3Wide principal, Vector<int> tumbles, Vector<float> dt, ref Vector3Wide local, out AxisOrder order, out Vector2Wide inverse,
        out Vector2Wide rate, out Vector3Wide momentum)
    {
        order.MiddleX = IsBetween(principal.X, principal.Y, principal.Z);
        order.MiddleY = Vector.AndNot(IsBetween(principal.Y, principal.Z, principal.X), order.MiddleX);
        principal = order.ToCycle(principal);
        local = order.ToCycle(local);

        // Lanes that do not tumble compute with unit inertia, so that nothing is divided by zero in them. All moments are in units of the middle one.
        var one = Vector<float>.One;
        principal = Vector3Wide.Select(tumbles, principal, new(one, one, one));
        inverse.X = principal.X / principal.Z;
        inverse.Y = principal.Y / principal.Z;
        momentum = new(local.X / inverse.X, local.Y / inverse.Y, local.Z);
        rate.X = (inverse.X - one) * dt;
        rate.Y = (inverse.Y - one) * dt;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Join(in AxisOrder order, in Vector2Wide inverse, in QuaternionWide about, in Vector3Wide own, in Vector3Wide local,
        in Vector3Wide change, in QuaternionWide spin, ref QuaternionWide frame)
    {
        // What changes is added to what there is: to take the velocity itself to another frame and back would cost it a rounding in each step, always the same
        // one, and a thousandth in a minute.
        Vector3Wide localChange = new(change.X * inverse.X, change.Y * inverse.Y, change.Z);
        localChange += QuaternionWide.Displacement(spin, local + localChange);
        var turn = order.FromCycle(new(spin.X, spin.Y, spin.Z));
        var angular = about * (own + frame * order.FromCycle(localChange));
        frame = Tidy(QuaternionWide.Concatenate(QuaternionWide.Concatenate(new(turn.X, turn.Y, turn.Z, spin.W), frame), about));
        return angular;
    }

    // Turns the momentum within the body by u / 2, v, u / 2, as often as there are inner steps. Half-steps in the middle join to whole ones.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Rotate(Vector<float> rateU, Vector<float> rateV, Vector<float> innerSteps, in Vector3Wide momentum, out Vector3Wide change,
        out QuaternionWide spin)
    {
        var half = new Vector<float>(0.5f);
        var one = Vector<float>.One;
        var single = Vector.EqualsAll(innerSteps, one);
        if (!single)
        {
            rateU /= innerSteps;
            rateV /= innerSteps;
        }
        change = Vector3Wide.Zero;
        RotateU<AnyTurn>(rateU * half, momentum, ref change, out var s, out var c);
        spin = new(s, Vector<float>.Zero, Vector<float>.Zero, c);
        for (var i = one; !single && Vector.LessThanAny(i, innerSteps); i += one)
        {
            var active = Vector.LessThan(i, innerSteps);
            var nextChange = change;
            var nextSpin = spin;
            AppendV<AnyTurn>(rateV, momentum, ref nextChange, ref nextSpin);
            AppendU<AnyTurn>(rateU, momentum, ref nextChange, ref nextSpin);
            change = Vector3Wide.Select(active, nextChange, change);
            spin = QuaternionWide.Select(active, nextSpin, spin);
        }
        AppendV<AnyTurn>(rateV, momentum, ref change, ref spin);
        AppendU<AnyTurn>(rateU * half, momentum, ref change, ref spin);
    }

    // The same in one step, without calls. Bodies with an axis of symmetry turn about one axis of the two alone.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void RotateSlowly(Vector<float> rateU, Vector<float> rateV, in Vector3Wide momentum, out Vector3Wide change, out QuaternionWide spin)
    {
        var halfRate = rateU * new Vector<float>(0.5f);
        change = Vector3Wide.Zero;
        RotateU<SmallTurn>(halfRate, momentum, ref change, out var s, out var c);
        spin = new(s, Vector<float>.Zero, Vector<float>.Zero, c);
        if (Vector.EqualsAll(rateV, Vector<float>.Zero))
        {
            // The momentum about u is what it was, and so is the angle.
            Turn(s, c, momentum.Y + change.Y, momentum.Z + change.Z, ref change.Y, ref change.Z);
            spin.X = c * s + s * c;
            spin.W = c * c - s * s;
            return;
        }
        AppendV<SmallTurn>(rateV, momentum, ref change, ref spin);
        AppendU<SmallTurn>(halfRate, momentum, ref change, ref spin);
    }

    // Nothing to conserve for bodies that turn the same way about every axis, or that cannot turn about some.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> CanTumble(in Symmetric3x3Wide m)
    {
        var zero = Vector<float>.Zero;
        var isotropic = IsDiagonal(m) & Vector.Equals(m.XX, m.YY) & Vector.Equals(m.YY, m.ZZ);
        var turns = Vector.GreaterThan(m.XX, zero) & Vector.GreaterThan(m.YY, zero) & Vector.GreaterThan(m.ZZ, zero);
        return Vector.AndNot(turns, isotropic);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Tumbles(in Symmetric3x3Wide inverseInertia, in Vector3Wide angular) =>
        CanTumble(inverseInertia) & ~Vector.Equals(angular.LengthSquared(), Vector<float>.Zero);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsDiagonal(in Symmetric3x3Wide m)
    {
        var zero = Vector<float>.Zero;
        return Vector.Equals(m.YX, zero) & Vector.Equals(m.ZX, zero) & Vector.Equals(m.ZY, zero);
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
    static void RotateU<TTurn>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, out Vector<float> s, out Vector<float> c)
        where TTurn : struct, ITurn
    {
        Halve<TTurn>(rate * (start.X + change.X), out s, out c);
        Turn(s, c, start.Y + change.Y, start.Z + change.Z, ref change.Y, ref change.Z);
    }

    // The product of quaternions, of which the first is a turn about one axis.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void AppendU<TTurn>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, ref QuaternionWide spin) where TTurn : struct, ITurn
    {
        RotateU<TTurn>(rate, start, ref change, out var s, out var c);
        spin = new(c * spin.X + s * spin.W, c * spin.Y + s * spin.Z, c * spin.Z - s * spin.Y, c * spin.W - s * spin.X);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void AppendV<TTurn>(Vector<float> rate, in Vector3Wide start, ref Vector3Wide change, ref QuaternionWide spin) where TTurn : struct, ITurn
    {
        Halve<TTurn>(rate * (start.Y + change.Y), out var s, out var c);
        Turn(s, c, start.Z + change.Z, start.X + change.X, ref change.Z, ref change.X);
        spin = new(c * spin.X - s * spin.Z, c * spin.Y + s * spin.W, c * spin.Z + s * spin.X, c * spin.W - s * spin.Y);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Halve<TTurn>(Vector<float> angle, out Vector<float> sin, out Vector<float> cos) where TTurn : struct, ITurn =>
        TTurn.SinCos(WithoutDust(angle * new Vector<float>(0.5f), LeastPrecession), out sin, out cos);

    // Sine and cosine of half of an angle by which a body turns; both give the same bits for what is small.
    interface ITurn
    {
        static abstract void SinCos(Vector<float> half, out Vector<float> sin, out Vector<float> cos);
    }

    struct AnyTurn : ITurn
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void SinCos(Vector<float> half, out Vector<float> sin, out Vector<float> cos) => Wide.SinCos(half, out sin, out cos);
    }

    struct SmallTurn : ITurn
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void SinCos(Vector<float> half, out Vector<float> sin, out Vector<float> cos)
        {
            Wide.SinOverAngle(half * half, out sin, out cos);
            sin *= half;
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
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Cycle(in Vector3Wide v, Vector<int> once, Vector<int> twice) => Vector3Wide.Select(
        once, new(v.Y, v.Z, v.X), Vector3Wide.Select(twice, new(v.Z, v.X, v.Y), v));
}
