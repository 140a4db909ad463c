using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Up to four contacts of convex pairs whose normal, depth and witness are known.</summary>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TFeatureA">Features of A.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TFeatureB">Features of B.</typeparam>
public static unsafe partial class FaceManifold<TShapeWideA, TFeatureA, TShapeWideB, TFeatureB>
    where TShapeWideA : unmanaged where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
    where TShapeWideB : unmanaged where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
{
    /// <summary>Finds the contacts of a bundle of pairs of which nothing is remembered.</summary>
    /// <inheritdoc cref="Build(in TShapeWideA, in TShapeWideB, in Vector3Wide, in Matrix3x3Wide, in Vector3Wide, Vector{float},
    /// in Vector3Wide, Vector{int}, Vector{float}, in Matrix3x3Wide, ref Vector{int}, out ConvexManifoldWide{Few4{ContactWide}})"/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Build(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
        in Vector3Wide normal, Vector<float> depth, in Vector3Wide pointOnA, Vector<int> near, Vector<float> speculativeMargin,
        in Matrix3x3Wide orientationA, out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        var remembered = Vector<int>.Zero;
        Build(a, b, localOffsetB, localOrientationB, normal, depth, pointOnA, near, speculativeMargin, orientationA, ref remembered, out manifold);
    }

    /// <summary>Finds the contacts of a bundle of pairs.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="localOffsetB">Positions of B in A's frame.</param>
    /// <param name="localOrientationB">Axes of B in A's frame, in the rows.</param>
    /// <param name="normal">Unit normals in A's frame, from B to A: the directions of least depth.</param>
    /// <param name="depth">Depths along the normals, m, the margins of rounded shapes included.</param>
    /// <param name="pointOnA">A point of each A's surface that is as deep in B, in A's frame.</param>
    /// <param name="near">All bits set where there may be contacts; the other lanes may hold anything.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists, m; zero or more.</param>
    /// <param name="orientationA">Axes of A in the world, in the rows.</param>
    /// <param name="remembered">
    /// What <see cref="DepthSearchState.Contacts"/> holds: two corners that are preferred to others that are as good; zero for a pair that is new.
    /// Pairs without contacts leave it as it is.
    /// </param>
    /// <param name="manifold">The contacts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Build(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
        in Vector3Wide normal, Vector<float> depth, in Vector3Wide pointOnA, Vector<int> near, Vector<float> speculativeMargin,
        in Matrix3x3Wide orientationA, ref Vector<int> remembered, out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var normalB = localOrientationB * normal;
        var exists = near & Vector.GreaterThanOrEqual(depth, -speculativeMargin) &
            ~(TFeatureA.RejectsNormal(a, -normal) | TFeatureB.RejectsNormal(b, normalB));
        manifold.Contacts[0].Exists = exists;
        manifold.Contacts[1].Exists = Vector<int>.Zero;
        manifold.Contacts[2].Exists = Vector<int>.Zero;
        manifold.Contacts[3].Exists = Vector<int>.Zero;
        if (Vector.EqualsAll(exists, Vector<int>.Zero))
            return;
        if (TFeatureA.MaximumVertexCount == 1 || (TFeatureB.MaximumVertexCount == 1 && !TFeatureB.IsPlane))
        {
            manifold.Normal = Matrix3x3Wide.TransposeTimes(orientationA, normal);
            ref var contact = ref manifold.Contacts[0];
            var point = pointOnA;
            if (TFeatureA.IsCurved)
                point = Touching<TShapeWideA, TFeatureA>(a, -normal, exists);
            else if (TFeatureB.IsCurved)
                point = localOffsetB + Matrix3x3Wide.TransposeTimes(localOrientationB, Touching<TShapeWideB, TFeatureB>(b, normalB, exists)) - normal * depth;
            contact.OffsetA = Matrix3x3Wide.TransposeTimes(orientationA, point + normal * (depth * new Vector<float>(0.5f)));
            contact.Depth = depth;
            contact.FeatureId = Vector<int>.Zero;
            return;
        }

        var memory = stackalloc byte[AlignedScratch.SizeFor<Scratch>() + Scratch.ArraysByteCount];
        ref var scratch = ref AlignedScratch.Align<Scratch>(memory);
        ref var overlap = ref scratch.Overlap;
        overlap.PairDepth = depth;
        overlap.MinimumDepth = -speculativeMargin;
        scratch.FrameA.Origin = pointOnA;
        scratch.Project(a, b, localOffsetB, localOrientationB, normal, normalB, exists);
        if (TFeatureB.IsPlane)
            overlap.TakeAllOfA(exists);
        else
            overlap.FindCandidates(exists, TFeatureA.IsDisc, TFeatureB.IsDisc);
        FaceReduction.Reduce(overlap, scratch.FrameA, orientationA, exists, ref remembered, ref manifold);
    }

    // The point of a curved surface that is farthest along a direction.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector3Wide Touching<TShapeWide, TFeature>(in TShapeWide shape, in Vector3Wide direction, Vector<int> exists)
        where TShapeWide : unmanaged where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        Unsafe.SkipInit(out Vector3Wide vertex);
        TFeature.Find(shape, direction, ~exists, ref vertex, out var feature);
        return vertex + direction * feature.Margin;
    }

    /// <summary>What a bundle is worked on in; arrays follow it, the ones that are always used first.</summary>
    struct Scratch
    {
        public FaceFrame FrameA, FrameB;
        public FaceOverlap Overlap;
        // Fills up the two words at the end of the overlap.
        public fixed byte Padding[AlignedScratch.CacheLine - 2 * sizeof(long)];

        static int GreatestCount =>
            TFeatureA.MaximumVertexCount > TFeatureB.MaximumVertexCount ? TFeatureA.MaximumVertexCount : TFeatureB.MaximumVertexCount;

        static int CandidateCount => FaceOverlap.GreatestCount(TFeatureA.MaximumVertexCount, TFeatureB.MaximumVertexCount);

        public static int ArraysByteCount => GreatestCount * sizeof(Vector3Wide) + CandidateCount * sizeof(FaceCandidate) +
            (TFeatureA.MaximumVertexCount + TFeatureB.MaximumVertexCount) * sizeof(FaceVertex);

        public readonly FaceVertex* VerticesA
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => (FaceVertex*)((Scratch*)Unsafe.AsPointer(ref Unsafe.AsRef(in this)) + 1);
        }

        public readonly FaceVertex* VerticesB
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => VerticesA + TFeatureA.MaximumVertexCount;
        }

        public readonly Vector3Wide* Points
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => (Vector3Wide*)(VerticesB + TFeatureB.MaximumVertexCount);
        }

        public readonly FaceCandidate* Candidates
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => (FaceCandidate*)(Points + GreatestCount);
        }

        /// <summary>Finds the features that face each other along the normal, seen from the origin of A's frame.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Project(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
            in Vector3Wide normal, in Vector3Wide normalB, Vector<int> exists)
        {
            var points = Points;
            Overlap.Candidates = Candidates;
            Vector3Wide.BuildOrthonormalBasis(normal, out FrameA.X, out FrameA.Y);
            FrameA.Outwards = -normal;
            TFeatureA.Find(a, FrameA.Outwards, ~exists, ref *points, out Overlap.A.Feature);
            Overlap.A.List.First = VerticesA;
            Overlap.A.List.Count = CountVertices<TFeatureA, TShapeWideA>(Overlap.A.Feature.VertexCount, exists);
            Project<TFeatureA, TShapeWideA>(a, points, FrameA, -1, ref Overlap.A);
            if (TFeatureB.IsPlane)
                return;

            FrameB.X = localOrientationB * FrameA.X;
            FrameB.Y = localOrientationB * FrameA.Y;
            FrameB.Outwards = normalB;
            FrameB.Origin = localOrientationB * (FrameA.Origin - localOffsetB);
            TFeatureB.Find(b, FrameB.Outwards, ~exists, ref *points, out Overlap.B.Feature);
            Overlap.B.List.First = VerticesB;
            Overlap.B.List.Count = CountVertices<TFeatureB, TShapeWideB>(Overlap.B.Feature.VertexCount, exists);
            Project<TFeatureB, TShapeWideB>(b, points, FrameB, 1, ref Overlap.B);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        static void Project<TFeature, TShapeWide>(in TShapeWide shape, Vector3Wide* points, in FaceFrame frame, float winding, ref FacePolygon polygon)
            where TShapeWide : unmanaged where TFeature : unmanaged, IContactFeature<TShapeWide>
        {
            if (TFeature.IsDisc)
                polygon.ProjectDisc(points, TFeature.DiscRadius(shape), frame);
            else
                polygon.Project(points, frame, winding);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static int CountVertices<TFeature, TShapeWide>(Vector<int> counts, Vector<int> exists)
        where TShapeWide : unmanaged where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        // Segments, triangles and boxes have as many as they can.
        if (TFeature.MaximumVertexCount <= 4)
            return TFeature.MaximumVertexCount;
        counts &= exists;
        var greatest = 1;
        for (int lane = 0; lane < Vector<int>.Count; ++lane)
            greatest = counts[lane] > greatest ? counts[lane] : greatest;
        return greatest;
    }
}
