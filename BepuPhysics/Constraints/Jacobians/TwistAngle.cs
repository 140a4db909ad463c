using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>By how much body B is turned against body A about their twist axes, the Z axes of two bases that are fixed to them.</summary>
// q = rotation from B's basis to A's basis;  twist = 2 atan2(q.Z, q.W): what remains of q when B's twist axis has been swung onto A's
//     the shortest way
// d twist/dt = t (wB - wA),  t = (zA + zB) / (1 + zA zB),  zA and zB the twist axes; in the frame of A's basis,
//     1 + zA zB = 2 (q.Z^2 + q.W^2) and (zA + zB) / 2 = (q.X q.Z + q.Y q.W, q.Y q.Z - q.X q.W, q.Z^2 + q.W^2)
// Axes that point against each other have no twist: it spins around the circle ever faster as they come near that. Within 3.6 degrees
// of it t is zero by definition, so that rows along it let go.
struct TwistAngle
{
    // Square of the cosine of half the angle between the twist axes: (sin 1.8 degrees)^2. There, t is 32 times as long as at rest.
    const float LeastDefined = 1e-3f;

    // The same where a row that holds the twist to something else begins to let go of it: half a radian from axes that point against each other, where t is 4
    // times as long as at rest.
    const float LeastHeld = 1f / 16;

    QuaternionWide basisA;
    QuaternionWide q;

    /// <summary>The twist between two bases that are given in their bodies' frames.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Measure(in TwoBodies bodies, in QuaternionWide localBasisA, in QuaternionWide localBasisB, out TwistAngle twist)
    {
        twist.basisA = QuaternionWide.Concatenate(localBasisA, bodies.A.Orientation);
        var basisB = QuaternionWide.Concatenate(localBasisB, bodies.B.Orientation);
        twist.q = QuaternionWide.Concatenate(basisB, QuaternionWide.Conjugate(twist.basisA));
    }

    /// <summary>The twist, radians, within half a turn.</summary>
    internal readonly Vector<float> Angle
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            // The two quaternions of a rotation give angles a turn apart; with W not negative the angle is within half a turn.
            var half = Wide.CopySign(Wide.AtanOfQuarter(Vector.Abs(q.Z), Vector.Abs(q.W)), q.Z * Wide.Sign(q.W));
            return half + half;
        }
    }

    /// <summary>The part of a twist that a row may hold to something else than the twist itself: all of it, down to none where there is no twist.</summary>
    // t, and the angle with it, would run away from what they are held to in the fraction of a turn in which axes swing past being opposite: no substep follows
    // that, and the impulse of the one before, on a t that is ten times as long, throws what it turns.
    internal readonly Vector<float> Held
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Wide.Min(Vector<float>.One, Defined * new Vector<float>(1 / LeastHeld));
    }

    // Square of the cosine of half the angle between the twist axes.
    readonly Vector<float> Defined
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => q.Z * q.Z + q.W * q.W;
    }

    /// <summary>An angle less whole turns: what is left is within half a turn, either way.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> WithinHalfATurn(Vector<float> angle) =>
        angle - Vector.Floor(angle * new Vector<float>(1 / MathHelper.TwoPi) + new Vector<float>(0.5f)) * new Vector<float>(MathHelper.TwoPi);

    /// <summary>The vector t, times a factor.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector3Wide Axis(Vector<float> factor)
    {
        var defined = Defined;
        var scale = Wide.Mask(Vector.GreaterThan(defined, new Vector<float>(LeastDefined)), factor / defined);
        return basisA * (new Vector3Wide(q.X * q.Z + q.Y * q.W, q.Y * q.Z - q.X * q.W, defined) * scale);
    }
}
