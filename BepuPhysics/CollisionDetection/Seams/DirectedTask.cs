using System;
using System.Diagnostics;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Looks at pairs of two convex shape types along directions that are given.</summary>
unsafe interface IDirectedTask
{
    /// <summary>Looks at all pairs of a batch, and empties it.</summary>
    /// <param name="batch">The pairs; their ids are places in the list.</param>
    /// <param name="pairs">Directions, and where the results go.</param>
    void Execute(ref PairBatch batch, DirectedPair* pairs);
}

/// <summary>Finds depth and contacts of pairs along directions, from nothing but farthest points and features.</summary>
/// <typeparam name="TShapeA">First shape; its type id is no greater than that of the second.</typeparam>
/// <typeparam name="TShapeWideA">Wide form of the first shape.</typeparam>
/// <typeparam name="TSupportA">Farthest points of A.</typeparam>
/// <typeparam name="TFeatureA">Features of A.</typeparam>
/// <typeparam name="TShapeB">Second shape.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of the second shape.</typeparam>
/// <typeparam name="TSupportB">Farthest points of B.</typeparam>
/// <typeparam name="TFeatureB">Features of B.</typeparam>
// A task like those that test pairs: it shares how pairs are written to lanes and contacts read from them, whichever of the two types is the caller's A.
sealed unsafe class DirectedTask<TShapeA, TShapeWideA, TSupportA, TFeatureA, TShapeB, TShapeWideB, TSupportB, TFeatureB>()
    : ConvexPairTask<TShapeA, TShapeWideA, TShapeB, TShapeWideB, Few4<ContactWide>>(keepsHistories: false), IDirectedTask
    where TShapeA : unmanaged, IConvexShape where TShapeWideA : unmanaged, IShapeWide<TShapeA>
    where TSupportA : unmanaged, ISupport<TShapeWideA> where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
    where TShapeB : unmanaged, IConvexShape where TShapeWideB : unmanaged, IShapeWide<TShapeB>
    where TSupportB : unmanaged, ISupport<TShapeWideB> where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
{
    // Cosine of 1e-2 rad: what has moved along one of two directions has moved as far along the other, to 5e-5.
    const float NearCosine = 1 - 5e-5f;

    internal override void Write(ref PairBatch batch, Shapes shapes, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, in PairInput pair)
    {
        Find(shapes, shapeIndexA, shapeIndexB, out var shapeA, out var shapeB);
        WriteDirectly(ref batch, shapeA, shapeB, offsetB, orientationA, orientationB, pair);
    }

    internal override void WriteDirectly(ref PairBatch batch, void* shapeA, void* shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, in PairInput pair)
    {
        Write(ref batch, (TShapeA*)shapeA, (TShapeB*)shapeB, offsetB, orientationA, orientationB, pair, needsOrientationA: true, needsOrientationB: true);
    }

    internal override void Execute<TCallbacks>(ref PairBatch batch, PairHistory* histories, ref TCallbacks callbacks) =>
        throw new UnreachableException();

    public void Execute(ref PairBatch batch, DirectedPair* pairs)
    {
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            ref var bundle = ref Bundles(batch)[start >> BundleIndexing.VectorShift];
            Execute(ref bundle, ref Manifold(batch), pairs, Math.Min(Vector<float>.Count, batch.Count - start));
        }
        batch.Count = 0;
    }

    static void Execute(ref PairBundle<TShapeWideA, TShapeWideB> bundle, ref ConvexManifoldWide<Few4<ContactWide>> wide, DirectedPair* pairs, int count)
    {
        var done = Vector<int>.AllBitsSet;
        var normal = Vector3Wide.Zero;
        var greatest = Vector<float>.Zero;
        var (findsFaceOfA, findsFaceOfB) = (false, false);
        for (int lane = 0; lane < count; ++lane)
        {
            ref var pair = ref pairs[Lane(ref bundle.PairIds, lane)];
            Lanes.Write(Lane(ref bundle.FlipMask, lane) != 0 ? -pair.Normal : pair.Normal, ref normal, lane);
            Lane(ref greatest, lane) = pair.GreatestDepth;
            var isFlipped = Lane(ref bundle.FlipMask, lane) != 0;
            findsFaceOfA |= isFlipped ? pair.FindsFaceOfB : pair.FindsFaceOfA;
            findsFaceOfB |= isFlipped ? pair.FindsFaceOfA : pair.FindsFaceOfB;
            Lane(ref done, lane) = 0;
        }
        bundle.Pose.GetLocal(out var axesA, out var localAxesB, out var localOffsetB);
        var localNormal = axesA * normal;
        DirectionalDepth<TShapeWideA, TSupportA, TShapeWideB, TSupportB>.Measure(
            bundle.A, bundle.B, localOffsetB, localAxesB, localNormal, TakesPointOfB(bundle.A, bundle.B), done, out var depth, out var point);
        var least = depth;
        // Where the direction itself has decided no other is looked along.
        var isOpen = Vector.AndNot(~Vector.LessThanOrEqual(depth, greatest), done);
        var looksOn = Vector.LessThanAny(isOpen, Vector<int>.Zero);
        var (faceOfA, faceOfB) = (localNormal, localNormal);
        if (TFeatureA.MaximumVertexCount > 2 && (looksOn || findsFaceOfA))
            faceOfA = -Facing<TShapeWideA, TFeatureA>(bundle.A, -localNormal, done);
        if (TFeatureB.MaximumVertexCount > 2 && (looksOn || findsFaceOfB))
            faceOfB = Matrix3x3Wide.TransposeTimes(localAxesB, Facing<TShapeWideB, TFeatureB>(bundle.B, localAxesB * localNormal, done));
        if (TFeatureA.MaximumVertexCount > 2 && looksOn)
            MeasureAlong(bundle.A, bundle.B, localOffsetB, localAxesB, faceOfA, done, ref least);
        if (TFeatureB.MaximumVertexCount > 2 && looksOn)
            MeasureAlong(bundle.A, bundle.B, localOffsetB, localAxesB, faceOfB, done, ref least);
        var isWithin = Vector.AndNot(Vector.LessThanOrEqual(least, greatest), done);
        FaceManifold<TShapeWideA, TFeatureA, TShapeWideB, TFeatureB>.BuildAlong(bundle.A, bundle.B, localOffsetB, localAxesB, localNormal, depth,
            point, isWithin, bundle.SpeculativeMargin, axesA, out wide);
        for (int lane = 0; lane < count; ++lane)
        {
            ref var pair = ref pairs[Lane(ref bundle.PairIds, lane)];
            pair.Depth = Lane(ref depth, lane);
            pair.IsWithinDepth = Lane(ref isWithin, lane) != 0;
            Read(ref wide, ref bundle, lane, ref pair.Manifold);
            if (pair.FindsFaceOfA | pair.FindsFaceOfB)
                ReadFace(ref bundle, lane, axesA, faceOfA, faceOfB, ref pair);
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ReadFace(ref PairBundle<TShapeWideA, TShapeWideB> bundle, int lane, in Matrix3x3Wide axesA, in Vector3Wide faceOfA, in Vector3Wide faceOfB,
        ref DirectedPair pair)
    {
        var isFlipped = Lane(ref bundle.FlipMask, lane) != 0;
        var face = Matrix3x3Wide.TransposeTimes(axesA, pair.FindsFaceOfA != isFlipped ? faceOfA : faceOfB);
        pair.Face = Lanes.Read<Vector3, Vector3Wide>(ref face, lane);
        if (isFlipped)
            pair.Face = -pair.Face;
    }

    // The unit normal of the face that faces a direction; the direction itself where there is none that is nearly across it.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector3Wide Facing<TShapeWide, TFeature>(in TShapeWide shape, in Vector3Wide direction, Vector<int> done)
        where TShapeWide : unmanaged where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        var vertices = stackalloc Vector3Wide[TFeature.MaximumVertexCount];
        TFeature.Find(shape, direction, done, ref *vertices, out var feature);
        var normal = feature.PlaneNormal * (Vector<float>.One / feature.PlaneNormal.Length());
        var isNear = Vector.GreaterThan(feature.VertexCount, new Vector<int>(2)) &
            Vector.GreaterThan(Vector3Wide.Dot(normal, direction), new Vector<float>(NearCosine));
        return Vector3Wide.Select(isNear, normal, direction);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void MeasureAlong(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localAxesB,
        in Vector3Wide direction, Vector<int> done, ref Vector<float> least)
    {
        DirectionalDepth<TShapeWideA, TSupportA, TShapeWideB, TSupportB>.Measure(
            a, b, localOffsetB, localAxesB, direction, Vector<int>.Zero, done, out var depth, out _);
        least = Wide.Min(least, depth);
    }

    // The round one's, whose lowest point no corner may show; else the smaller one's, which is nearer to the contacts.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> TakesPointOfB(in TShapeWideA a, in TShapeWideB b)
    {
        if (TFeatureA.IsRound)
            return Vector<int>.Zero;
        if (TFeatureB.IsRound)
            return Vector<int>.AllBitsSet;
        TSupportA.GetExtents(a, out _, out _, out var outerA);
        TSupportB.GetExtents(b, out _, out _, out var outerB);
        return Vector.LessThan(outerB, outerA);
    }
}
