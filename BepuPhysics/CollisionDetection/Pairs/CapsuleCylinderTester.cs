using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Capsule against cylinder: two contacts at the ends of the part of the capsule's segment that is over an end of the cylinder or along its
/// side, one where only a point is near.
/// </summary>
// A segment that is apart from the cylinder has a nearest point, and the normal is the direction to it. A segment that meets the cylinder
// leaves it through an end, across the axis, or across itself over the rim: cylinder and segment, added, have no other smooth surfaces, and
// the nearest point of a convex surface from inside is on a smooth one.
public readonly struct CapsuleCylinderTester : IPairTester<CapsuleWide, CylinderWide, Few2<ContactWide>>
{
    // Part of the size of the pair below which the distance of segment and cylinder is rounding and its direction noise.
    const float IntersectionDistance = 3e-6f;

    struct Least
    {
        public Vector3Wide Normal;
        public Vector<float> Depth, Place;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in CapsuleWide a, in CylinderWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        var u = QuaternionWide.TransformUnitY(pose.OrientationA);
        CapsuleCylinderFrame.Create(b, axes.Y, u, pose.OffsetB, axes.X, axes.Z, out var frame);
        var size = a.HalfLength + a.Radius + b.Radius + b.HalfLength;
        FindLeast(a.HalfLength, b, frame, size, out var least);
        WriteContacts(a, b, frame, size, u, least, speculativeMargin, ref manifold);
    }

    /// <summary>Finds the least depth of the segment, negative where they are apart, and where on the segment it is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void FindLeast(Vector<float> halfLength, in CylinderWide b, in CapsuleCylinderFrame frame, Vector<float> size, out Least least)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var nearest = frame.FindNearest(halfLength, b);
        var y = frame.Center.Y + frame.Rise * nearest;
        var z = frame.Center.Z + frame.Run * nearest;
        var fromAxis = Vector.SquareRoot(frame.Center.X * frame.Center.X + z * z);
        var beyondSide = Wide.Max(fromAxis - b.Radius, zero);
        var beyondEnd = y - Wide.Clamp(y, -b.HalfLength, b.HalfLength);
        var part = beyondSide * Wide.Mask(Vector.GreaterThan(fromAxis, zero), one / fromAxis);
        var outside = new Vector3Wide(frame.Center.X * part, beyondEnd, z * part);
        // Between the cylinder and an inner point of the segment the way is across it. What is left along it is rounding.
        var inner = Vector.LessThan(Vector.Abs(nearest), halfLength);
        var along = Wide.Mask(inner, outside.Y * frame.Rise + outside.Z * frame.Run);
        outside.Y -= frame.Rise * along;
        outside.Z -= frame.Run * along;
        var distance = outside.Length();

        LeaveByEndOrSide(halfLength, b, frame, out least);
        LeaveOverRim(halfLength, b, frame, size, ref least);
        var isApart = Vector.GreaterThan(distance, size * new Vector<float>(IntersectionDistance));
        least.Normal = Vector3Wide.Select(isApart, outside * (one / distance), least.Normal);
        least.Depth = Wide.Select(isApart, -distance, least.Depth);
        least.Place = Wide.Select(isApart, nearest, least.Place);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void LeaveByEndOrSide(Vector<float> halfLength, in CylinderWide b, in CapsuleCylinderFrame frame, out Least least)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        // Seen along the axis: a segment in a circle. On the axis itself, across the segment.
        var sidePlace = Wide.Clamp(frame.Passing, -halfLength, halfLength);
        var isPassed = frame.HasPassing & Vector.LessThanOrEqual(Vector.Abs(frame.Passing), halfLength);
        var z = Wide.Select(isPassed, zero, frame.Center.Z + frame.Run * sidePlace);
        var fromAxis = Vector.SquareRoot(frame.Center.X * frame.Center.X + z * z);
        var hasSide = Vector.GreaterThan(fromAxis, zero);
        var inverse = one / fromAxis;
        var sideX = Wide.Select(hasSide, frame.Center.X * inverse, one);
        var sideZ = Wide.Mask(hasSide, z * inverse);
        var sideDepth = b.Radius - fromAxis;

        var endSign = Wide.CopySign(one, frame.Center.Y);
        var endDepth = b.HalfLength + halfLength * frame.Rise - Vector.Abs(frame.Center.Y);
        var useEnd = Vector.LessThanOrEqual(endDepth, sideDepth);
        least.Depth = Wide.Select(useEnd, endDepth, sideDepth);
        least.Normal = new(Wide.Select(useEnd, zero, sideX), Wide.Mask(useEnd, endSign), Wide.Select(useEnd, zero, sideZ));
        least.Place = Wide.Select(useEnd, -halfLength * endSign, sidePlace);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void LeaveOverRim(Vector<float> halfLength, in CylinderWide b, in CapsuleCylinderFrame frame, Vector<float> size, ref Least least)
    {
        // Across the segment, and towards where it is nearest to the rim's line.
        var toSide = frame.Rise * frame.Center.X;
        var squaredLength = toSide * toSide + frame.ToRim * frame.ToRim;
        var inverse = Vector<float>.One / Vector.SquareRoot(squaredLength);
        var fromAxis = Vector.SquareRoot(frame.Center.X * frame.Center.X + frame.ToRim * frame.ToRim);
        var scaledDepth = b.Radius * frame.Rise * fromAxis - toSide * frame.Center.X +
            (b.HalfLength * frame.Run - frame.Above) * frame.ToRim;
        var tolerance = size * new Vector<float>(PairTolerances.CapsuleAdvantage);
        var depth = scaledDepth * inverse;
        // At a length of rounding the direction is noise, and one of the others is as good.
        var use = Vector.LessThan(depth + tolerance, least.Depth) & Vector.GreaterThan(squaredLength, tolerance * tolerance);
        var across = frame.ToRim * inverse;
        least.Depth = Wide.Select(use, depth, least.Depth);
        least.Normal = Vector3Wide.Select(use, new(toSide * inverse, frame.Run * across, -frame.Rise * across), least.Normal);
        least.Place = Wide.Select(use, Wide.Clamp(frame.RimPlace, -halfLength, halfLength), least.Place);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteContacts(in CapsuleWide a, in CylinderWide b, in CapsuleCylinderFrame frame, Vector<float> size, in Vector3Wide u,
        in Least least, Vector<float> speculativeMargin, ref ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var normal = least.Normal;
        // How far along the normal the segment is from the plane of the end, or from that which touches the side: linear in s.
        var toSide = Vector.SquareRoot(normal.X * normal.X + normal.Z * normal.Z);
        var useEnd = Vector.GreaterThanOrEqual(Vector.Abs(normal.Y), toSide);
        var inverse = one / Wide.Select(useEnd, Vector.Abs(normal.Y), toSide);
        var endSign = Wide.CopySign(one, normal.Y);
        var faceX = Wide.Select(useEnd, zero, normal.X * inverse);
        var faceY = Wide.Mask(useEnd, endSign);
        var faceZ = Wide.Select(useEnd, zero, normal.Z * inverse);
        var center = frame.Center;
        var height = (faceX * center.X + faceY * center.Y + faceZ * center.Z - Wide.Select(useEnd, b.HalfLength, b.Radius)) * inverse;
        var slope = (faceY * frame.Rise + faceZ * frame.Run) * inverse;

        var onFace = center - normal * height;
        var alongFace = new Vector3Wide(-normal.X * slope, frame.Rise - normal.Y * slope, frame.Run - normal.Z * slope);
        var border = size * new Vector<float>(PairTolerances.CapsuleBorder);
        // A segment that moves less than the tolerance of the border over its whole length does not cross it.
        var leastSpeed = new Vector<float>(PairTolerances.CapsuleBorder);
        var acrossSquared = alongFace.X * alongFace.X + alongFace.Z * alongFace.Z;
        var speed = Wide.Select(useEnd, Vector.SquareRoot(acrossSquared), Vector.Abs(alongFace.Y));
        var inverseSpeed = one / Wide.Max(speed, leastSpeed);
        var directionX = alongFace.X * inverseSpeed;
        var directionZ = alongFace.Z * inverseSpeed;
        var beside = onFace.X * directionZ - onFace.Z * directionX;
        var reach = Wide.Select(useEnd, b.Radius, b.HalfLength) + border;
        var chordSquared = reach * reach - beside * beside;
        var misses = useEnd & Vector.LessThan(chordSquared, zero);
        reach = Wide.Select(useEnd, Vector.SquareRoot(Wide.Max(chordSquared, zero)), reach) * inverseSpeed;
        var middle = Wide.Select(useEnd, onFace.X * directionX + onFace.Z * directionZ, onFace.Y * Wide.CopySign(one, alongFace.Y)) *
            -inverseSpeed;
        var start = Wide.Max(middle - reach, -a.HalfLength);
        var end = Wide.Min(middle + reach, a.HalfLength);
        // On the side, only as far as the segment stays with the line.
        var turn = Wide.Max(Vector.Abs(faceX * frame.Run), new Vector<float>(1e-6f));
        var capsuleSize = a.HalfLength + a.Radius;
        var sideSize = Wide.Min(capsuleSize, b.Radius);
        var deviation = Vector.SquareRoot(b.Radius * sideSize) * new Vector<float>(FaceOverlap.SideDeviation) / turn;
        deviation = Wide.Select(useEnd, a.HalfLength + a.HalfLength, deviation);
        start = Wide.Max(start, least.Place - deviation);
        end = Wide.Min(end, least.Place + deviation);
        var isOver = Vector.AndNot(Vector.LessThanOrEqual(start, end), misses);

        // Where the deepest place is beside the face, the nearest place over it is as deep, to rounding.
        var deepest = least.Place;
        var deepestOver = Wide.Clamp(deepest, start, end);
        var isAsDeep = isOver & Vector.LessThanOrEqual(Vector.Abs(slope * (deepestOver - deepest)), border);
        deepest = Wide.Select(isAsDeep, deepestOver, deepest);
        start = Wide.Select(isOver, Wide.Min(start, deepest), deepest);
        end = Wide.Select(isOver, Wide.Max(end, deepest), deepest);
        var leastDistance = Wide.Select(
            useEnd, capsuleSize * new Vector<float>(PairTolerances.SameContactOnFace), sideSize * new Vector<float>(PairTolerances.SameContactOnSide));
        // A segment that stands on the face is over one place of it.
        var extent = end - start;
        var two = Vector.GreaterThan(extent * extent * alongFace.LengthSquared(), leastDistance * leastDistance);

        // In the capsule's own direction, so that contacts keep their names when it rolls over the level.
        slope = Wide.Select(frame.Reversed, -slope, slope);
        deepest = Wide.Select(frame.Reversed, -deepest, deepest);
        var first = Wide.Select(two, Wide.Select(frame.Reversed, -end, start), deepest);
        var second = Wide.Select(frame.Reversed, -start, end);
        var pairDepth = a.Radius + least.Depth;
        manifold.Normal = frame.AxisX * normal.X + frame.AxisY * normal.Y + frame.AxisZ * normal.Z;
        WriteContact(a.Radius, u, pairDepth, deepest, slope, first, manifold.Normal, ref manifold.Contacts[0]);
        manifold.Contacts[0].FeatureId = Vector<int>.Zero;
        manifold.Contacts[0].Exists = Vector.GreaterThanOrEqual(manifold.Contacts[0].Depth, -speculativeMargin);
        WriteContact(a.Radius, u, pairDepth, deepest, slope, second, manifold.Normal, ref manifold.Contacts[1]);
        manifold.Contacts[1].FeatureId = Vector<int>.One;
        manifold.Contacts[1].Exists = two & Vector.GreaterThanOrEqual(manifold.Contacts[1].Depth, -speculativeMargin);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void WriteContact(Vector<float> radius, in Vector3Wide u, Vector<float> pairDepth, Vector<float> deepest, Vector<float> slope,
        Vector<float> s, in Vector3Wide normal, ref ContactWide contact)
    {
        // No contact is deeper than the pair; the border's tolerance can make it seem so.
        contact.Depth = Wide.Min(pairDepth - slope * (s - deepest), pairDepth);
        contact.OffsetA = u * s + normal * (contact.Depth * new Vector<float>(0.5f) - radius);
    }
}
