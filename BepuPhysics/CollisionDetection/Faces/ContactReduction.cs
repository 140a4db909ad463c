using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A corner of the overlap of two features: what may become a contact.</summary>
interface IContactCandidate
{
    /// <summary>Depth of a candidate that does not exist.</summary>
    const float None = -float.MaxValue;

    /// <summary>Position across the normal, m.</summary>
    Vector<float> X { get; }

    /// <summary>Position across the normal, m.</summary>
    Vector<float> Y { get; }

    /// <summary>Depth along the normal, m; <see cref="None"/> where there is no such corner.</summary>
    Vector<float> Depth { get; }

    /// <summary>Tells the corners of an overlap apart.</summary>
    /// <param name="index">Index of the candidate.</param>
    Vector<int> Name(int index);

    /// <summary>What a squared distance counts for.</summary>
    Vector<float> Weigh(Vector<float> squaredDistance);

    /// <summary>Whether candidates of a depth take part.</summary>
    static abstract Vector<int> TakesPart(Vector<float> depth, Vector<float> limit);
}

/// <summary>The best candidate of each lane so far.</summary>
struct ContactChoice
{
    public Vector<float> Score, X, Y, Depth;
    public Vector<int> Name;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Offer<TCandidate>(Vector<float> score, in TCandidate candidate, int index) where TCandidate : unmanaged, IContactCandidate
    {
        var better = Vector.GreaterThan(score, Score);
        Score = Wide.Select(better, score, Score);
        X = Wide.Select(better, candidate.X, X);
        Y = Wide.Select(better, candidate.Y, Y);
        Depth = Wide.Select(better, candidate.Depth, Depth);
        Name = Wide.Select(better, candidate.Name(index), Name);
    }

    /// <summary>Replaces all but the score.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Replace(Vector<int> isReplaced, in ContactChoice other)
    {
        X = Wide.Select(isReplaced, other.X, X);
        Y = Wide.Select(isReplaced, other.Y, Y);
        Depth = Wide.Select(isReplaced, other.Depth, Depth);
        Name = Wide.Select(isReplaced, other.Name, Name);
    }
}

/// <summary>The third and the fourth contact.</summary>
struct ContactSides
{
    public ContactChoice Left, Right;
    /// <summary>Lanes in which they span enough to exist.</summary>
    public Vector<int> LeftExists, RightExists;
    /// <summary>Lanes in which one of them, beyond the triangle of the other three, has replaced what was to the other side.</summary>
    public Vector<int> BeyondMask;
    /// <summary>Lanes in which that triangle's tip is the left one.</summary>
    public Vector<int> TipIsLeft;
}

/// <summary>The choice of four of the corners of an overlap, by what they span.</summary>
/// <remarks>
/// The first two are the caller's: the deepest, by its own rule, and the one farthest from it. Then the ones farthest to either side of the line
/// through both. Where the line is a side of the overlap, or nearly, one of the two is not there, or hardly spans anything: what is farthest out of
/// the triangle of the other three then takes its place. Four corners are four contacts; one that was left out would sink until it is the
/// deepest, push another one out in turn, and never come to rest. Corners that come twice do not matter, as the second has no distance, or no
/// area, to add.
/// </remarks>
/// <typeparam name="TCandidate">Candidates.</typeparam>
// Loops over candidates as they lie in memory, each a JIT root of its own: what a loop has chosen stays in registers.
static unsafe class ContactReduction<TCandidate> where TCandidate : unmanaged, IContactCandidate
{
    // Squared part of the border's tolerance: contacts nearer to each other are one.
    const float MinimumDistanceSquared = 100f;
    // Part of the distance of the first two contacts: a corner that is nearer to their line adds nothing.
    const float MinimumHeight = 1e-3f;
    // Part of one side's area below which the other side may have to give way to what is beyond the first.
    const float UnevenSides = 0.1f;

    /// <summary>Chooses the corner that is farthest from another.</summary>
    /// <param name="candidates">Corners.</param>
    /// <param name="count">Number of corners.</param>
    /// <param name="from">The other.</param>
    /// <param name="limit">Limit of the depth of corners that take part.</param>
    /// <param name="otherwise">What is chosen where none is farther than this.</param>
    /// <param name="choice">The corner; its score is the squared distance.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void ChooseFarthest(
        TCandidate* candidates, int count, in ContactChoice from, Vector<float> limit, in ContactChoice otherwise, out ContactChoice choice)
    {
        // Locals, not the result itself: these stay in registers.
        var best = otherwise;
        var fromX = from.X;
        var fromY = from.Y;
        var otherwiseX = otherwise.X - fromX;
        var otherwiseY = otherwise.Y - fromY;
        best.Score = otherwiseX * otherwiseX + otherwiseY * otherwiseY;
        for (int i = 0; i < count; ++i, ++candidates)
        {
            var x = candidates->X - fromX;
            var y = candidates->Y - fromY;
            best.Offer(Wide.Mask(TCandidate.TakesPart(candidates->Depth, limit), candidates->Weigh(x * x + y * y)), *candidates, i);
        }
        choice = best;
    }

    /// <summary>Whether the second corner is far enough from the first to be a contact.</summary>
    /// <param name="farthest">Second corner.</param>
    /// <param name="border">By how much the features were widened.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> IsFarEnough(in ContactChoice farthest, Vector<float> border) =>
        Vector.GreaterThan(farthest.Score, border * border * new Vector<float>(MinimumDistanceSquared));

    /// <summary>Chooses the third and the fourth contact.</summary>
    /// <param name="candidates">Corners.</param>
    /// <param name="count">Number of corners.</param>
    /// <param name="limit">Limit of the depth of corners that take part.</param>
    /// <param name="deepest">First contact.</param>
    /// <param name="farthest">Second contact.</param>
    /// <param name="lean">Angle, rad, by which the line is rotated to tell sides.</param>
    /// <param name="secondExists">Lanes with a second contact.</param>
    /// <param name="sides">The contacts.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ChooseSides(TCandidate* candidates, int count, Vector<float> limit, in ContactChoice deepest, in ContactChoice farthest,
        float lean, Vector<int> secondExists, out ContactSides sides)
    {
        var lineX = farthest.X - deepest.X;
        var lineY = farthest.Y - deepest.Y;
        var leaningX = lineX;
        var leaningY = lineY;
        if (lean != 0)
        {
            leaningX -= lineY * new Vector<float>(lean);
            leaningY += lineX * new Vector<float>(lean);
        }
        ChooseSides(candidates, count, limit, deepest, leaningX, leaningY, out sides.Left, out sides.Right);
        var areaEnough = (lineX * lineX + lineY * lineY) * new Vector<float>(MinimumHeight);
        var leftArea = lineX * (sides.Left.Y - deepest.Y) - lineY * (sides.Left.X - deepest.X);
        var rightArea = lineY * (sides.Right.X - deepest.X) - lineX * (sides.Right.Y - deepest.Y);
        sides.LeftExists = secondExists & Vector.GreaterThan(leftArea, areaEnough);
        sides.RightExists = secondExists & Vector.GreaterThan(rightArea, areaEnough);
        sides.TipIsLeft = Vector.GreaterThanOrEqual(leftArea, rightArea);
        sides.BeyondMask = Vector<int>.Zero;
        var otherArea = Wide.Min(leftArea, rightArea);
        var isUneven = secondExists & Vector.LessThan(otherArea, Wide.Max(leftArea, rightArea) * new Vector<float>(UnevenSides));
        if (Vector.EqualsAll(isUneven, Vector<int>.Zero))
            return;
        ChooseBeyond(candidates, count, limit, deepest, farthest, sides, out var beyond);
        sides.BeyondMask = isUneven & Vector.GreaterThan(beyond.Score, Wide.Max(otherArea, areaEnough));
        sides.Left.Replace(Vector.AndNot(sides.BeyondMask, sides.TipIsLeft), beyond);
        sides.Right.Replace(sides.BeyondMask & sides.TipIsLeft, beyond);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseSides(TCandidate* candidates, int count, Vector<float> limit, in ContactChoice deepest, Vector<float> lineX, Vector<float> lineY,
        out ContactChoice left, out ContactChoice right)
    {
        var most = deepest;
        most.Score = Vector<float>.Zero;
        var least = most;
        var fromX = deepest.X;
        var fromY = deepest.Y;
        for (int i = 0; i < count; ++i, ++candidates)
        {
            var area = Wide.Mask(
                TCandidate.TakesPart(candidates->Depth, limit), lineX * (candidates->Y - fromY) - lineY * (candidates->X - fromX));
            most.Offer(area, *candidates, i);
            least.Offer(-area, *candidates, i);
        }
        left = most;
        right = least;
    }

    /// <summary>Chooses what is farthest out of the triangle of three contacts, by the area that it adds beyond its second or third side.</summary>
    // Areas are twice what they are called. What is to the left of a side has a positive one; where the tip is on the left, that is inside.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ChooseBeyond(TCandidate* candidates, int count, Vector<float> limit, in ContactChoice deepest, in ContactChoice farthest,
        in ContactSides sides, out ContactChoice choice)
    {
        var most = deepest;
        most.Score = Vector<float>.Zero;
        var tipX = Wide.Select(sides.TipIsLeft, sides.Left.X, sides.Right.X);
        var tipY = Wide.Select(sides.TipIsLeft, sides.Left.Y, sides.Right.Y);
        var outside = Wide.Select(sides.TipIsLeft, -Vector<float>.One, Vector<float>.One);
        var secondX = (tipX - farthest.X) * outside;
        var secondY = (tipY - farthest.Y) * outside;
        var thirdX = (deepest.X - tipX) * outside;
        var thirdY = (deepest.Y - tipY) * outside;
        for (int i = 0; i < count; ++i, ++candidates)
        {
            var x = candidates->X - tipX;
            var y = candidates->Y - tipY;
            var area = Wide.Max(secondX * y - secondY * x, thirdX * y - thirdY * x);
            most.Offer(Wide.Mask(TCandidate.TakesPart(candidates->Depth, limit), area), *candidates, i);
        }
        choice = most;
    }
}
