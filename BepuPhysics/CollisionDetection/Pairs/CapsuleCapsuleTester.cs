using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Capsule against capsule: a contact where their segments are nearest; capsules that lie along each other have two, at the ends of the
/// stretch that they share.
/// </summary>
// In A's frame its segment lies along Y around the origin. The nearest points of it and a segment with the unit v and the offset t:
//   unconstrained: s = t.y - v.y (t.x v.x + t.z v.z) / (v.x^2 + v.z^2), then clamped, then the nearest point of B to it, clamped, and the
//   nearest of A to that (Ericson, Real-Time Collision Detection, 5.1.9). In the usual form of s, with dot products, numerator and
//   denominator both cancel for nearly parallel segments; here their relative errors stay small, and the distance is right to rounding.
public readonly struct CapsuleCapsuleTester : IPairTester<CapsuleWide, CapsuleWide, Few2<ContactWide>>
{
    // Squared sine above which the direction across two crossing segments is better known from their cross product than from a distance.
    const float CrossingSineSquared = 1e-4f;
    // Part of the size of the pair below which the distance of the segments is rounding and its direction noise.
    const float IntersectionDistance = 1e-6f;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in CapsuleWide a, in CapsuleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationA);
        var v = axes * QuaternionWide.TransformUnitY(pose.OrientationB);
        var t = axes * pose.OffsetB;
        var radius = a.Radius + b.Radius;
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;

        // The stretch of A's segment that lies beside B's.
        var reach = b.HalfLength * Vector.Abs(v.Y);
        var start = Wide.Max(-a.HalfLength, t.Y - reach);
        var end = Wide.Min(a.HalfLength, t.Y + reach);

        // Parallel segments are equally near all along that stretch, or nearest at its ends, which have then passed each other.
        var sineSquared = v.X * v.X + v.Z * v.Z;
        var parallel = Vector.LessThan(sineSquared, new Vector<float>(PairTolerances.ParallelSegment));
        var across = t.X * v.X + t.Z * v.Z;
        var s = Wide.Select(parallel, new Vector<float>(0.5f) * (start + end), t.Y - v.Y * (across / sineSquared));
        s = Wide.Clamp(s, -a.HalfLength, a.HalfLength);
        var onB = Wide.Clamp((s - t.Y) * v.Y - across, -b.HalfLength, b.HalfLength);
        // From an inner point of A's segment the way is across it.
        var height = t.Y + v.Y * onB;
        s = Wide.Clamp(height, -a.HalfLength, a.HalfLength);
        var separation = new Vector3Wide(-(t.X + v.X * onB), s - height, -(t.Z + v.Z * onB));

        // From an inner point of B's segment it is across that. What is left along it is rounding, which counts when the segments nearly intersect.
        var innerA = Vector.LessThan(Vector.Abs(s), a.HalfLength);
        var innerB = Vector.LessThan(Vector.Abs(onB), b.HalfLength);
        separation -= v * Wide.Mask(innerB, Vector3Wide.Dot(separation, v));
        var distance = separation.Length();
        // A direction across both segments, any across the first where they are parallel. Segments that intersect are pushed apart along it.
        var inverseSine = Wide.Select(parallel, one, one / Vector.SquareRoot(sineSquared));
        var acrossX = Wide.Select(parallel, one, v.Z * inverseSine);
        var acrossZ = Wide.Mask(~parallel, -v.X * inverseSine);
        var side = Wide.CopySign(one, acrossX * separation.X + acrossZ * separation.Z);
        var intersecting = Vector.LessThanOrEqual(distance, (radius + a.HalfLength + b.HalfLength) * new Vector<float>(IntersectionDistance));
        var useAcross = intersecting | (innerA & innerB & Vector.GreaterThan(sineSquared, new Vector<float>(CrossingSineSquared)));
        var normal = Vector3Wide.Select(
            useAcross, new(acrossX * side, zero, acrossZ * side), separation * (one / distance));

        // Two contacts are at the ends of the stretch that the segments share, seen along the normal, as far as they stay together.
        // Along that stretch the place on B moves by a constant ratio of that on A.
        var normalV = Vector3Wide.Dot(normal, v);
        var numerator = v.Y - normal.Y * normalV;
        var denominator = Wide.Max(one - normalV * normalV, new Vector<float>(0.25f));
        var ratio = numerator / denominator;
        var inverseRatio = Wide.CopySign(Wide.Min(Vector.Abs(denominator / numerator), new Vector<float>(2f)), numerator);
        reach = b.HalfLength * Vector.Abs(inverseRatio);
        var middle = s - onB * inverseRatio;
        var deviation = Wide.Min(a.Radius, b.Radius) * new Vector<float>(FaceOverlap.SideDeviation) * inverseSine;
        deviation = Wide.Select(parallel, a.HalfLength + a.HalfLength, deviation);
        start = Wide.Min(s, Wide.Max(Wide.Max(-a.HalfLength, middle - reach), s - deviation));
        end = Wide.Max(s, Wide.Min(Wide.Min(a.HalfLength, middle + reach), s + deviation));
        var two = Vector.GreaterThan(end - start, radius * new Vector<float>(PairTolerances.SameContactOnSide));
        start = Wide.Select(two, start, s);

        // Along the normal, the distance is linear in the place on A.
        manifold.Normal = Matrix3x3Wide.TransposeTimes(axes, normal);
        var atOrigin = (onB - s * ratio) * normalV + Vector3Wide.Dot(t, normal);
        var slope = normal.Y - ratio * normalV;
        ref var first = ref manifold.Contacts[0];
        WriteContact(a.Radius, radius + atOrigin - slope * start, axes.Y, start, manifold.Normal, ref first);
        first.FeatureId = Vector<int>.Zero;
        first.Exists = Vector.GreaterThanOrEqual(first.Depth, -speculativeMargin);
        ref var second = ref manifold.Contacts[1];
        WriteContact(a.Radius, radius + atOrigin - slope * end, axes.Y, end, manifold.Normal, ref second);
        second.FeatureId = Vector<int>.One;
        second.Exists = two & Vector.GreaterThanOrEqual(second.Depth, -speculativeMargin);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteContact(Vector<float> radius, Vector<float> depth, in Vector3Wide u, Vector<float> place, in Vector3Wide normal,
        ref ContactWide contact)
    {
        contact.Depth = depth;
        contact.OffsetA = u * place + normal * (depth * new Vector<float>(0.5f) - radius);
    }
}
