using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Capsule against triangle: two contacts at the ends of the part of the capsule's segment that is over the face, one where only a point
/// is near or the triangle is met edge on.
/// </summary>
/// <remarks>
/// A one-sided triangle meets only capsules whose centre is in front of its plane, or on it, and only with normals that do not point behind
/// it. So a capsule that has passed through by more than half is let go, one that comes from behind is not caught by an edge that the
/// triangle shares with its neighbours, and a capsule without length behaves as a sphere. Over an edge of a closed surface the centre is
/// in front of at least one of the two triangles.
/// </remarks>
// Everything happens in the capsule's frame, where its segment lies along Y around the origin: most products with its direction and centre
// are components there. A segment that is apart from the triangle has a nearest point: an end over the face, or the nearest to one of the
// edges. A segment that meets the triangle leaves it along the normal of the face or across the segment and one of the edges. Both are
// computed for every lane. Where the nearest features are the face, or two edges, they agree to rounding, and the axis is the better known
// of the two; elsewhere the distance is greater than what any axis shows.
public readonly unsafe struct CapsuleTriangleTester : IPairTester<CapsuleWide, TriangleWide, Few2<ContactWide>>
{
    // Cosine between the normals of contact and face below which the triangle is met edge on.
    const float EdgeOnCosine = 0.1f;
    // Sides that are each moved out by a border meet farther beyond their corner: at the tip of a needle, a hundred borders away from a
    // triangle that has a hundredth of its length as its width. A side gets this many times the sine of its sharper corner of the border, at
    // most all of it. So two sides meet no more than twice as many borders beyond their corner.
    const float SharpSine = 1.5f;

    // Part of the size of the pair by which two distances may differ and be the same to the rounding of the corners.
    const float SameDistance = 5e-7f;

    struct Search
    {
        /// <summary>
        /// From the segment to the triangle where they are nearest, the place there on the segment, and how far apart they are along it.
        /// </summary>
        public Vector3Wide Offset;
        public Vector<float> Distance, Nearest, Shown;
        /// <summary>
        /// The axis of least depth across the segment and an edge, as long as the edge is across the segment; one over the square of that; the
        /// square of the depth, with its sign; and where the two pass each other.
        /// </summary>
        public Vector<float> AxisX, AxisZ, AxisInverseSquared, AxisScore, AxisPlace;
    }

    /// <summary>One edge of each triangle, seen along the normal of the face.</summary>
    struct Side
    {
        /// <summary>Direction away from the triangle, within its plane and across the edge; as long as the edge.</summary>
        public Vector3Wide Outward;
        /// <summary>How far the segment's middle is beyond the edge, times its length; negative on the side of the triangle.</summary>
        public Vector<float> Beyond;
        public Vector<float> Length;
    }

    /// <summary>What the steps of the test hand on, in the capsule's frame.</summary>
    struct Scratch
    {
        public Matrix3x3Wide Axes, AxesB;
        public Vector3Wide OffsetB;
        public PlacedTriangleWide Triangle;
        public Side AB, BC, CA;
        public Search Search;
        /// <summary>Length that tolerances are relative to.</summary>
        public Vector<float> Size;
        /// <summary>Height of the segment's middle over the plane.</summary>
        public Vector<float> Height;
        /// <summary>Normal and depth of the pair.</summary>
        public Vector3Wide Normal;
        public Vector<float> PairDepth;
        /// <summary>The place of the pair's depth on the segment, unless it is that of the lower end.</summary>
        public Vector<float> Deepest;
        public Vector<int> UseLowestEnd;
        /// <summary>Lanes whose pair may have contacts.</summary>
        public Vector<int> Exists;

        /// <summary>Whether a place on the segment is over the face.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector<int> IsOver(Vector<float> s) =>
            Vector.LessThanOrEqual(AB.Beyond + AB.Outward.Y * s, Vector<float>.Zero) &
            Vector.LessThanOrEqual(BC.Beyond + BC.Outward.Y * s, Vector<float>.Zero) &
            Vector.LessThanOrEqual(CA.Beyond + CA.Outward.Y * s, Vector<float>.Zero);
    }

    /// <inheritdoc/>
    // Step by step, each a method of its own: all at once has many times as many values as there are registers.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in CapsuleWide a, in TriangleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        int anchor;
        // Frames of the steps are at the quickest of the four places in a line.
        var memory = stackalloc byte[AlignedScratch.SizeFor<Scratch>(&anchor, 1)];
        ref var scratch = ref AlignedScratch.Align<Scratch>(memory);
        ref var triangle = ref scratch.Triangle;
        pose.GetLocal(out scratch.Axes, out scratch.AxesB, out scratch.OffsetB);
        triangle.PlaceThin(b, scratch.AxesB, scratch.OffsetB, out scratch.Height);
        PrepareSides(a, b, ref scratch);
        VisitEdge(triangle.A, triangle.AB, triangle.CA, a.HalfLength, b.TwoSidedMask, ref scratch);
        VisitEdge(triangle.B, triangle.BC, triangle.AB, a.HalfLength, b.TwoSidedMask, ref scratch);
        VisitEdge(triangle.C, triangle.CA, triangle.BC, a.HalfLength, b.TwoSidedMask, ref scratch);
        ChooseNormal(a, b, ref scratch);
        // No contact is deeper than the pair.
        scratch.Exists &= Vector.GreaterThanOrEqual(scratch.PairDepth, -speculativeMargin);
        if (Vector.EqualsAll(scratch.Exists, Vector<int>.Zero))
        {
            manifold.RemoveContacts();
            return;
        }
        WriteContacts(a, speculativeMargin, scratch, ref manifold);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void PrepareSides(in CapsuleWide a, in TriangleWide b, ref Scratch scratch)
    {
        ref var triangle = ref scratch.Triangle;
        PrepareSide(triangle.A, triangle.AB, triangle.Front, ref scratch.AB);
        PrepareSide(triangle.B, triangle.BC, triangle.Front, ref scratch.BC);
        PrepareSide(triangle.C, triangle.CA, triangle.Front, ref scratch.CA);
        scratch.Size = a.HalfLength + a.Radius +
            Vector.SquareRoot(Wide.Max(Wide.Max(b.A.LengthSquared(), b.B.LengthSquared()), b.C.LengthSquared()));
        ref var search = ref scratch.Search;
        search.Distance = search.AxisScore = new Vector<float>(float.MaxValue);
        search.Nearest = search.AxisPlace = search.Shown = search.AxisX = search.AxisZ = search.AxisInverseSquared = Vector<float>.Zero;
        search.Offset = Vector3Wide.Zero;
    }

    // The corners follow each other clockwise around the normal of the front.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void PrepareSide(in Vector3Wide start, in Vector3Wide edge, in Vector3Wide front, ref Side side)
    {
        var outward = Vector3Wide.Cross(front, edge);
        side.Outward = outward;
        side.Beyond = -Vector3Wide.Dot(outward, start);
        side.Length = edge.Length();
    }

    /// <summary>Finds the normal, and what is to be known of the pair for its contacts.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseNormal(in CapsuleWide a, in TriangleWide b, ref Scratch scratch)
    {
        var zero = Vector<float>.Zero;
        ref var search = ref scratch.Search;
        ref var front = ref scratch.Triangle.Front;
        var height = scratch.Height;
        // The ends over the face, and the segment through it.
        var rise = front.Y * a.HalfLength;
        var firstHeight = height - rise;
        var secondHeight = height + rise;
        var product = firstHeight * secondHeight;
        Keep(front * -firstHeight, Vector.Abs(firstHeight), -a.HalfLength, Wide.Min(firstHeight * firstHeight, product),
            scratch.IsOver(-a.HalfLength), ref scratch);
        Keep(front * -secondHeight, Vector.Abs(secondHeight), a.HalfLength, Wide.Min(secondHeight * secondHeight, product),
            scratch.IsOver(a.HalfLength), ref scratch);
        // Opposite signs: the divisor is not zero.
        var crossing = -height / front.Y;
        var crosses = Vector.LessThan(product, zero) & scratch.IsOver(crossing);
        var nearest = Wide.Select(crosses, crossing, search.Nearest);
        var offset = Vector3Wide.Select(crosses, Vector3Wide.Zero, -search.Offset);
        var distance = search.Distance;

        // The face's two normals; a one-sided triangle has the front's only.
        var frontDepth = Vector.Abs(rise) - height;
        var backDepth = Vector.Abs(rise) + height;
        var useBack = Vector.LessThan(backDepth, frontDepth) & b.TwoSidedMask;
        var faceDepth = Wide.Select(useBack, backDepth, frontDepth);
        var faceNormal = Vector3Wide.Select(useBack, -front, front);
        var tolerance = scratch.Size * new Vector<float>(PairTolerances.CapsuleAdvantage);
        var axisDepth = Wide.CopySign(Vector.SquareRoot(Vector.Abs(search.AxisScore)), search.AxisScore);
        var useEdge = Vector.LessThan(axisDepth + tolerance, faceDepth);
        var coreDepth = Wide.Select(useEdge, axisDepth, faceDepth);
        var inverseAxis = Vector.SquareRoot(search.AxisInverseSquared);
        var normal = Vector3Wide.Select(useEdge, new(search.AxisX * inverseAxis, zero, search.AxisZ * inverseAxis), faceNormal);

        var beyondAxis = offset - normal * Wide.Max(-coreDepth, zero);
        var usePoint = Vector.AndNot(Vector.GreaterThan(beyondAxis.Length(), tolerance), crosses);
        normal = Vector3Wide.Select(usePoint, offset * (Vector<float>.One / distance), normal);
        scratch.Normal = normal;
        scratch.PairDepth = a.Radius + Wide.Select(usePoint, -distance, coreDepth);
        scratch.Deepest = Wide.Select(usePoint, nearest, search.AxisPlace);
        scratch.UseLowestEnd = ~(usePoint | useEdge);
        // A triangle without area has no front, and no contacts.
        scratch.Exists = Vector.GreaterThan(front.LengthSquared(), new Vector<float>(0.5f)) & (b.TwoSidedMask |
            (Vector.GreaterThanOrEqual(height, zero) &
            Vector.GreaterThanOrEqual(Vector3Wide.Dot(normal, front), new Vector<float>(-TriangleFeature.BehindSine))));
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void WriteContacts(in CapsuleWide a, Vector<float> speculativeMargin, in Scratch scratch,
        ref ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        // How far along the normal the segment is from the plane: linear in the place s, as is how far it is then beyond each edge.
        ref readonly var front = ref scratch.Triangle.Front;
        var normal = scratch.Normal;
        var facing = Vector3Wide.Dot(normal, front);
        var inverseFacing = Vector<float>.One / facing;
        var slope = front.Y * inverseFacing;
        var height = scratch.Height * inverseFacing;
        var border = scratch.Size * new Vector<float>(PairTolerances.CapsuleBorder);
        var start = -a.HalfLength;
        var end = a.HalfLength;
        // The sine at a corner is twice the area over the lengths of its sides: at the sharper end of a side, that with the longer of the others.
        Vector<float> ab = scratch.AB.Length, bc = scratch.BC.Length, ca = scratch.CA.Length;
        var sharp = Vector.Abs(Vector3Wide.Dot(scratch.AB.Outward, scratch.Triangle.CA)) * new Vector<float>(SharpSine);
        ClipToSide(scratch.AB, normal, height, slope, border * Wide.Min(ab, sharp / Wide.Max(bc, ca)), ref start, ref end);
        ClipToSide(scratch.BC, normal, height, slope, border * Wide.Min(bc, sharp / Wide.Max(ca, ab)), ref start, ref end);
        ClipToSide(scratch.CA, normal, height, slope, border * Wide.Min(ca, sharp / Wide.Max(ab, bc)), ref start, ref end);
        var isOver = Vector.LessThanOrEqual(start, end) & Vector.GreaterThan(Vector.Abs(facing), new Vector<float>(EdgeOnCosine));

        // The place of the pair's own depth: the lower end of the segment on a face. Where it is beside the face, the nearest place over it is
        // as deep, to rounding, unless a one-sided triangle has refused a shorter way.
        var lowestEnd = Wide.Select(Vector.LessThan(slope, Vector<float>.Zero), a.HalfLength, -a.HalfLength);
        var deepest = Wide.Select(scratch.UseLowestEnd, lowestEnd, scratch.Deepest);
        var deepestOver = Wide.Clamp(deepest, start, end);
        var isAsDeep = isOver & Vector.LessThanOrEqual(Vector.Abs(slope * (deepestOver - deepest)), border);
        deepest = Wide.Select(isAsDeep, deepestOver, deepest);
        start = Wide.Select(isOver, Wide.Min(start, deepest), deepest);
        end = Wide.Select(isOver, Wide.Max(end, deepest), deepest);
        slope = Wide.Mask(isOver, slope);

        var two = Vector.GreaterThan(end - start, (a.HalfLength + a.Radius) * new Vector<float>(PairTolerances.SameContactOnFace));
        var worldNormal = Matrix3x3Wide.TransposeTimes(scratch.Axes, normal);
        manifold.Normal = worldNormal;
        ref readonly var u = ref scratch.Axes.Y;
        ref var first = ref manifold.Contacts[0];
        WriteContact(a.Radius, u, scratch.PairDepth, deepest, slope, Wide.Select(two, start, deepest), worldNormal, ref first);
        first.FeatureId = Vector<int>.Zero;
        first.Exists = scratch.Exists & Vector.GreaterThanOrEqual(first.Depth, -speculativeMargin);
        ref var second = ref manifold.Contacts[1];
        WriteContact(a.Radius, u, scratch.PairDepth, deepest, slope, end, worldNormal, ref second);
        second.FeatureId = Vector<int>.One;
        second.Exists = scratch.Exists & two & Vector.GreaterThanOrEqual(second.Depth, -speculativeMargin);
    }

    /// <summary>Tries the nearest points of the segment and an edge, and the axis across them.</summary>
    /// <param name="start">First corner of the edge.</param>
    /// <param name="edge">From there to the next corner.</param>
    /// <param name="previous">From the corner before to the first.</param>
    /// <param name="halfLength">Half the length of the segment.</param>
    /// <param name="twoSided">All bits set where the triangle has no back.</param>
    /// <param name="scratch">The triangle and what was found so far.</param>
    // The nearest points as in CapsuleCapsuleTester, the edge being the capsule B.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void VisitEdge(in Vector3Wide start, in Vector3Wide edge, in Vector3Wide previous, Vector<float> halfLength, Vector<int> twoSided,
        ref Scratch scratch)
    {
        ref var search = ref scratch.Search;
        ref var triangle = ref scratch.Triangle;
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var acrossSquared = edge.X * edge.X + edge.Z * edge.Z;
        var inverseAcross = one / acrossSquared;
        var squared = acrossSquared + edge.Y * edge.Y;
        var inverseSquared = one / squared;
        var parallel = Vector.LessThan(acrossSquared, squared * new Vector<float>(PairTolerances.ParallelSegment));
        // A parallel segment is equally near all along the stretch that they share: in its middle.
        var shared = Wide.Clamp(start.Y, -halfLength, halfLength) + Wide.Clamp(start.Y + edge.Y, -halfLength, halfLength);
        var away = start.X * edge.X + start.Z * edge.Z;
        var passing = Wide.Select(parallel, shared * new Vector<float>(0.5f), start.Y - edge.Y * (away * inverseAcross));
        passing = Wide.Clamp(passing, -halfLength, halfLength);
        var onEdge = Wide.Clamp(((passing - start.Y) * edge.Y - away) * inverseSquared, zero, one);
        // From the nearest point of the segment, to an inner one of which the way is across it.
        var offset = start + edge * onEdge;
        var place = Wide.Clamp(offset.Y, -halfLength, halfLength);
        offset.Y -= place;
        // To an inner point of the edge, it is across that. What is left along it is rounding, which counts when the two nearly meet.
        var inner = Vector.GreaterThan(onEdge, zero) & Vector.LessThan(onEdge, one);
        offset -= edge * Wide.Mask(inner, Vector3Wide.Dot(offset, edge) * inverseSquared);
        // Along the offset, the nearest corner; the segment is nearer by what its ends rise.
        var corners = Wide.Min(
            Wide.Min(Vector3Wide.Dot(offset, triangle.A), Vector3Wide.Dot(offset, triangle.B)), Vector3Wide.Dot(offset, triangle.C));
        var shown = corners - halfLength * Vector.Abs(offset.Y);
        Keep(offset, offset.Length(), place, shown, Vector<int>.AllBitsSet, ref scratch);

        // Outwards is away from the opposite corner.
        var inward = Wide.CopySign(one, edge.Z * previous.X - edge.X * previous.Z);
        var axisX = edge.Z * inward;
        var axisZ = -edge.X * inward;
        var depth = axisX * start.X + axisZ * start.Z;
        var score = depth * Vector.Abs(depth) * inverseAcross;
        var toFront = axisX * triangle.Front.X + axisZ * triangle.Front.Z;
        var isAllowed = twoSided | Vector.GreaterThanOrEqual(
            toFront * Vector.Abs(toFront), acrossSquared * new Vector<float>(-TriangleFeature.BehindSine * TriangleFeature.BehindSine));
        var better = Vector.AndNot(Vector.LessThan(score, search.AxisScore) & isAllowed, parallel);
        search.AxisX = Wide.Select(better, axisX, search.AxisX);
        search.AxisZ = Wide.Select(better, axisZ, search.AxisZ);
        search.AxisInverseSquared = Wide.Select(better, inverseAcross, search.AxisInverseSquared);
        search.AxisScore = Wide.Select(better, score, search.AxisScore);
        search.AxisPlace = Wide.Select(better, passing, search.AxisPlace);
    }

    /// <summary>Keeps the shorter offset; of two that are equally long to rounding, that along which the shapes are farther apart.</summary>
    // Around the nearest points the distance hardly changes, so it tells them to the square root of its rounding only. How far the shapes are
    // apart along the offset is never more than the distance, and falls short of it as the direction goes wrong. It comes scaled by the
    // offset's length.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Keep(in Vector3Wide offset, Vector<float> distance, Vector<float> place, Vector<float> shown, Vector<int> mask,
        ref Scratch scratch)
    {
        ref var search = ref scratch.Search;
        var tolerance = scratch.Size * new Vector<float>(SameDistance);
        var shorter = Vector.LessThan(distance, search.Distance - tolerance);
        var asShort = Vector.LessThan(distance, search.Distance + tolerance);
        var better = (shorter | (asShort & Vector.GreaterThan(shown * search.Distance, search.Shown * distance))) & mask;
        search.Offset = Vector3Wide.Select(better, offset, search.Offset);
        search.Distance = Wide.Select(better, distance, search.Distance);
        search.Nearest = Wide.Select(better, place, search.Nearest);
        search.Shown = Wide.Select(better, shown, search.Shown);
    }

    /// <summary>Cuts the part of the segment that is over the face to what is on the inner side of an edge.</summary>
    /// <param name="side">The edge.</param>
    /// <param name="normal">Normal of the pair.</param>
    /// <param name="height">Height of the segment's middle over the face, along the normal.</param>
    /// <param name="slope">What is added to that along the segment.</param>
    /// <param name="border">How far beyond the edge still counts as inside, times the edge's length.</param>
    /// <param name="start">Start of the part.</param>
    /// <param name="end">End of the part.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ClipToSide(in Side side, in Vector3Wide normal, Vector<float> height, Vector<float> slope, Vector<float> border,
        ref Vector<float> start, ref Vector<float> end)
    {
        // A segment that moves less than the tolerance of the border over its whole length counts as parallel to it.
        var along = Vector3Wide.Dot(side.Outward, normal);
        var speed = side.Outward.Y - along * slope;
        var least = side.Length * new Vector<float>(PairTolerances.CapsuleBorder);
        var inverse = Vector<float>.One / Wide.CopySign(Wide.Max(Vector.Abs(speed), least), speed);
        var crossing = (border - (side.Beyond - along * height)) * inverse;
        var leaves = Vector.GreaterThan(inverse, Vector<float>.Zero);
        end = Wide.Select(leaves, Wide.Min(end, crossing), end);
        start = Wide.Select(leaves, start, Wide.Max(start, crossing));
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
