using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A shape of faces or rims over a plane: its lowest point, and the corners of the feature that faces the plane.</summary>
/// <typeparam name="TShapeWide">Wide form of the shape.</typeparam>
/// <typeparam name="TSupport">Farthest points of the shape.</typeparam>
/// <typeparam name="TFeature">Features of the shape.</typeparam>
readonly struct HalfSpaceFaceTester<TShapeWide, TSupport, TFeature> : ISearchingPairTester<TShapeWide, HalfSpaceWide, Few4<ContactWide>>
    where TShapeWide : unmanaged where TSupport : unmanaged, ISupport<TShapeWide> where TFeature : unmanaged, IContactFeature<TShapeWide>
{
    /// <inheritdoc/>
    public static int LeastCarriedContactCount => RollingContacts.LeastCarriedCount(TFeature.IsRound);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in TShapeWide a, in HalfSpaceWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        ref DepthSearchStateWide state, ref PairMeasuresWide measures, out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var axesA = Matrix3x3Wide.FromQuaternion(pose.OrientationA);
        var worldNormal = pose.OrientationB * b.Normal;
        var normal = axesA * worldNormal;
        var lowest = TSupport.Support(a, -normal, Vector<int>.Zero) - normal * TSupport.Margin(a);
        // The height in the world: far from the plane's origin the rounding of what is turned would be a depth.
        var depth = Vector3Wide.Dot(worldNormal, pose.OffsetB) - Vector3Wide.Dot(normal, lowest);
        measures.Evaluations = Vector<int>.One;
        measures.Depth = depth;
        measures.ReachB = pose.OffsetB.Length();
        var near = Vector.GreaterThanOrEqual(depth, -speculativeMargin);
        if (near == Vector<int>.Zero)
        {
            manifold.RemoveContacts();
            return;
        }
        FaceManifold<TShapeWide, TFeature, HalfSpaceWide, HalfSpaceFeature>.Build(a, b, default, default, normal, depth,
            lowest, near, speculativeMargin, axesA, ref state.Contacts, out manifold);
    }

    /// <inheritdoc/>
    // The larger of the two is the one that is still while the other moves over it. Its reach is for rounding, which is that of the distance.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MeasureReaches(in TShapeWide a, in HalfSpaceWide b, ref PairMeasuresWide measures)
    {
        measures.ReachA = PairMeasuresWide.Reach<TShapeWide, TSupport>(a);
        measures.ReachB = Wide.Max(measures.ReachB, measures.ReachA * new Vector<float>(2));
    }
}
