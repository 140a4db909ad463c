using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The choice of four corners of the overlap of two features, and of the witness where they are not deep enough.</summary>
// The rule is that of ContactReduction. Where the overlap is level, the deepest is any of its corners, and the corner farthest from its opposite
// takes its place: the line through the first two is then as long as can be, and the four span more.
// Of more than four corners that are as good, rounding would choose, and choose others each time: a stack would never be still. So the
// first two of the last time, from which the others follow, are preferred by more than rounding and less than matters. Not by more: what
// becomes a contact late is already deep, and pushes what it holds up; and four that were kept for their own sake are less even.
static unsafe class FaceReduction
{
    // Corners that are equally deep, to this part of their distance, are told apart by their place, so that the same is first each time.
    const float PlaceWeight = 2e-5f;
    // Part of the size of the smaller shape by which the deepest corner may be less deep than the pair.
    const float DepthTolerance = 2e-4f;
    // Part of that size by which two corners may differ in depth and count as level.
    const float LevelTolerance = 5e-5f;
    // Part of that size by which the first corner of the last time counts as deeper. More than the place is worth over the whole of a shape,
    // and far less than the tolerance.
    const float DepthPreference = 8e-5f;
    // What the squared distances of the first two corners of the last time are multiplied by.
    const float SpanPreference = 1.05f;
    // Angle, rad, by which the line is rotated that sides are told by.
    const float SideLean = 1e-4f;
    // Name of the witness. It is not remembered: one more is zero in eight bits.
    const int WitnessName = 255;
    // Bits of a feature id: the corner, A's feature, B's feature.
    const int NameBits = 8;
    const int NameMask = (1 << NameBits) - 1;
    const int FeatureBits = 11;

    /// <summary>Chooses the contacts of a bundle and writes them.</summary>
    /// <param name="overlap">The features and the corners of their overlap.</param>
    /// <param name="frame">The frame in A's coordinates.</param>
    /// <param name="orientationA">Axes of A in the world, in the rows.</param>
    /// <param name="near">All bits set where the pair has contacts.</param>
    /// <param name="remembered">Names of the first two corners of the last time, and of these.</param>
    /// <param name="manifold">The contacts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Reduce(in FaceOverlap overlap, in FaceFrame frame, in Matrix3x3Wide orientationA, Vector<int> near,
        ref Vector<int> remembered, ref ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        var size = Wide.Min(overlap.A.Feature.Size, overlap.B.Feature.Size);
        var deepEnough = overlap.PairDepth - size * new Vector<float>(DepthTolerance);
        ChooseDeepest(overlap, frame, size, deepEnough, remembered, out var deepest);
        var candidates = overlap.Candidates;
        var count = overlap.CandidateCount;
        var none = new Vector<float>(IContactCandidate.None);
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, deepest, none, deepest, out var farthest);
        var level = Wide.Max(deepest.Depth - size * new Vector<float>(LevelTolerance), deepEnough);
        ContactReduction<FaceCandidate>.ChooseFarthest(candidates, count, farthest, level, deepest, out deepest);
        var secondExists = near & ContactReduction<FaceCandidate>.IsFarEnough(farthest, overlap.Border);
        // Of corners that are as far to a side, as in a regular hexagon, the left one nearest to the first contact and the right one nearest to
        // the second, so that these two are opposite to each other: three contacts at one end of the overlap and one at the other give way
        // unevenly.
        ContactReduction<FaceCandidate>.ChooseSides(candidates, count, none, deepest, farthest, SideLean, secondExists, out var sides);
        var writer = new Writer(overlap, frame, orientationA);
        manifold.Normal = writer.Normal;
        writer.Write(deepest, near, ref manifold.Contacts[0]);
        writer.Write(farthest, secondExists, ref manifold.Contacts[1]);
        writer.Write(sides.Left, sides.LeftExists | sides.BeyondMask, ref manifold.Contacts[2]);
        writer.Write(sides.Right, sides.RightExists | sides.BeyondMask, ref manifold.Contacts[3]);
        remembered = Wide.Select(near, Remember(deepest, near) | Remember(farthest, secondExists) << NameBits, remembered);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Remember(in ContactChoice choice, Vector<int> exists) =>
        exists & (choice.Name + Vector<int>.One) & new Vector<int>(NameMask);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Recall(Vector<int> names) => (names & new Vector<int>(NameMask)) - Vector<int>.One;

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseDeepest(in FaceOverlap overlap, in FaceFrame frame, Vector<float> size, Vector<float> deepEnough,
        Vector<int> remembered, out ContactChoice choice)
    {
        ContactChoice best;
        best.Score = new Vector<float>(float.MinValue);
        best.Depth = new Vector<float>(IContactCandidate.None);
        best.X = best.Y = Vector<float>.Zero;
        best.Name = Vector<int>.Zero;
        // A direction that is fixed to A, not to the frame, whose axes may turn over when the normal moves a little.
        var placeX = new Vector<float>(PlaceWeight * 0.9f);
        var placeY = new Vector<float>(PlaceWeight * 0.4f);
        var placeZ = new Vector<float>(PlaceWeight * 0.17f);
        var weightX = frame.X.X * placeX + frame.X.Y * placeY + frame.X.Z * placeZ;
        var weightY = frame.Y.X * placeX + frame.Y.Y * placeY + frame.Y.Z * placeZ;
        var end = overlap.Candidates + overlap.CandidateCount;
        // No corner has the name of what was not a contact.
        var name0 = Recall(remembered);
        var name1 = Recall(remembered >>> NameBits);
        var preference = size * new Vector<float>(DepthPreference);
        for (var candidate = overlap.Candidates; candidate != end; ++candidate)
        {
            var wasFirst = Vector.Equals(candidate->Name, name0);
            var wasSecond = Vector.Equals(candidate->Name, name1);
            candidate->Weight = Wide.Select(wasFirst | wasSecond, new Vector<float>(SpanPreference), Vector<float>.One);
            // What is not deep enough must not hide what is.
            var preferred = Wide.Mask(wasFirst & Vector.GreaterThanOrEqual(candidate->Depth, deepEnough), preference);
            best.Offer(candidate->Depth + (candidate->X * weightX + candidate->Y * weightY) + preferred, *candidate, 0);
        }
        choice = best;
        // The features need not hold the points that are nearest: the face whose normal is nearest to the direction need not be the one
        // with the farthest vertex, and round ones are cut short. The pair is never less deep for it.
        var isWitness = Vector.LessThan(choice.Depth, deepEnough);
        choice.X = Wide.Select(isWitness, Vector<float>.Zero, choice.X);
        choice.Y = Wide.Select(isWitness, Vector<float>.Zero, choice.Y);
        choice.Depth = Wide.Select(isWitness, overlap.PairDepth, choice.Depth);
        choice.Name = Wide.Select(isWitness, new Vector<int>(WitnessName), choice.Name);
    }

    /// <summary>What takes a chosen corner to the world.</summary>
    readonly struct Writer
    {
        public readonly Vector3Wide Normal;
        readonly Vector3Wide axisX, axisY, origin;
        readonly Vector<float> slopeX, slopeY, slopeHeight, highestA, highestB;
        readonly Vector<int> features;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Writer(in FaceOverlap overlap, in FaceFrame frame, in Matrix3x3Wide orientationA)
        {
            Normal = Matrix3x3Wide.TransposeTimes(orientationA, -frame.Outwards);
            axisX = Matrix3x3Wide.TransposeTimes(orientationA, frame.X);
            axisY = Matrix3x3Wide.TransposeTimes(orientationA, frame.Y);
            origin = Matrix3x3Wide.TransposeTimes(orientationA, frame.Origin);
            slopeX = overlap.A.SlopeX;
            slopeY = overlap.A.SlopeY;
            slopeHeight = overlap.A.SlopeHeight;
            highestA = overlap.A.Highest;
            highestB = overlap.B.Highest;
            var mask = new Vector<int>((1 << FeatureBits) - 1);
            features = (overlap.A.Feature.Id & mask) << NameBits | (overlap.B.Feature.Id & mask) << (NameBits + FeatureBits);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Write(in ContactChoice choice, Vector<int> exists, ref ContactWide contact)
        {
            // A's surface is as high as its feature, and at the witness where that is.
            var isWitness = Vector.Equals(choice.Name, new Vector<int>(WitnessName));
            // A steep plane that is followed to the border beside its feature goes beyond the highest vertex of that, which neither surface does.
            var height = Wide.Clamp(slopeX * choice.X + slopeY * choice.Y + slopeHeight, choice.Depth - highestB, highestA);
            height = Wide.Select(isWitness, Vector<float>.Zero, height);
            var halfway = choice.Depth * new Vector<float>(0.5f) - height;
            contact.OffsetA = origin + axisX * choice.X + axisY * choice.Y + Normal * halfway;
            contact.Depth = choice.Depth;
            contact.FeatureId = features | choice.Name;
            contact.Exists = exists;
        }
    }
}
