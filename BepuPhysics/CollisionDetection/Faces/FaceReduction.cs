using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The choice of four corners of the overlap of two features, and of the witness where they are not deep enough.</summary>
// The deepest; the one farthest from it; the ones farthest to either side of the line through both. Where the overlap is level, the
// deepest is any of its corners, and the corner farthest from its opposite takes its place: the line is then as long as can be, and the
// four span more. Corners that come twice do not matter, as the second has no distance, or no area, to add.
// Where the line is a side of the overlap, or nearly, one of the two is not there, or hardly spans anything: what is farthest out of the
// triangle of the other three then takes its place. Four corners are four contacts; one that was left out would sink until it is the
// deepest, push another one out in turn, and never come to rest.
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
    // Squared part of the border's tolerance: contacts nearer to each other are one.
    const float MinimumDistanceSquared = 100f;
    // Part of the distance of the first two contacts: a corner that is nearer to their line adds nothing.
    const float MinimumHeight = 1e-3f;
    // Part of that size by which the first corner of the last time counts as deeper. More than the place is worth over the whole of a shape,
    // and far less than the tolerance.
    const float DepthPreference = 8e-5f;
    // What the squared distances of the first two corners of the last time are multiplied by.
    const float SpanPreference = 1.05f;
    // Part of one side's area below which the other side may have to give way to what is beyond the first.
    const float UnevenSides = 0.1f;
    // Angle, rad, by which the line turns that sides are told by.
    const float SideTurn = 1e-4f;
    // Name of the witness. It is not remembered: one more is zero in eight bits.
    const int WitnessName = 255;
    // Bits of a feature id: the corner, A's feature, B's feature.
    const int NameBits = 8;
    const int NameMask = (1 << NameBits) - 1;
    const int FeatureBits = 11;

    struct Choice
    {
        public Vector<float> Score, X, Y, Depth;
        public Vector<int> Name;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Offer(Vector<float> score, in FaceCandidate candidate)
        {
            var better = Vector.GreaterThan(score, Score);
            Score = Wide.Select(better, score, Score);
            X = Wide.Select(better, candidate.X, X);
            Y = Wide.Select(better, candidate.Y, Y);
            Depth = Wide.Select(better, candidate.Depth, Depth);
            Name = Wide.Select(better, candidate.Name, Name);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Replace(Vector<int> isReplaced, in Choice other)
        {
            X = Wide.Select(isReplaced, other.X, X);
            Y = Wide.Select(isReplaced, other.Y, Y);
            Depth = Wide.Select(isReplaced, other.Depth, Depth);
            Name = Wide.Select(isReplaced, other.Name, Name);
        }
    }

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
        ChooseFarthest(overlap, deepest, new Vector<float>(FaceCandidate.None), deepest, out var farthest);
        var level = Wide.Max(deepest.Depth - size * new Vector<float>(LevelTolerance), deepEnough);
        ChooseFarthest(overlap, farthest, level, deepest, out deepest);
        var lineX = farthest.X - deepest.X;
        var lineY = farthest.Y - deepest.Y;
        // Of corners that are as far to a side, as in a regular hexagon, the left one nearest to the first contact and the right one nearest to
        // the second, so that these two are opposite to each other: three contacts at one end of the overlap and one at the other give way
        // unevenly.
        var turn = new Vector<float>(SideTurn);
        ChooseSides(overlap, deepest, lineX - lineY * turn, lineY + lineX * turn, out var left, out var right);

        var farEnough = overlap.Border * overlap.Border * new Vector<float>(MinimumDistanceSquared);
        var areaEnough = (lineX * lineX + lineY * lineY) * new Vector<float>(MinimumHeight);
        var secondExists = near & Vector.GreaterThan(farthest.Score, farEnough);
        var writer = new Writer(overlap, frame, orientationA);
        manifold.Normal = writer.Normal;
        var leftArea = lineX * (left.Y - deepest.Y) - lineY * (left.X - deepest.X);
        var rightArea = lineX * (right.Y - deepest.Y) - lineY * (right.X - deepest.X);
        var leftExists = secondExists & Vector.GreaterThan(leftArea, areaEnough);
        var rightExists = secondExists & Vector.LessThan(rightArea, -areaEnough);
        var tipIsLeft = Vector.GreaterThanOrEqual(leftArea, -rightArea);
        var otherArea = Wide.Min(leftArea, -rightArea);
        var isUneven = secondExists & Vector.LessThan(otherArea, Wide.Max(leftArea, -rightArea) * new Vector<float>(UnevenSides));
        if (!Vector.EqualsAll(isUneven, Vector<int>.Zero))
        {
            ChooseBeyond(overlap, deepest, farthest, tipIsLeft, left, right, out var beyond);
            var isMore = isUneven & Vector.GreaterThan(beyond.Score, Wide.Max(otherArea, areaEnough));
            left.Replace(Vector.AndNot(isMore, tipIsLeft), beyond);
            right.Replace(isMore & tipIsLeft, beyond);
            leftExists |= isMore;
            rightExists |= isMore;
        }
        writer.Write(deepest, near, ref manifold.Contacts[0]);
        writer.Write(farthest, secondExists, ref manifold.Contacts[1]);
        writer.Write(left, leftExists, ref manifold.Contacts[2]);
        writer.Write(right, rightExists, ref manifold.Contacts[3]);
        remembered = Wide.Select(near, Remember(deepest, near) | Remember(farthest, secondExists) << NameBits, remembered);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Remember(in Choice choice, Vector<int> exists) =>
        exists & (choice.Name + Vector<int>.One) & new Vector<int>(NameMask);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Recall(Vector<int> names) => (names & new Vector<int>(NameMask)) - Vector<int>.One;

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseDeepest(in FaceOverlap overlap, in FaceFrame frame, Vector<float> size, Vector<float> deepEnough,
        Vector<int> remembered, out Choice choice)
    {
        Choice best;
        best.Score = new Vector<float>(float.MinValue);
        best.Depth = new Vector<float>(FaceCandidate.None);
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
            best.Offer(candidate->Depth + (candidate->X * weightX + candidate->Y * weightY) + preferred, *candidate);
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

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseFarthest(in FaceOverlap overlap, in Choice from, Vector<float> depthAbove, in Choice otherwise, out Choice choice)
    {
        // Locals, not the result itself: these stay in registers.
        var best = otherwise;
        var fromX = from.X;
        var fromY = from.Y;
        var otherwiseX = otherwise.X - fromX;
        var otherwiseY = otherwise.Y - fromY;
        best.Score = otherwiseX * otherwiseX + otherwiseY * otherwiseY;
        var end = overlap.Candidates + overlap.CandidateCount;
        for (var candidate = overlap.Candidates; candidate != end; ++candidate)
        {
            var x = candidate->X - fromX;
            var y = candidate->Y - fromY;
            best.Offer(Wide.Mask(Vector.GreaterThan(candidate->Depth, depthAbove), (x * x + y * y) * candidate->Weight), *candidate);
        }
        choice = best;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseSides(in FaceOverlap overlap, in Choice deepest, Vector<float> lineX, Vector<float> lineY,
        out Choice left, out Choice right)
    {
        var most = deepest;
        most.Score = Vector<float>.Zero;
        var least = most;
        var fromX = deepest.X;
        var fromY = deepest.Y;
        var end = overlap.Candidates + overlap.CandidateCount;
        for (var candidate = overlap.Candidates; candidate != end; ++candidate)
        {
            var area = Wide.Mask(Exists(*candidate), lineX * (candidate->Y - fromY) - lineY * (candidate->X - fromX));
            most.Offer(area, *candidate);
            least.Offer(-area, *candidate);
        }
        left = most;
        right = least;
    }

    /// <summary>Chooses what is farthest out of the triangle of three contacts, by the area that it adds beyond its second or third side.</summary>
    // Areas are twice what they are called. What is to the left of a side has a positive one; where the tip is on the left, that is inside.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseBeyond(in FaceOverlap overlap, in Choice deepest, in Choice farthest, Vector<int> tipIsLeft, in Choice left,
        in Choice right, out Choice choice)
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
        var end = overlap.Candidates + overlap.CandidateCount;
        for (var candidate = overlap.Candidates; candidate != end; ++candidate)
        {
            var x = candidate->X - tipX;
            var y = candidate->Y - tipY;
            var area = Wide.Max(secondX * y - secondY * x, thirdX * y - thirdY * x);
            most.Offer(Wide.Mask(Exists(*candidate), area), *candidate);
        }
        choice = most;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Exists(in FaceCandidate candidate) => Vector.GreaterThan(candidate.Depth, new Vector<float>(FaceCandidate.None));

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
        public void Write(in Choice choice, Vector<int> exists, ref ContactWide contact)
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
