using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A corner of the overlap of two faces.</summary>
struct ContactCandidate
{
    /// <summary>Place in the plane of A's face.</summary>
    public Vector<float> X, Y;
    /// <summary>Depth along the normal; <see cref="ContactCandidates.None"/> where there is no such corner.</summary>
    public Vector<float> Depth;
}

/// <summary>The corners of the overlap of two faces, and the choice of four of them.</summary>
// The deepest; the one farthest from it; the ones farthest to either side of the line through both. Where the line is a side of the
// overlap, or nearly, one of these is not there, or hardly spans anything: what is farthest out of the triangle of the other three then
// takes its place, so that four corners are four contacts. Corners that come twice do not matter, as the second has no distance, or no
// area, to add.
[InlineArray(Count)]
struct ContactCandidates
{
    /// <summary>Number of candidates.</summary>
    public const int Count = 12;
    /// <summary>Depth of a candidate that does not exist.</summary>
    public const float None = -float.MaxValue;

    // Corners that are equally deep, to this part of their distance, are told apart by their place, so that the same is first each time.
    const float PlaceWeight = 2e-5f;
    // Squared part of the face's border tolerance: contacts nearer to each other are one.
    const float MinimumDistanceSquared = 100f;
    // Part of the distance of the first two contacts: a corner that is nearer to their line adds nothing.
    const float MinimumHeight = 1e-3f;

    // Part of one side's area below which the other side may have to give way to what is beyond the first.
    const float UnevenSides = 0.1f;

    ContactCandidate first;

    /// <summary>Candidate by index, without a bounds check.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    [UnscopedRef]
    public readonly ref ContactCandidate At(int index) => ref Unsafe.Add(ref Unsafe.AsRef(in first), index);

    struct Choice
    {
        public Vector<float> Score, X, Y, Depth;
        public Vector<int> Index;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Offer(Vector<float> score, in ContactCandidate candidate, Vector<int> index)
        {
            var better = Vector.GreaterThan(score, Score);
            Score = Wide.Select(better, score, Score);
            X = Wide.Select(better, candidate.X, X);
            Y = Wide.Select(better, candidate.Y, Y);
            Depth = Wide.Select(better, candidate.Depth, Depth);
            Index = Wide.Select(better, index, Index);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Replace(Vector<int> isReplaced, in Choice other)
        {
            Score = Wide.Select(isReplaced, other.Score, Score);
            X = Wide.Select(isReplaced, other.X, X);
            Y = Wide.Select(isReplaced, other.Y, Y);
            Depth = Wide.Select(isReplaced, other.Depth, Depth);
            Index = Wide.Select(isReplaced, other.Index, Index);
        }
    }

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
        ChooseFarthest(deepest, minimumDepth, out var farthest);
        var lineX = farthest.X - deepest.X;
        var lineY = farthest.Y - deepest.Y;
        ChooseSides(deepest, lineX, lineY, minimumDepth, out var left, out var right);

        var farEnough = faces.Border * faces.Border * new Vector<float>(MinimumDistanceSquared);
        var areaEnough = (lineX * lineX + lineY * lineY) * new Vector<float>(MinimumHeight);
        var firstExists = touching & Vector.GreaterThanOrEqual(deepest.Depth, minimumDepth);
        var secondExists = firstExists & Vector.GreaterThan(farthest.Score, farEnough);
        var tipIsLeft = Vector.GreaterThanOrEqual(left.Score, right.Score);
        var otherArea = Wide.Min(left.Score, right.Score);
        var isUneven = secondExists & Vector.LessThan(otherArea, Wide.Max(left.Score, right.Score) * new Vector<float>(UnevenSides));
        if (!Vector.EqualsAll(isUneven, Vector<int>.Zero))
        {
            ChooseBeyond(deepest, farthest, tipIsLeft, left, right, minimumDepth, out var beyond);
            var isMore = isUneven & Vector.GreaterThan(beyond.Score, otherArea);
            left.Replace(Vector.AndNot(isMore, tipIsLeft), beyond);
            right.Replace(isMore & tipIsLeft, beyond);
        }
        var plane = new ContactPlane(faces);
        manifold.Normal = plane.Normal;
        Write(plane, deepest, firstExists, ref manifold.Contacts[0]);
        Write(plane, farthest, secondExists, ref manifold.Contacts[1]);
        Write(plane, left, secondExists & Vector.GreaterThan(left.Score, areaEnough), ref manifold.Contacts[2]);
        Write(plane, right, secondExists & Vector.GreaterThan(right.Score, areaEnough), ref manifold.Contacts[3]);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void ChooseDeepest(in BoxFaces faces, out Choice choice)
    {
        Choice best;
        best.Score = new Vector<float>(float.MinValue);
        best.Depth = new Vector<float>(None);
        best.X = best.Y = Vector<float>.Zero;
        best.Index = Vector<int>.Zero;
        // Not along an edge, nor a diagonal of a square: no two corners of a face are equally far in this direction.
        var weightX = new Vector<float>(PlaceWeight * 0.9f);
        var weightY = new Vector<float>(PlaceWeight * 0.4f);
        for (int i = 0; i < Count; ++i)
        {
            ref readonly var candidate = ref At(i);
            best.Offer(candidate.Depth + (candidate.X * weightX + candidate.Y * weightY), candidate, new Vector<int>(i));
        }
        choice = best;
        // Faces that overlap by no more than rounding may have lost their corners to it; boxes that overlap must not lose their contact.
        var lost = Vector.Equals(choice.Depth, new Vector<float>(None)) & Vector.GreaterThanOrEqual(faces.PairDepth, Vector<float>.Zero);
        if (Vector.EqualsAll(lost, Vector<int>.Zero))
            return;
        faces.FindNearestPoint(out var x, out var y);
        choice.X = Wide.Select(lost, x, choice.X);
        choice.Y = Wide.Select(lost, y, choice.Y);
        choice.Depth = Wide.Select(lost, faces.PairDepth, choice.Depth);
        choice.Index = Wide.Select(lost, new Vector<int>(Count), choice.Index);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void ChooseFarthest(in Choice deepest, Vector<float> minimumDepth, out Choice choice)
    {
        // Locals, not the result itself: these stay in registers.
        var best = deepest;
        best.Score = Vector<float>.Zero;
        var fromX = deepest.X;
        var fromY = deepest.Y;
        for (int i = 0; i < Count; ++i)
        {
            ref readonly var candidate = ref At(i);
            var x = candidate.X - fromX;
            var y = candidate.Y - fromY;
            best.Offer(
                Wide.Mask(Vector.GreaterThanOrEqual(candidate.Depth, minimumDepth), x * x + y * y), candidate, new Vector<int>(i));
        }
        choice = best;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void ChooseSides(in Choice deepest, Vector<float> lineX, Vector<float> lineY, Vector<float> minimumDepth,
        out Choice left, out Choice right)
    {
        var most = deepest;
        most.Score = Vector<float>.Zero;
        var least = most;
        var fromX = deepest.X;
        var fromY = deepest.Y;
        for (int i = 0; i < Count; ++i)
        {
            ref readonly var candidate = ref At(i);
            var area = Wide.Mask(
                Vector.GreaterThanOrEqual(candidate.Depth, minimumDepth),
                lineX * (candidate.Y - fromY) - lineY * (candidate.X - fromX));
            most.Offer(area, candidate, new Vector<int>(i));
            least.Offer(-area, candidate, new Vector<int>(i));
        }
        left = most;
        right = least;
    }

    /// <summary>Chooses what is farthest out of the triangle of three contacts, by the area that it adds beyond its second or third side.</summary>
    // Areas are twice what they are called. What is to the left of a side has a positive one; where the tip is on the left, that is inside.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void ChooseBeyond(in Choice deepest, in Choice farthest, Vector<int> tipIsLeft, in Choice left, in Choice right,
        Vector<float> minimumDepth, out Choice choice)
    {
        var most = deepest;
        most.Score = Vector<float>.Zero;
        var tipX = Wide.Select(tipIsLeft, left.X, right.X);
        var tipY = Wide.Select(tipIsLeft, left.Y, right.Y);
        var outside = Wide.Select(tipIsLeft, -Vector<float>.One, Vector<float>.One);
        var secondX = (tipX - farthest.X) * outside;
        var secondY = (tipY - farthest.Y) * outside;
        var thirdX = (deepest.X - tipX) * outside;
        var thirdY = (deepest.Y - tipY) * outside;
        for (int i = 0; i < Count; ++i)
        {
            ref readonly var candidate = ref At(i);
            var x = candidate.X - tipX;
            var y = candidate.Y - tipY;
            var area = Wide.Max(secondX * y - secondY * x, thirdX * y - thirdY * x);
            most.Offer(Wide.Mask(Vector.GreaterThanOrEqual(candidate.Depth, minimumDepth), area), candidate, new Vector<int>(i));
        }
        choice = most;
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
    static void Write(in ContactPlane plane, in Choice choice, Vector<int> exists, ref ContactWide contact)
    {
        // No contact is deeper than the pair; the border's tolerance can make it seem so.
        contact.Depth = Wide.Min(choice.Depth, plane.PairDepth);
        var halfway = contact.Depth * new Vector<float>(0.5f);
        contact.OffsetA = plane.Middle + plane.AxisX * choice.X + plane.AxisY * choice.Y + plane.Normal * halfway;
        contact.FeatureId = plane.FaceFeature | choice.Index;
        contact.Exists = exists;
    }
}
