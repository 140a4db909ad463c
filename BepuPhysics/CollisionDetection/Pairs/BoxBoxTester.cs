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
/// For overlapping boxes, and for boxes whose nearest features are a face and a corner or two edges, the depth is exact. For boxes that are
/// apart at a corner and an edge, or at two corners, no axis shows the whole distance: the depth is then the greatest lower bound of it
/// that an axis gives, and as the two faces do not overlap along it, there are no contacts until they do.
/// </remarks>
// Three steps, in A's frame, each a method of its own, so that each has the registers to itself: BoxAxes finds the normal, BoxFaces turns
// the faces into a rectangle and a parallelogram and finds the corners of their overlap, ContactReduction keeps four.
// The reference face is always one of A's, whether the normal belongs to it or not: depth is linear over B's face, and measured along the
// normal. So face contacts and edge contacts are one case, and what turns from the one into the other does so without a jump.
public readonly unsafe struct BoxBoxTester : IPairTester<BoxWide, BoxWide, Few4<ContactWide>>
{
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
    }
}
