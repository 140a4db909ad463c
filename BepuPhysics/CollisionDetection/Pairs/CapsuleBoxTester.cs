using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Capsule against box: two contacts at the ends of the part of the capsule's segment that is over the box's face, one where only a point
/// is near.
/// </summary>
// Everything happens in the box's frame. A segment that is outside of the box has a nearest point, found exactly; the normal is the
// direction from there. A segment that meets the box leaves it along one of its six separating axes: a face, or a cross product of the
// segment with an edge. Both are computed for every lane. Where the nearest features are a face, or two edges, they agree to rounding, and
// the axis is the better known of the two; elsewhere the distance is greater than what any axis shows.
public readonly struct CapsuleBoxTester : IPairTester<CapsuleWide, BoxWide, Few2<ContactWide>>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in CapsuleWide a, in BoxWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        var u = QuaternionWide.TransformUnitY(pose.OrientationA);
        var center = axes * -pose.OffsetB;
        var direction = axes * u;
        var half = new Vector3Wide(b.HalfWidth, b.HalfHeight, b.HalfLength);
        var size = a.HalfLength + half.X + half.Y + half.Z;

        BoxLine.FindNearest(center, direction, half, -a.HalfLength, a.HalfLength, out var nearest);
        var point = center + direction * nearest;
        var outside = Outside(point, half);
        // Between the box and an inner point of the segment the way is across it. What is left along it is rounding.
        var inner = Vector.LessThan(Vector.Abs(nearest), a.HalfLength);
        outside -= direction * Wide.Mask(inner, Vector3Wide.Dot(outside, direction));
        var distance = outside.Length();
        FindLeastDepth(center, direction, a.HalfLength, half, size, out var coreDepth, out var normal);

        var beyondAxis = outside - normal * Wide.Max(-coreDepth, Vector<float>.Zero);
        var usePoint = Vector.GreaterThan(beyondAxis.Length(), size * new Vector<float>(PairTolerances.CapsuleAdvantage));
        normal = Vector3Wide.Select(usePoint, outside * (Vector<float>.One / distance), normal);
        var pairDepth = a.Radius + Wide.Select(usePoint, -distance, coreDepth);

        // The face that looks along the normal, and how far along the normal the segment is from its plane: linear in s.
        var absolute = Vector3Wide.Abs(normal);
        var useX = Vector.GreaterThanOrEqual(absolute.X, absolute.Y) & Vector.GreaterThanOrEqual(absolute.X, absolute.Z);
        var useY = Vector.AndNot(Vector.GreaterThanOrEqual(absolute.Y, absolute.Z), useX);
        var useZ = ~(useX | useY);
        var faceNormal = Choose(useX, useY, normal);
        var inverse = Vector<float>.One / faceNormal;
        var height = (Choose(useX, useY, center) - Wide.CopySign(Choose(useX, useY, half), faceNormal)) * inverse;
        var slope = Choose(useX, useY, direction) * inverse;

        var onFace = center - normal * height;
        var alongFace = direction - normal * slope;
        var border = size * new Vector<float>(PairTolerances.CapsuleBorder);
        var start = -a.HalfLength;
        var end = a.HalfLength;
        ClipToSlab(onFace.X, alongFace.X, half.X + border, useX, ref start, ref end);
        ClipToSlab(onFace.Y, alongFace.Y, half.Y + border, useY, ref start, ref end);
        ClipToSlab(onFace.Z, alongFace.Z, half.Z + border, useZ, ref start, ref end);
        // A segment that is beside the face touches it in one point, by rounding where an axis was used.
        var beside = Vector.GreaterThan(start, end);
        var only = Wide.Select(usePoint, nearest, Wide.Clamp((start + end) * new Vector<float>(0.5f), -a.HalfLength, a.HalfLength));
        start = Wide.Select(beside, only, start);
        end = Wide.Select(beside, only, end);
        start = Wide.Select(usePoint, Wide.Min(start, nearest), start);
        end = Wide.Select(usePoint, Wide.Max(end, nearest), end);

        var two = Vector.GreaterThan(end - start, (a.HalfLength + a.Radius) * new Vector<float>(PairTolerances.SameContactOnFace));
        var deeper = Wide.Select(Vector.LessThan(slope, Vector<float>.Zero), end, start);
        manifold.Normal = Matrix3x3Wide.TransposeTimes(axes, normal);
        ref var first = ref manifold.Contacts[0];
        WriteContact(a.Radius, u, height, slope, pairDepth, Wide.Select(two, start, deeper), manifold.Normal, ref first);
        first.FeatureId = Vector<int>.Zero;
        first.Exists = Vector.GreaterThanOrEqual(first.Depth, -speculativeMargin);
        ref var second = ref manifold.Contacts[1];
        WriteContact(a.Radius, u, height, slope, pairDepth, end, manifold.Normal, ref second);
        second.FeatureId = Vector<int>.One;
        second.Exists = two & Vector.GreaterThanOrEqual(second.Depth, -speculativeMargin);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Choose(Vector<int> useX, Vector<int> useY, in Vector3Wide v) =>
        Wide.Select(useX, v.X, Wide.Select(useY, v.Y, v.Z));

    /// <summary>What is left of a vector from the box's nearest point.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Outside(in Vector3Wide point, in Vector3Wide half) => new(
        point.X - Wide.Clamp(point.X, -half.X, half.X),
        point.Y - Wide.Clamp(point.Y, -half.Y, half.Y),
        point.Z - Wide.Clamp(point.Z, -half.Z, half.Z));

    /// <summary>Depth of the segment in the box, negative where they are apart, and the axis that shows it, from box to segment.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void FindLeastDepth(in Vector3Wide center, in Vector3Wide direction, Vector<float> halfLength, in Vector3Wide half,
        Vector<float> size, out Vector<float> depth, out Vector3Wide normal)
    {
        var absolute = Vector3Wide.Abs(direction);
        var faceDepths = half + absolute * halfLength - Vector3Wide.Abs(center);
        depth = Wide.Min(faceDepths.X, Wide.Min(faceDepths.Y, faceDepths.Z));
        var useX = Vector.Equals(depth, faceDepths.X);
        var useY = Vector.AndNot(Vector.Equals(depth, faceDepths.Y), useX);
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        normal = new(Wide.Mask(useX, one), Wide.Mask(useY, one), Wide.Mask(~(useX | useY), one));

        var squares = direction * direction;
        var moment = Vector3Wide.Abs(Vector3Wide.Cross(center, direction));
        var crossX = half.Y * absolute.Z + half.Z * absolute.Y - moment.X;
        var crossY = half.Z * absolute.X + half.X * absolute.Z - moment.Y;
        var crossZ = half.X * absolute.Y + half.Y * absolute.X - moment.Z;
        var edgeDepth = new Vector<float>(float.MaxValue);
        var edgeNormal = normal;
        TryEdge(crossX, squares.Y + squares.Z, new(zero, -direction.Z, direction.Y), ref edgeDepth, ref edgeNormal);
        TryEdge(crossY, squares.Z + squares.X, new(direction.Z, zero, -direction.X), ref edgeDepth, ref edgeNormal);
        TryEdge(crossZ, squares.X + squares.Y, new(-direction.Y, direction.X, zero), ref edgeDepth, ref edgeNormal);
        var useEdge = Vector.LessThan(edgeDepth + size * new Vector<float>(PairTolerances.CapsuleAdvantage), depth);
        depth = Wide.Select(useEdge, edgeDepth, depth);
        normal = Vector3Wide.Select(useEdge, edgeNormal, normal);
        normal = Vector3Wide.Select(Vector.LessThan(Vector3Wide.Dot(normal, center), zero), -normal, normal);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void TryEdge(Vector<float> scaledDepth, Vector<float> sineSquared, in Vector3Wide axis, ref Vector<float> depth,
        ref Vector3Wide normal)
    {
        var inverse = Vector<float>.One / Vector.SquareRoot(sineSquared);
        var axisDepth = scaledDepth * inverse;
        var better = Vector.LessThan(axisDepth, depth) & Vector.GreaterThan(sineSquared, new Vector<float>(PairTolerances.ParallelBoxEdge));
        depth = Wide.Select(better, axisDepth, depth);
        normal = Vector3Wide.Select(better, axis * inverse, normal);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ClipToSlab(Vector<float> position, Vector<float> speed, Vector<float> extent, Vector<int> isFaceAxis,
        ref Vector<float> start, ref Vector<float> end)
    {
        // A segment that moves less than the tolerance of the border over its whole length counts as parallel to it.
        var inverse = Vector<float>.One / Wide.CopySign(Wide.Max(Vector.Abs(speed), new Vector<float>(PairTolerances.CapsuleBorder)), speed);
        var middle = -position * inverse;
        var reach = extent * Vector.Abs(inverse);
        start = Wide.Select(isFaceAxis, start, Wide.Max(start, middle - reach));
        end = Wide.Select(isFaceAxis, end, Wide.Min(end, middle + reach));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteContact(Vector<float> radius, in Vector3Wide u, Vector<float> height, Vector<float> slope, Vector<float> pairDepth,
        Vector<float> s, in Vector3Wide normal, ref ContactWide contact)
    {
        // No contact is deeper than the pair; the border's tolerance can make it seem so.
        contact.Depth = Wide.Min(radius - (height + slope * s), pairDepth);
        contact.OffsetA = u * s + normal * (contact.Depth * new Vector<float>(0.5f) - radius);
    }
}
