using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Finds the contacts of any two convex shapes: the depth search gives normal, depth and one contact, the features that face each other
/// along the normal give the others.
/// </summary>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TSupportA">Farthest points of A.</typeparam>
/// <typeparam name="TFeatureA">Features of A.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TSupportB">Farthest points of B.</typeparam>
/// <typeparam name="TFeatureB">Features of B.</typeparam>
readonly struct SearchPairTester<TShapeWideA, TSupportA, TFeatureA, TShapeWideB, TSupportB, TFeatureB>
    : ISearchingPairTester<TShapeWideA, TShapeWideB, Few4<ContactWide>>
    where TShapeWideA : unmanaged where TSupportA : unmanaged, ISupport<TShapeWideA> where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
    where TShapeWideB : unmanaged where TSupportB : unmanaged, ISupport<TShapeWideB> where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
{
    /// <inheritdoc/>
    public static int LeastCarriedContactCount => RollingContacts.LeastCarriedCount(TFeatureA.IsRound || TFeatureB.IsRound);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in TShapeWideA a, in TShapeWideB b, in PairPoseWide pose, Vector<float> speculativeMargin,
        ref DepthSearchStateWide state, ref PairMeasuresWide measures, out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        pose.GetLocal(out var axesA, out var localAxesB, out var localOffsetB);
        var effort = default(SearchEffort);
        DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>.Find(
            a, b, localOffsetB, localAxesB, speculativeMargin, ref state, ref effort, out var found);
        measures.Evaluations = effort.Evaluations;
        measures.Depth = found.Depth;
        if (found.Near == Vector<int>.Zero)
        {
            manifold.RemoveContacts();
            return;
        }
        FaceManifold<TShapeWideA, TFeatureA, TShapeWideB, TFeatureB>.Build(a, b, localOffsetB, localAxesB, found.Normal, found.Depth,
            found.PointOnA, found.Near, speculativeMargin, axesA, ref state.Contacts, out manifold);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MeasureReaches(in TShapeWideA a, in TShapeWideB b, ref PairMeasuresWide measures)
    {
        measures.ReachA = PairMeasuresWide.Reach<TShapeWideA, TSupportA>(a);
        measures.ReachB = PairMeasuresWide.Reach<TShapeWideB, TSupportB>(b);
    }
}
