using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// Box against triangle: the separating axis of least depth, or the nearest points of shapes that are apart, then up to four corners of the
/// overlap of the two faces that look along it.
/// </summary>
/// <remarks>
/// A one-sided triangle meets only boxes whose centre is in front of its plane, or on it, and only with normals that do not point behind it:
/// a box whose least way out is by the back is let go, and none that comes from behind is caught by an edge that the triangle shares with
/// its neighbours. Over an edge of a closed surface the centre is in front of at least one of the two triangles. Boxes that are as deep from
/// either side leave by the front.
/// </remarks>
public readonly unsafe struct BoxTriangleTester : IPairTester<BoxWide, TriangleWide, Few4<ContactWide>>
{
    struct Scratch
    {
        public Matrix3x3Wide AxesA, AxesB;
        public Vector3Wide OffsetB;
        public BoxTriangleAxes Axes;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in BoxWide a, in TriangleWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        int anchor;
        // Frames of the steps are at the quickest of the four places in a line.
        var memory = stackalloc byte[AlignedScratch.SizeFor<Scratch>(&anchor, 1)];
        ref var scratch = ref AlignedScratch.Align<Scratch>(memory);
        ref var axes = ref scratch.Axes;
        pose.GetLocal(out scratch.AxesA, out scratch.AxesB, out scratch.OffsetB);
        axes.Triangle.Place(b, scratch.AxesB, scratch.OffsetB);
        axes.FindLeastDepth(a);
        var isInFront = b.TwoSidedMask |
            Vector.LessThanOrEqual(Vector3Wide.Dot(axes.Triangle.Front, axes.Triangle.A), Vector<float>.Zero);
        var near = isInFront & Vector.GreaterThanOrEqual(axes.Depth, -speculativeMargin);
        var apart = near & axes.MayBeApart;
        if (!Vector.EqualsAll(apart, Vector<int>.Zero))
        {
            axes.FindNearest(a, apart);
            near &= Vector.GreaterThanOrEqual(axes.Depth, -speculativeMargin);
        }
        if (Vector.EqualsAll(near, Vector<int>.Zero))
        {
            manifold.RemoveContacts();
            return;
        }
        FaceManifold<BoxWide, BoxFeature, TriangleWide, TriangleFeature>.Build(a, b, scratch.OffsetB, scratch.AxesB, axes.Normal, axes.Depth,
            axes.PointOnBox, near, speculativeMargin, scratch.AxesA, out manifold);
    }
}
