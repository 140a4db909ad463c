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
// Everything happens in the triangle's frame. A segment that is apart from the triangle has a nearest point: an end over the face, or the
// nearest to one of the edges. A segment that meets the triangle leaves it along the normal of the face or across the segment and one of
// the edges. Both are computed for every lane. Where the nearest features are the face, or two edges, they agree to rounding, and the axis
// is the better known of the two; elsewhere the distance is greater than what any axis shows.
public readonly unsafe struct CapsuleTriangleTester : IPairTester<CapsuleWide, TriangleWide, Few2<ContactWide>>
{
    const int CacheLine = 64;
    // Part of the size of the pair by which an edge must beat the face, and by which the nearest points must lie beside an axis that shows
    // their distance: rounding is below it.
    const float AxisTolerance = 1e-6f;
    // Squared sine below which the segment is parallel to an edge: at this angle it leaves the edge's line by 3e-6 of its length.
    const float ParallelSineSquared = 1e-11f;
    // How far a normal may point behind a one-sided triangle: a segment across the plane has normals within it, to rounding.
    const float BehindTolerance = 1e-4f;
    // Cosine between the normals of contact and face below which the triangle is met edge on.
    const float EdgeOnCosine = 0.1f;
    // Part of the size of the pair that a segment may be beside the face and still be over it: along the face's border, contacts must not
    // depend on rounding. At the sharpest corner of a triangle that is a hundred times as long as thick, a contact may be a hundred times that
    // beyond it.
    const float BorderTolerance = 3e-6f;
    // Contacts nearer to each other than this part of the capsule's size are one.
    const float MinimumContactDistance = 0.02f;

    // Part by which two squared distances may differ and be the same to rounding.
    const float SameDistance = 4e-6f;

    struct Search
    {
        /// <summary>
        /// From the triangle to the segment where they are nearest, the place there on the segment, and how far apart they are along it.
        /// </summary>
        public Vector3Wide Offset;
        public Vector<float> SquaredDistance, Nearest, Shown;
        /// <summary>The axis of least depth across the segment and an edge, and where the two pass each other.</summary>
        public Vector3Wide AxisNormal;
        public Vector<float> AxisDepth, AxisPlace;
    }

    /// <summary>What the steps of the test hand on, in the triangle's frame.</summary>
    struct Scratch
    {
        public Matrix3x3Wide Axes;
        /// <summary>The segment's middle and direction.</summary>
        public Vector3Wide Center, Direction;
        public Vector3Wide Front;
        public TriangleEdgeWide AB, BC, CA;
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

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly Vector<int> IsOver(in Vector3Wide point) =>
            Vector.LessThanOrEqual(AB.GetBeyond(point), Vector<float>.Zero) & Vector.LessThanOrEqual(BC.GetBeyond(point), Vector<float>.Zero) &
            Vector.LessThanOrEqual(CA.GetBeyond(point), Vector<float>.Zero);
    }

    /// <inheritdoc/>
    // Step by step, each a method of its own: all at once has many times as many values as there are registers.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in CapsuleWide a, in TriangleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        // The runtime aligns the stack to 16 bytes. Vectors that lie across two cache lines are slow, and which do would change with the depth
        // of the stack: so the scratch of the test is put at a cache line, and what is taken from the stack for it brings the frames of the
        // steps to the same place in a line each time, the quickest of the four.
        int anchor;
        var memory = stackalloc byte[(int)((nint)(&anchor) & 48) + 16 + sizeof(Scratch) + CacheLine];
        ref var scratch = ref *(Scratch*)(((nint)memory + CacheLine - 1) & -CacheLine);
        Prepare(a, b, pose, ref scratch);
        VisitEdge(scratch.AB, b.C, a.HalfLength, b.TwoSidedMask, ref scratch);
        VisitEdge(scratch.BC, b.A, a.HalfLength, b.TwoSidedMask, ref scratch);
        VisitEdge(scratch.CA, b.B, a.HalfLength, b.TwoSidedMask, ref scratch);
        ChooseNormal(a, b, ref scratch);
        // No contact is deeper than the pair.
        scratch.Exists &= Vector.GreaterThanOrEqual(scratch.PairDepth, -speculativeMargin);
        if (Vector.EqualsAll(scratch.Exists, Vector<int>.Zero))
        {
            manifold.RemoveContacts();
            return;
        }
        WriteContacts(a, pose, speculativeMargin, scratch, ref manifold);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Prepare(in CapsuleWide a, in TriangleWide b, in PairPoseWide pose, ref Scratch scratch)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.OrientationB);
        scratch.Axes = axes;
        scratch.Center = axes * -pose.OffsetB;
        scratch.Direction = axes * QuaternionWide.TransformUnitY(pose.OrientationA);
        var front = b.GetNormal();
        scratch.Front = front;
        scratch.AB = new(b.A, b.B, front);
        scratch.BC = new(b.B, b.C, front);
        scratch.CA = new(b.C, b.A, front);
        scratch.Size = a.HalfLength + a.Radius +
            Vector.SquareRoot(Wide.Max(Wide.Max(b.A.LengthSquared(), b.B.LengthSquared()), b.C.LengthSquared()));
        scratch.Height = Vector3Wide.Dot(front, scratch.Center - b.A);
        ref var search = ref scratch.Search;
        search.SquaredDistance = search.AxisDepth = new Vector<float>(float.MaxValue);
        search.Nearest = search.AxisPlace = search.Shown = Vector<float>.Zero;
        search.Offset = search.AxisNormal = Vector3Wide.Zero;
    }

    /// <summary>Finds the normal, and what is to be known of the pair for its contacts.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseNormal(in CapsuleWide a, in TriangleWide b, ref Scratch scratch)
    {
        var zero = Vector<float>.Zero;
        ref var search = ref scratch.Search;
        ref var front = ref scratch.Front;
        // The ends over the face, and the segment through it.
        var half = scratch.Direction * a.HalfLength;
        var firstEnd = scratch.Center - half;
        var secondEnd = scratch.Center + half;
        var firstHeight = Vector3Wide.Dot(front, firstEnd - b.A);
        var secondHeight = Vector3Wide.Dot(front, secondEnd - b.A);
        var product = firstHeight * secondHeight;
        Keep(front * firstHeight, -a.HalfLength, Wide.Min(firstHeight * firstHeight, product), scratch.IsOver(firstEnd), ref search);
        Keep(front * secondHeight, a.HalfLength, Wide.Min(secondHeight * secondHeight, product), scratch.IsOver(secondEnd), ref search);
        var crosses = Vector.LessThan(product, zero);
        // Opposite signs: the divisor is not zero.
        var crossing = a.HalfLength * (firstHeight + secondHeight) / (firstHeight - secondHeight);
        crosses &= scratch.IsOver(scratch.Center + scratch.Direction * crossing);
        var nearest = Wide.Select(crosses, crossing, search.Nearest);
        var offset = Vector3Wide.Select(crosses, Vector3Wide.Zero, search.Offset);
        var distance = offset.Length();

        // The face's two normals; a one-sided triangle has the front's only.
        var frontDepth = Wide.Max(-firstHeight, -secondHeight);
        var backDepth = Wide.Max(firstHeight, secondHeight);
        var useBack = Vector.LessThan(backDepth, frontDepth) & b.TwoSidedMask;
        var faceDepth = Wide.Select(useBack, backDepth, frontDepth);
        var faceNormal = Vector3Wide.Select(useBack, -front, front);
        var useEdge = Vector.LessThan(search.AxisDepth + scratch.Size * new Vector<float>(AxisTolerance), faceDepth);
        var coreDepth = Wide.Select(useEdge, search.AxisDepth, faceDepth);
        var normal = Vector3Wide.Select(useEdge, search.AxisNormal, faceNormal);

        var beyondAxis = offset - normal * Wide.Max(-coreDepth, zero);
        var usePoint = Vector.GreaterThan(beyondAxis.Length(), scratch.Size * new Vector<float>(AxisTolerance));
        normal = Vector3Wide.Select(usePoint, offset * (Vector<float>.One / distance), normal);
        scratch.Normal = normal;
        scratch.PairDepth = a.Radius + Wide.Select(usePoint, -distance, coreDepth);
        scratch.Deepest = Wide.Select(usePoint, nearest, search.AxisPlace);
        scratch.UseLowestEnd = ~(usePoint | useEdge);
        // A triangle without area has no front, and no contacts.
        scratch.Exists = Vector.GreaterThan(front.LengthSquared(), new Vector<float>(0.5f)) & (b.TwoSidedMask |
            (Vector.GreaterThanOrEqual(scratch.Height, zero) &
            Vector.GreaterThanOrEqual(Vector3Wide.Dot(normal, front), new Vector<float>(-BehindTolerance))));
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void WriteContacts(in CapsuleWide a, in PairPoseWide pose, Vector<float> speculativeMargin, in Scratch scratch,
        ref ConvexManifoldWide<Few2<ContactWide>> manifold)
    {
        // How far along the normal the segment is from the plane: linear in the place s, as is how far it is then beyond each edge.
        var normal = scratch.Normal;
        var facing = Vector3Wide.Dot(normal, scratch.Front);
        var inverseFacing = Vector<float>.One / facing;
        var slope = Vector3Wide.Dot(scratch.Direction, scratch.Front) * inverseFacing;
        var onFace = scratch.Center - normal * (scratch.Height * inverseFacing);
        var alongFace = scratch.Direction - normal * slope;
        var border = scratch.Size * new Vector<float>(BorderTolerance);
        var start = -a.HalfLength;
        var end = a.HalfLength;
        ClipToEdge(scratch.AB, onFace, alongFace, border, ref start, ref end);
        ClipToEdge(scratch.BC, onFace, alongFace, border, ref start, ref end);
        ClipToEdge(scratch.CA, onFace, alongFace, border, ref start, ref end);
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

        var two = Vector.GreaterThan(end - start, (a.HalfLength + a.Radius) * new Vector<float>(MinimumContactDistance));
        var u = QuaternionWide.TransformUnitY(pose.OrientationA);
        var worldNormal = Matrix3x3Wide.TransposeTimes(scratch.Axes, normal);
        manifold.Normal = worldNormal;
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
    // The nearest points as in CapsuleCapsuleTester, the edge being the capsule B.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void VisitEdge(in TriangleEdgeWide edge, in Vector3Wide opposite, Vector<float> halfLength, Vector<int> twoSided, ref Scratch scratch)
    {
        ref var search = ref scratch.Search;
        ref var center = ref scratch.Center;
        ref var direction = ref scratch.Direction;
        var zero = Vector<float>.Zero;
        var toStart = edge.Start - center;
        var toEnd = toStart + edge.Direction * edge.Length;
        var toOpposite = opposite - center;
        var cosine = Vector3Wide.Dot(direction, edge.Direction);
        // The part of the edge across the segment first, so that the cross product stays across the segment at small angles: an error in
        // the other direction only turns the axis around the segment.
        var across = edge.Direction - direction * cosine;
        across -= direction * Vector3Wide.Dot(direction, across);
        var cross = Vector3Wide.Cross(direction, across);
        var sineSquared = cross.LengthSquared();
        var parallel = Vector.LessThan(sineSquared, new Vector<float>(ParallelSineSquared));
        var inverseSquared = Vector<float>.One / sineSquared;
        var alongSegment = Vector3Wide.Dot(toStart, direction);
        var alongEdge = Vector3Wide.Dot(toStart, edge.Direction);
        var passing = Vector3Wide.Dot(Vector3Wide.Cross(toStart, edge.Direction), cross) * inverseSquared;
        // A parallel segment is equally near all along the stretch that they share: in its middle.
        var other = alongSegment + edge.Length * cosine;
        var shared = Wide.Clamp(alongSegment, -halfLength, halfLength) + Wide.Clamp(other, -halfLength, halfLength);
        passing = Wide.Clamp(Wide.Select(parallel, shared * new Vector<float>(0.5f), passing), -halfLength, halfLength);
        var onEdge = Wide.Clamp(passing * cosine - alongEdge, zero, edge.Length);
        var place = Wide.Clamp(alongSegment + onEdge * cosine, -halfLength, halfLength);
        var offset = direction * place - toStart - edge.Direction * onEdge;
        // Between inner points the way is across both. What is left along them is rounding, which counts when the segments nearly meet.
        var innerSegment = Vector.LessThan(Vector.Abs(place), halfLength);
        var innerEdge = Vector.GreaterThan(onEdge, zero) & Vector.LessThan(onEdge, edge.Length);
        offset -= direction * Wide.Mask(innerSegment, Vector3Wide.Dot(offset, direction));
        offset -= edge.Direction * Wide.Mask(innerEdge, Vector3Wide.Dot(offset, edge.Direction));
        // Along the offset, the edge's start, its end, and the opposite corner; the segment is nearer by what its ends fall.
        var corners = Wide.Max(Wide.Max(Vector3Wide.Dot(offset, toStart), Vector3Wide.Dot(offset, toEnd)), Vector3Wide.Dot(offset, toOpposite));
        var shown = -corners - halfLength * Vector.Abs(Vector3Wide.Dot(offset, direction));
        Keep(offset, place, shown, Vector<int>.AllBitsSet, ref search);

        // Outwards is away from the opposite corner.
        var axis = cross * Vector.SquareRoot(inverseSquared);
        var isInward = Vector.GreaterThan(Vector3Wide.Dot(axis, toOpposite - toStart), zero);
        axis = Vector3Wide.Select(isInward, -axis, axis);
        var depth = Vector3Wide.Dot(axis, toStart);
        var isAllowed = twoSided | Vector.GreaterThanOrEqual(Vector3Wide.Dot(axis, scratch.Front), new Vector<float>(-BehindTolerance));
        var better = Vector.AndNot(Vector.LessThan(depth, search.AxisDepth) & isAllowed, parallel);
        search.AxisNormal = Vector3Wide.Select(better, axis, search.AxisNormal);
        search.AxisDepth = Wide.Select(better, depth, search.AxisDepth);
        search.AxisPlace = Wide.Select(better, passing, search.AxisPlace);
    }

    /// <summary>Keeps the shorter offset; of two that are equally long to rounding, that along which the shapes are farther apart.</summary>
    // Around the nearest points the distance hardly changes, so it tells them to the square root of its rounding only. How far the shapes are
    // apart along the offset, scaled by its length here, is never more than the distance, and falls short of it as the direction goes wrong.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Keep(in Vector3Wide offset, Vector<float> place, Vector<float> shown, Vector<int> mask, ref Search search)
    {
        var squared = offset.LengthSquared();
        var shorter = Vector.LessThan(squared, search.SquaredDistance * new Vector<float>(1 - SameDistance));
        var asShort = Vector.LessThan(squared, search.SquaredDistance * new Vector<float>(1 + SameDistance));
        var better = (shorter | (asShort & Vector.GreaterThan(shown, search.Shown))) & mask;
        search.Offset = Vector3Wide.Select(better, offset, search.Offset);
        search.SquaredDistance = Wide.Select(better, squared, search.SquaredDistance);
        search.Nearest = Wide.Select(better, place, search.Nearest);
        search.Shown = Wide.Select(better, shown, search.Shown);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void ClipToEdge(in TriangleEdgeWide edge, in Vector3Wide point, in Vector3Wide velocity, Vector<float> border,
        ref Vector<float> start, ref Vector<float> end)
    {
        // A segment that moves less than the tolerance of the border over its whole length counts as parallel to it.
        var speed = Vector3Wide.Dot(edge.Outward, velocity);
        var inverse = Vector<float>.One / Wide.CopySign(Wide.Max(Vector.Abs(speed), new Vector<float>(BorderTolerance)), speed);
        var crossing = (border - edge.GetBeyond(point)) * inverse;
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
