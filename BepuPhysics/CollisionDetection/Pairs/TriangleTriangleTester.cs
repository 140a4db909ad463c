using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Triangle against triangle: the separating axis of least depth, or the nearest points of triangles that are apart, then up to four corners
/// of the overlap of the two faces, seen along it.
/// </summary>
/// <remarks>
/// Triangles that cross have the least depth that brings them apart, by either side of each. A one-sided triangle has only contacts whose
/// normal does not point behind it; where the least way out does, there is none.
/// </remarks>
public readonly unsafe struct TriangleTriangleTester : IPairTester<TriangleWide, TriangleWide, Few4<ContactWide>>
{
    struct Scratch
    {
        public Matrix3x3Wide AxesA, AxesB;
        public Vector3Wide OffsetB;
        public TriangleTriangleAxes Axes;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in TriangleWide a, in TriangleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        int anchor;
        var memory = stackalloc byte[AlignedScratch.SizeFor<Scratch>(&anchor, 0)];
        ref var scratch = ref AlignedScratch.Align<Scratch>(memory);
        ref var axes = ref scratch.Axes;
        pose.GetLocal(out scratch.AxesA, out scratch.AxesB, out scratch.OffsetB);
        axes.A.Place(a);
        axes.B.Place(b, scratch.AxesB, scratch.OffsetB);
        axes.FindLeastDepth();
        var near = Vector.GreaterThanOrEqual(axes.Depth, -speculativeMargin);
        var apart = near & axes.MayBeApart;
        if (!Vector.EqualsAll(apart, Vector<int>.Zero))
        {
            axes.FindNearest(apart);
            near &= Vector.GreaterThanOrEqual(axes.Depth, -speculativeMargin) & Vector.LessThan(axes.Depth, new Vector<float>(float.MaxValue));
        }
        if (Vector.EqualsAll(near, Vector<int>.Zero))
        {
            manifold.RemoveContacts();
            return;
        }
        FaceManifold<TriangleWide, TriangleFeature, TriangleWide, TriangleFeature>.Build(a, b, scratch.OffsetB, scratch.AxesB, axes.Normal,
            axes.Depth, axes.PointOnA, near, speculativeMargin, scratch.AxesA, out manifold);
    }
}
