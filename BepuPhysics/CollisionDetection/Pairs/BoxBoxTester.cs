using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Box against box: the separating axis of least depth, then the overlap of the two faces that look along it, seen along it, and up to
/// four of the corners of that overlap.
/// </summary>
/// <remarks>
/// Boxes that are apart at a corner and an edge, at two corners, or at two parallel edges, have no axis that shows the whole distance, and
/// their faces do not overlap along it. These take the way between their nearest points for the normal.
/// </remarks>
// Three steps, in A's frame, each a method of its own, so that each has the registers to itself: BoxAxes finds the normal, BoxFaces turns
// the faces into a rectangle and a parallelogram and finds the corners of their overlap, ContactReduction keeps four.
// The reference face is always one of A's, whether the normal belongs to it or not: depth is linear over B's face, and measured along the
// normal. So face contacts and edge contacts are one case, and what turns from the one into the other does so without a jump.
// Where boxes are apart and have no contact, or none as near as the axis says, the same is done once more for the way between the nearest
// points.
public readonly unsafe struct BoxBoxTester : IPairTester<BoxWide, BoxWide, Few4<ContactWide>>
{
    // Part of the smaller box by which the deepest contact may be farther than the axis says: faces that are slightly tilted keep their
    // normal. Boxes nearer than that keep their axis, as rounding, of which the larger box has more, leaves no direction of a shorter way.
    const float NearestTolerance = 5e-4f;
    const float NearestRounding = 2e-6f;

    struct Scratch
    {
        public BoxFaces Faces;
        public ContactCandidates Candidates;
        // So that there is room where the first cache line begins.
        public fixed byte Padding[AlignedScratch.CacheLine];
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in BoxWide a, in BoxWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        Unsafe.SkipInit(out Scratch unaligned);
        ref var scratch = ref AlignedScratch.Align<Scratch>(&unaligned);
        ref var faces = ref scratch.Faces;
        pose.GetLocal(out faces.AxesA, out faces.AxesB, out faces.OffsetB);
        BoxAxes.FindLeastDepth(a, b, faces.AxesB, faces.OffsetB, out faces.PairDepth, out faces.Normal);
        var touching = Vector.GreaterThanOrEqual(faces.PairDepth, -speculativeMargin);
        if (Vector.EqualsAll(touching, Vector<int>.Zero))
        {
            manifold.RemoveContacts();
            return;
        }
        faces.Project(a, b);
        faces.FindCandidates(ref scratch.Candidates);
        scratch.Candidates.Reduce(faces, touching, speculativeMargin, ref manifold);
        var sizeA = a.HalfWidth + a.HalfHeight + a.HalfLength;
        var sizeB = b.HalfWidth + b.HalfHeight + b.HalfLength;
        var tolerance = new Vector<float>(NearestTolerance) * Wide.Min(sizeA, sizeB) + new Vector<float>(NearestRounding) * Wide.Max(sizeA, sizeB);
        ref var deepest = ref manifold.Contacts[0];
        var apart = Vector.AndNot(touching & Vector.LessThan(faces.PairDepth, Vector<float>.Zero),
            deepest.Exists & Vector.GreaterThanOrEqual(deepest.Depth, faces.PairDepth - tolerance));
        if (!Vector.EqualsAll(apart, Vector<int>.Zero))
            TestApart(a, b, apart, tolerance, speculativeMargin, ref scratch, ref manifold);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void TestApart(in BoxWide a, in BoxWide b, Vector<int> apart, Vector<float> tolerance, Vector<float> speculativeMargin,
        ref Scratch scratch, ref ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        ref var faces = ref scratch.Faces;
        BoxNearest.Find(a, b, faces.AxesB, faces.OffsetB, out var nearest);
        var distance = Vector.SquareRoot(nearest.DistanceSquared);
        var way = nearest.Way * (-Vector<float>.One / distance);
        // No axis separates by more than the distance, and the way by all of it. Short ways of long boxes are turned by rounding so far that
        // it is less than by the axis, or not at all; these keep the axis, and see the distance along it.
        var depthAlongWay = Vector3Wide.Dot(way, faces.OffsetB) + HalfExtent(a, way) + HalfExtent(b, faces.AxesB * way);
        var hasWay = Vector.GreaterThan(distance, tolerance) & Vector.LessThanOrEqual(depthAlongWay, faces.PairDepth);
        faces.Normal = Vector3Wide.Select(hasWay, way, faces.Normal);
        faces.PairDepth = -distance;
        var near = apart & Vector.GreaterThanOrEqual(faces.PairDepth, -speculativeMargin);
        Unsafe.SkipInit(out ConvexManifoldWide<Few4<ContactWide>> found);
        faces.Project(a, b);
        faces.FindCandidates(ref scratch.Candidates);
        scratch.Candidates.Reduce(faces, near, speculativeMargin, ref found);
        // Between a corner and an edge there is no overlap, or by rounding another than the nearest points.
        ref var first = ref found.Contacts[0];
        var lost = near & Vector.LessThan(first.Depth, faces.PairDepth - tolerance);
        var middle = Matrix3x3Wide.TransposeTimes(faces.AxesA, nearest.OnA + nearest.Way * new Vector<float>(0.5f));
        first.OffsetA = Vector3Wide.Select(lost, middle, first.OffsetA);
        first.Depth = Wide.Select(lost, faces.PairDepth, first.Depth);
        first.FeatureId = Wide.Select(lost, faces.FaceFeature | new Vector<int>(ContactCandidates.Count), first.FeatureId);
        first.Exists |= lost;
        manifold.Normal = Vector3Wide.Select(apart, found.Normal, manifold.Normal);
        for (int i = 0; i < Few4<ContactWide>.Count; ++i)
        {
            ref var from = ref found.Contacts[i];
            ref var to = ref manifold.Contacts[i];
            to.OffsetA = Vector3Wide.Select(apart, from.OffsetA, to.OffsetA);
            to.Depth = Wide.Select(apart, from.Depth, to.Depth);
            to.FeatureId = Wide.Select(apart, from.FeatureId, to.FeatureId);
            to.Exists = Wide.Select(apart, from.Exists, to.Exists);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> HalfExtent(in BoxWide box, in Vector3Wide localDirection) =>
        Vector3Wide.Dot(Vector3Wide.Abs(localDirection), new(box.HalfWidth, box.HalfHeight, box.HalfLength));
}
