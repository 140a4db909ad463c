using System;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Checks of what a game's narrow phase callbacks say of a pair, before anything of it is stored.</summary>
/// <remarks>
/// A number that the solver cannot bear would make bodies vanish through floors or become NaN steps later, where nobody finds out why. So
/// it ends the step with an exception that names the pair, the value and the callback. All numbers of a kind are compared at once; the
/// messages are made out of the way.
/// </remarks>
static class CallbackChecks
{
    /// <summary>Greatest speculative margin, m, and greatest offset and depth of a contact: squares must stay finite in float.</summary>
    internal const float MaximumLength = 1e13f;
    /// <summary>Greatest angular frequency, rad/s, and twice damping ratio of a contact's spring: their product must stay finite.</summary>
    const float MaximumSpring = 1e13f;

    // Friction, recovery, frequency and damping, as they follow one another. An unlimited recovery is a common setting.
    static Vector128<float> MaterialLimits => Vector128.Create(float.MaxValue, float.PositiveInfinity, MaximumSpring, MaximumSpring);

    /// <summary>The margin of a pair after the callbacks have allowed contacts.</summary>
    /// <param name="margin">What the callback made of it.</param>
    /// <param name="own">What the motion of the pair makes of it.</param>
    /// <param name="a">First collidable.</param>
    /// <param name="b">Second collidable.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Margin(ref float margin, float own, CollidableReference a, CollidableReference b)
    {
        if (!(margin >= 0 && margin <= MaximumLength))
            margin = LimitOwnMargin(margin, own, a, b);
    }

    // Bodies may be so fast that the margin is more than a pair test can bear: that is nobody's mistake.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static float LimitOwnMargin(float margin, float own, CollidableReference a, CollidableReference b)
    {
        if (margin == own)
            return MaximumLength;
        throw new InvalidOperationException(
            $"{nameof(INarrowPhaseCallbacks.AllowContactGeneration)} gave the pair ({a}, {b}) a speculative margin of {margin}: " +
            $"it must be from 0 to {MaximumLength} m.");
    }

    /// <summary>Contacts, of which there are some, and material of a pair after the callbacks have configured them.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Contacts(in CollidablePair pair, in ConvexContactManifold manifold, in PairMaterialProperties material)
    {
        if (!IsBearable(manifold))
            RefuseManifold(pair, manifold);
        if (!IsBearable(material))
            RefuseMaterial(pair, material);
    }

    /// <summary>Number of contacts of a pair of several manifolds.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Count(in CollidablePair pair, int count, int maximum)
    {
        if ((uint)count > (uint)maximum)
            RefuseCount(pair, count, maximum);
    }

    /// <summary>A coefficient of restitution that is not zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Restitution(in CollidablePair pair, float coefficient)
    {
        if (!(coefficient >= 0 && coefficient <= 1))
            Refuse(pair, "coefficient of restitution", coefficient, "it must be from 0 to 1");
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool IsBearable(in PairMaterialProperties material)
    {
        var values = Vector128.LoadUnsafe(in material.FrictionCoefficient);
        return (Vector128.GreaterThanOrEqual(values, Vector128<float>.Zero) & Vector128.LessThanOrEqual(values, MaterialLimits))
            .ExtractMostSignificantBits() == 0xF;
    }

    // The fields follow one another: a load for each contact, and one for the offset of B with the count behind it. Without their signs,
    // floats are in the order of their bits, NaN above infinity; and a count as small as this one is below any limit.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool IsBearable(in ConvexContactManifold manifold)
    {
        var count = manifold.Count;
        if ((uint)(count - 1) >= ConvexContactManifold.MaximumContactCount)
            return false;
        var limit = Vector128.Create(MaximumLength).AsInt32();
        var excess = Vector128.GreaterThan(LoadMagnitudes(in manifold.OffsetB.X), limit);
        ref var contact = ref Unsafe.AsRef(in manifold.Contact0);
        for (int i = 0; i < count; ++i)
            excess |= Vector128.GreaterThan(LoadMagnitudes(in Unsafe.Add(ref contact, i).Offset.X), limit);
        return excess == Vector128<int>.Zero && BodyChecks.HasUnitLength(Exact.LengthSquared(manifold.Normal));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<int> LoadMagnitudes(in float first) => Vector128.LoadUnsafe(in first).AsInt32() & Vector128.Create(int.MaxValue);

    [DoesNotReturn, MethodImpl(MethodImplOptions.NoInlining)]
    static void RefuseMaterial(in CollidablePair pair, in PairMaterialProperties material)
    {
        if (!(material.FrictionCoefficient >= 0 && material.FrictionCoefficient <= float.MaxValue))
            Refuse(pair, "coefficient of friction", material.FrictionCoefficient, "it must be finite and not negative");
        if (!(material.MaximumRecoveryVelocity >= 0))
            Refuse(pair, "maximum recovery velocity", material.MaximumRecoveryVelocity, "it must not be negative or NaN");
        var spring = material.SpringSettings;
        if (!(spring.AngularFrequency >= 0 && spring.AngularFrequency <= MaximumSpring))
            Refuse(pair, "spring's angular frequency", spring.AngularFrequency, $"it must be from 0 to {MaximumSpring} rad/s");
        Refuse(pair, "spring's twice damping ratio", spring.TwiceDampingRatio, $"it must be from 0 to {MaximumSpring}");
    }

    [DoesNotReturn, MethodImpl(MethodImplOptions.NoInlining)]
    static void RefuseManifold(in CollidablePair pair, in ConvexContactManifold manifold)
    {
        if (manifold.Count is < 1 or > ConvexContactManifold.MaximumContactCount)
            RefuseCount(pair, manifold.Count, ConvexContactManifold.MaximumContactCount);
        if (!BodyChecks.HasUnitLength(Exact.LengthSquared(manifold.Normal)))
            Refuse(pair, "contact normal", manifold.Normal, "it must have unit length");
        for (int i = 0; i < manifold.Count; ++i)
        {
            if (!(MathF.Abs(manifold.GetDepth(i)) <= MaximumLength))
                Refuse(pair, $"depth of contact {i}", manifold.GetDepth(i), $"it must be finite and at most {MaximumLength} m either way");
            if (!IsShort(manifold.GetOffset(i)))
                Refuse(pair, $"offset of contact {i}", manifold.GetOffset(i), $"it must be finite and at most {MaximumLength} m");
        }
        Refuse(pair, "offset of B", manifold.OffsetB, $"it must be finite and at most {MaximumLength} m");
    }

    [DoesNotReturn, MethodImpl(MethodImplOptions.NoInlining)]
    static void RefuseCount(in CollidablePair pair, int count, int maximum) =>
        Refuse(pair, "number of contacts", count, $"there can be 0 to {maximum}");

    static bool IsShort(Vector3 value) =>
        MathF.Abs(value.X) <= MaximumLength && MathF.Abs(value.Y) <= MaximumLength && MathF.Abs(value.Z) <= MaximumLength;

    [DoesNotReturn]
    static void Refuse<T>(in CollidablePair pair, string what, T value, string rule) => throw new InvalidOperationException(
        $"The {what} of the pair {pair} is {value} after the narrow phase callbacks: {rule}.");
}
