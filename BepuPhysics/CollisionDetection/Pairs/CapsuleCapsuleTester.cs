using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Capsule against capsule: a contact where their segments are nearest; capsules that lie along each other have two, at the ends of the
/// stretch that they share.
/// </summary>
// The nearest points of two segments, with units u and v and the offset t from the one centre to the other:
//   unconstrained: s = ((t x v) . (u x v)) / |u x v|^2, then clamped, then the nearest point of B to it, clamped, and the nearest of A to
//   that (Ericson, Real-Time Collision Detection, 5.1.9). In the usual form of s, with dot products, numerator and denominator both cancel
//   for nearly parallel segments; with cross products their relative errors stay small, and the distance is right to rounding.
public readonly struct CapsuleCapsuleTester : IPairTester<CapsuleWide, CapsuleWide, Few2<ContactWide>>
{
    // Squared sine below which segments count as parallel: at this angle a segment leaves the other's line by 3e-6 of its length.
    const float ParallelSineSquared = 1e-11f;
    // Squared sine above which the direction across two crossing segments is better known from their cross product than from a distance.
    const float CrossingSineSquared = 1e-4f;
    // Part of the size of the pair below which the distance of the segments is rounding and its direction noise.
    const float MeetingDistance = 1e-6f;
    // A contact may be where the other segment is this part of the sum of the radii to the side: the distance there differs from the depth
    // along the normal by the square of it.
    const float SideDeviation = 0.02f;
    // Contacts nearer to each other than this part of the sum of the radii are one.
    const float MinimumContactDistance = 0.2f;

    /// <inheritdoc/>
    public static void Test(in CapsuleWide a, in CapsuleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var u = QuaternionWide.TransformUnitY(pose.OrientationA);
        var v = QuaternionWide.TransformUnitY(pose.OrientationB);
        var t = pose.OffsetB;
        var radius = a.Radius + b.Radius;

        var cross = Vector3Wide.Cross(u, v);
        var sineSquared = cross.LengthSquared();
        var parallel = Vector.LessThan(sineSquared, new Vector<float>(ParallelSineSquared));
        var cosine = Vector3Wide.Dot(u, v);
        var tu = Vector3Wide.Dot(t, u);
        var tv = Vector3Wide.Dot(t, v);

        // The stretch of A's segment that lies beside B's.
        var reach = b.HalfLength * Vector.Abs(cosine);
        var start = Wide.Max(-a.HalfLength, tu - reach);
        var end = Wide.Min(a.HalfLength, tu + reach);

        // Parallel segments are equally near all along that stretch, or nearest at its ends, which have then passed each other.
        var crossing = Vector3Wide.Dot(Vector3Wide.Cross(t, v), cross) / sineSquared;
        var s = Wide.Select(parallel, new Vector<float>(0.5f) * (start + end), crossing);
        s = Wide.Clamp(s, -a.HalfLength, a.HalfLength);
        var onB = Wide.Clamp(s * cosine - tv, -b.HalfLength, b.HalfLength);
        s = Wide.Clamp(tu + onB * cosine, -a.HalfLength, a.HalfLength);
        var separation = u * s - t - v * onB;

        // Between inner points of both segments the separation is across both, between an inner point and an end across the one. What is
        // left along them is rounding, which counts when the segments nearly meet.
        var innerA = Vector.LessThan(Vector.Abs(s), a.HalfLength);
        var innerB = Vector.LessThan(Vector.Abs(onB), b.HalfLength);
        separation -= u * Wide.Mask(innerA, Vector3Wide.Dot(separation, u));
        separation -= v * Wide.Mask(innerB, Vector3Wide.Dot(separation, v));
        var distance = separation.Length();
        Vector3Wide.BuildOrthonormalBasis(u, out var acrossA, out _);
        var across = Vector3Wide.Select(parallel, acrossA, cross * (Vector<float>.One / Vector.SquareRoot(sineSquared)));
        across = Vector3Wide.Select(Vector.LessThan(Vector3Wide.Dot(across, separation), Vector<float>.Zero), -across, across);
        // Segments that meet are pushed apart across both of them.
        var meeting = Vector.LessThanOrEqual(distance, (radius + a.HalfLength + b.HalfLength) * new Vector<float>(MeetingDistance));
        var useAcross = meeting | (innerA & innerB & Vector.GreaterThan(sineSquared, new Vector<float>(CrossingSineSquared)));
        manifold.Normal = Vector3Wide.Select(useAcross, across, separation * (Vector<float>.One / distance));

        // The second contact: as far along the shared stretch as the segments stay together.
        var deviation = radius * new Vector<float>(SideDeviation) / Vector.SquareRoot(sineSquared);
        deviation = Wide.Select(parallel, a.HalfLength + a.HalfLength, deviation);
        start = Wide.Min(s, Wide.Max(start, s - deviation));
        end = Wide.Max(s, Wide.Min(end, s + deviation));
        var two = Vector.GreaterThan(end - start, radius * new Vector<float>(MinimumContactDistance));

        ref var first = ref manifold.Contacts[0];
        WriteContact(a, b, u, v, t, cosine, tv, Wide.Select(two, start, s), manifold.Normal, ref first);
        first.FeatureId = Vector<int>.Zero;
        first.Exists = Vector.GreaterThanOrEqual(first.Depth, -speculativeMargin);
        ref var second = ref manifold.Contacts[1];
        WriteContact(a, b, u, v, t, cosine, tv, end, manifold.Normal, ref second);
        second.FeatureId = Vector<int>.One;
        second.Exists = two & Vector.GreaterThanOrEqual(second.Depth, -speculativeMargin);
    }

    /// <summary>Writes the contact between a point of A's segment and the point of B's that is nearest to it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteContact(in CapsuleWide a, in CapsuleWide b, in Vector3Wide u, in Vector3Wide v, in Vector3Wide t,
        Vector<float> cosine, Vector<float> tv, Vector<float> s, in Vector3Wide normal, ref ContactWide contact)
    {
        var onB = Wide.Clamp(s * cosine - tv, -b.HalfLength, b.HalfLength);
        var onA = u * s;
        var distance = Vector3Wide.Dot(onA - t - v * onB, normal);
        contact.Depth = a.Radius + b.Radius - distance;
        contact.OffsetA = onA + normal * (contact.Depth * new Vector<float>(0.5f) - a.Radius);
    }
}
