using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Contacts along a direction that no search has found: there is no witness, and where the features do not overlap there is no contact. A point that
// no corner of a feature shows, the lowest of a rim or of a capsule that stands, is one if it is over the other feature.
public static unsafe partial class FaceManifold<TShapeWideA, TFeatureA, TShapeWideB, TFeatureB>
{
    // Part of a shape's size below which a segment is a point.
    const float ShortestSegment = 1e-5f;

    /// <summary>Finds the contacts of a bundle of pairs along directions that are given.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="localOffsetB">Positions of B in A's frame.</param>
    /// <param name="localOrientationB">Axes of B in A's frame, in the rows.</param>
    /// <param name="normal">Unit directions in A's frame, from B to A.</param>
    /// <param name="depth">By how much A has to move along the direction to be off B, m.</param>
    /// <param name="origin">
    /// A point on the plane across the direction that supports A. Of a round A the point of its surface that is there, else of a round B the point
    /// of that plane beside B's outermost; otherwise any, and the nearer to the contacts, the less rounding.
    /// </param>
    /// <param name="wanted">All bits set where contacts are wanted; the other lanes may hold anything.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists, m; zero or more.</param>
    /// <param name="orientationA">Axes of A in the world, in the rows.</param>
    /// <param name="manifold">The contacts. None is deeper than the pair; the deepest may be less deep.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void BuildAlong(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
        in Vector3Wide normal, Vector<float> depth, in Vector3Wide origin, Vector<int> wanted, Vector<float> speculativeMargin,
        in Matrix3x3Wide orientationA, out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        manifold.RemoveContacts();
        var normalB = localOrientationB * normal;
        var exists = wanted & Vector.GreaterThanOrEqual(depth, -speculativeMargin) &
            ~(TFeatureA.RejectsNormal(a, -normal) | TFeatureB.RejectsNormal(b, normalB));
        if (Vector.EqualsAll(exists, Vector<int>.Zero))
            return;
        var memory = stackalloc byte[AlignedScratch.SizeFor<Scratch>() + Scratch.ArraysByteCount];
        ref var scratch = ref AlignedScratch.Align<Scratch>(memory);
        ref var overlap = ref scratch.Overlap;
        overlap.PairDepth = depth;
        overlap.MinimumDepth = -speculativeMargin;
        scratch.FrameA.Origin = origin;
        scratch.Project(a, b, localOffsetB, localOrientationB, normal, normalB, exists);
        if (TFeatureA.MaximumVertexCount == 1 || TFeatureB.MaximumVertexCount == 1)
            overlap.CandidateCount = 0;
        else
            FindCandidates(ref overlap, exists);
        // The pair is as deep as its deepest corner, so that the origin takes the place of none but where it is deeper.
        var deepest = new Vector<float>(IContactCandidate.None);
        if (TFeatureA.IsRound)
            deepest = DepthAtOrigin<TFeatureB, TShapeWideB>(overlap, overlap.B, Vector<float>.Zero);
        else if (TFeatureB.IsRound)
            deepest = DepthAtOrigin<TFeatureA, TShapeWideA>(overlap, overlap.A, depth);
        for (int i = 0; i < overlap.CandidateCount; ++i)
            deepest = Wide.Max(deepest, overlap.Candidates[i].Depth);
        exists &= Vector.GreaterThan(deepest, new Vector<float>(IContactCandidate.None));
        overlap.PairDepth = deepest;
        var remembered = Vector<int>.Zero;
        FaceReduction.Reduce(overlap, scratch.FrameA, orientationA, exists, ref remembered, ref manifold);
    }

    // A capsule without a length has no line that another could lie along.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void FindCandidates(ref FaceOverlap overlap, Vector<int> exists)
    {
        var shortest = new Vector<float>(ShortestSegment);
        var (isSegmentA, isSegmentB) = (overlap.A.IsSegment, overlap.B.IsSegment);
        overlap.A.IsSegment &= Vector.GreaterThan(overlap.A.Extent, overlap.A.Feature.Size * shortest);
        overlap.B.IsSegment &= Vector.GreaterThan(overlap.B.Extent, overlap.B.Feature.Size * shortest);
        overlap.FindCandidates(exists, TFeatureA.IsDisc, TFeatureB.IsDisc);
        overlap.A.IsSegment = isSegmentA;
        overlap.B.IsSegment = isSegmentB;
    }

    /// <summary>Depth at the origin of the frame, where that is over a feature; none elsewhere.</summary>
    /// <param name="overlap">The features.</param>
    /// <param name="feature">The one of the two that may be below the point.</param>
    /// <param name="height">Height of the point over the frame, m.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> DepthAtOrigin<TFeature, TShapeWide>(in FaceOverlap overlap, in FacePolygon feature, Vector<float> height)
        where TShapeWide : unmanaged where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        var zero = Vector<float>.Zero;
        var border = Wide.Max(overlap.A.Feature.Size, overlap.B.Feature.Size) * new Vector<float>(FaceOverlap.BorderRounding);
        // Beside the middle of what is round by this part of its radius, the surface is as high as there.
        var radius = Wide.Max(feature.Feature.Roundness, feature.Feature.Margin);
        var deviation = Wide.Max(border, radius * new Vector<float>(FaceOverlap.SideDeviation));
        ref var first = ref feature.Vertices[0];
        Vector<int> holds;
        if (TFeature.MaximumVertexCount == 1)
        {
            holds = Vector.LessThan(first.X * first.X + first.Y * first.Y, deviation * deviation);
            height += first.Height;
        }
        else
        {
            holds = feature.IsSegment & IsAtOrigin(first, deviation);
            if (TFeature.MaximumVertexCount > 2)
                holds |= feature.IsPolygon & (TFeature.IsDisc ? feature.Disc.Holds(zero, zero, -border) : HoldsOrigin(feature, border));
            height += feature.SlopeHeight;
        }
        var depth = Wide.Min(height, overlap.PairDepth);
        return Wide.Select(holds & Vector.GreaterThanOrEqual(depth, overlap.MinimumDepth), depth, new Vector<float>(IContactCandidate.None));
    }

    // A segment may be a point in this view.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsAtOrigin(in FaceVertex segment, Vector<float> deviation)
    {
        var (x, y) = (segment.EdgeX, segment.EdgeY);
        var along = Wide.DivideOrZero(-(segment.X * x + segment.Y * y), x * x + y * y);
        along = Wide.Clamp(along, Vector<float>.Zero, Vector<float>.One);
        var nearestX = segment.X + x * along;
        var nearestY = segment.Y + y * along;
        return Vector.LessThanOrEqual(nearestX * nearestX + nearestY * nearestY, deviation * deviation);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> HoldsOrigin(in FacePolygon polygon, Vector<float> border)
    {
        var inside = new Vector<float>(float.MaxValue);
        for (int i = 0; i < polygon.Count; ++i)
            inside = Wide.Min(inside, polygon.Vertices[i].LineOffset);
        return Vector.GreaterThanOrEqual(inside, -border);
    }
}
