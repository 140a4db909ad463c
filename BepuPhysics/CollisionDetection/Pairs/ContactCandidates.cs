using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A corner of the overlap of two faces of boxes, named by its index.</summary>
struct ContactCandidate : IContactCandidate
{
    /// <summary>Position in the plane of A's face.</summary>
    public Vector<float> X, Y;
    /// <summary>Depth along the normal; <see cref="IContactCandidate.None"/> where there is no such corner.</summary>
    public Vector<float> Depth;

    readonly Vector<float> IContactCandidate.X => X;

    readonly Vector<float> IContactCandidate.Y => Y;

    readonly Vector<float> IContactCandidate.Depth => Depth;

    readonly Vector<int> IContactCandidate.Name(int index) => new(index);

    readonly Vector<float> IContactCandidate.Weigh(Vector<float> squaredDistance) => squaredDistance;

    // Those beyond the margin exist, and do not take part.
    static Vector<int> IContactCandidate.TakesPart(Vector<float> depth, Vector<float> limit) => Vector.GreaterThanOrEqual(depth, limit);
}

/// <summary>The corners of the overlap of two faces of boxes, and the choice of four of them.</summary>
// The rule is that of ContactReduction. What is the boxes' own is the first corner: the deepest by its place alone, without memory of the last
// time, as faces of boxes name their corners the same from step to step; and the point that is left where rounding has lost all corners.
[InlineArray(Count)]
unsafe struct ContactCandidates
{
    /// <summary>Number of candidates.</summary>
    public const int Count = 12;

    // Corners that are equally deep, to this part of their distance, are told apart by their position, so that the same is first each time.
    const float PlaceWeight = 2e-5f;

    ContactCandidate first;

    /// <summary>Candidate by index, without a bounds check.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    [UnscopedRef]
    public readonly ref ContactCandidate At(int index) => ref Unsafe.Add(ref Unsafe.AsRef(in first), index);

    /// <summary>Chooses four candidates and writes them.</summary>
    /// <param name="faces">The faces.</param>
    /// <param name="touching">All bits set where the pair may have contacts.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists.</param>
    /// <param name="manifold">The contacts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Reduce(in BoxFaces faces, Vector<int> touching, Vector<float> speculativeMargin,
        ref ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        var minimumDepth = -speculativeMargin;
        ChooseDeepest(faces, out var deepest);
        var candidates = (ContactCandidate*)Unsafe.AsPointer(ref first);
        ContactReduction<ContactCandidate>.ChooseFarthest(candidates, Count, deepest, minimumDepth, deepest, out var farthest);
        var firstExists = touching & Vector.GreaterThanOrEqual(deepest.Depth, minimumDepth);
        var secondExists = firstExists & ContactReduction<ContactCandidate>.IsFarEnough(farthest, faces.Border);
        ContactReduction<ContactCandidate>.ChooseSides(candidates, Count, minimumDepth, deepest, farthest, 0, secondExists, out var sides);
        var plane = new ContactPlane(faces);
        manifold.Normal = plane.Normal;
        Write(plane, deepest, firstExists, ref manifold.Contacts[0]);
        Write(plane, farthest, secondExists, ref manifold.Contacts[1]);
        Write(plane, sides.Left, sides.LeftExists | Vector.AndNot(sides.BeyondMask, sides.TipIsLeft), ref manifold.Contacts[2]);
        Write(plane, sides.Right, sides.RightExists | (sides.BeyondMask & sides.TipIsLeft), ref manifold.Contacts[3]);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void ChooseDeepest(in BoxFaces faces, out ContactChoice choice)
    {
        ContactChoice best;
        best.Score = new Vector<float>(float.MinValue);
        best.Depth = new Vector<float>(IContactCandidate.None);
        best.X = best.Y = Vector<float>.Zero;
        best.Name = Vector<int>.Zero;
        // Not along an edge, nor a diagonal of a square: no two corners of a face are equally far in this direction.
        var weightX = new Vector<float>(PlaceWeight * 0.9f);
        var weightY = new Vector<float>(PlaceWeight * 0.4f);
        for (int i = 0; i < Count; ++i)
        {
            ref readonly var candidate = ref At(i);
            best.Offer(candidate.Depth + (candidate.X * weightX + candidate.Y * weightY), candidate, i);
        }
        choice = best;
        // Faces that overlap by no more than rounding may have lost their corners to it; boxes that overlap must not lose their contact.
        var lost = Vector.Equals(choice.Depth, new Vector<float>(IContactCandidate.None)) & Vector.GreaterThanOrEqual(faces.PairDepth, Vector<float>.Zero);
        if (Vector.EqualsAll(lost, Vector<int>.Zero))
            return;
        faces.FindNearestPoint(out var x, out var y);
        choice.X = Wide.Select(lost, x, choice.X);
        choice.Y = Wide.Select(lost, y, choice.Y);
        choice.Depth = Wide.Select(lost, faces.PairDepth, choice.Depth);
        choice.Name = Wide.Select(lost, new Vector<int>(Count), choice.Name);
    }

    /// <summary>The plane of A's face in the world, relative to A's centre.</summary>
    readonly struct ContactPlane
    {
        public readonly Vector3Wide Normal, AxisX, AxisY, Middle;
        public readonly Vector<float> PairDepth;
        public readonly Vector<int> FaceFeature;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public ContactPlane(in BoxFaces faces)
        {
            var useX = faces.FaceIsX;
            var useY = faces.FaceIsY;
            Normal = Matrix3x3Wide.TransposeTimes(faces.AxesA, faces.Normal);
            AxisX = Vector3Wide.Select(useX, faces.AxesA.Y, Vector3Wide.Select(useY, faces.AxesA.Z, faces.AxesA.X));
            AxisY = Vector3Wide.Select(useX, faces.AxesA.Z, Vector3Wide.Select(useY, faces.AxesA.X, faces.AxesA.Y));
            Middle = Vector3Wide.Select(useX, faces.AxesA.X, Vector3Wide.Select(useY, faces.AxesA.Y, faces.AxesA.Z)) * faces.FaceHeight;
            PairDepth = faces.PairDepth;
            FaceFeature = faces.FaceFeature;
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Write(in ContactPlane plane, in ContactChoice choice, Vector<int> exists, ref ContactWide contact)
    {
        // No contact is deeper than the pair; the border's tolerance can make it seem so.
        contact.Depth = Wide.Min(choice.Depth, plane.PairDepth);
        var halfway = contact.Depth * new Vector<float>(0.5f);
        contact.OffsetA = plane.Middle + plane.AxisX * choice.X + plane.AxisY * choice.Y + plane.Normal * halfway;
        contact.FeatureId = plane.FaceFeature | choice.Name;
        contact.Exists = exists;
    }
}
