using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Two children that touch, by what makes one come before another.</summary>
struct RankedChild
{
    /// <summary>0 for contacts that are as the test found them; 1 where a triangle's neighbours have changed their normal.</summary>
    public int Class;
    /// <summary>Greatest depth of the contacts, m.</summary>
    public float Depth;
    /// <summary>
    /// Depth of the whole shapes along the normal, m; none where nobody has asked for it. Contacts are only where features overlap: of what leans a
    /// little, the lowest point may be beyond them.
    /// </summary>
    public float Overlap;
    /// <summary>What <see cref="Overlap"/> is where it is not known.</summary>
    public const float Unknown = float.MinValue;
    /// <summary>Place of the result, in the order of children.</summary>
    public int Slot;
    /// <summary>Whether it has taken the normal of another.</summary>
    public bool HasYielded;
    /// <summary>Patch that its contacts are in; -1 where there is none.</summary>
    public int Patch;
    /// <summary>
    /// Where the pairs of one body agree: number of the pair, whose own children have agreed before; zero where the children of a single pair do.
    /// </summary>
    public int Pair;
    /// <summary>Where the pairs of one body agree: a bit for each contact that was there in the last step.</summary>
    public int Remembered;
    /// <summary>Where the pairs of one body agree: only those whose other sides move alike do.</summary>
    public int Group;

    /// <summary>Order in which children are accepted.</summary>
    public struct Order : IComparerRef<RankedChild>
    {
        public readonly int Compare(ref RankedChild a, ref RankedChild b)
        {
            if (a.Class != b.Class)
                return a.Class - b.Class;
            var depths = b.Depth.CompareTo(a.Depth);
            return depths != 0 ? depths : a.Slot - b.Slot;
        }
    }
}

/// <summary>Makes the children of a pair agree on their normals: what one would push anyway need not be pushed in another direction, too.</summary>
/// <remarks>
/// <para>
/// Each child is tested as if it were alone. At a seam of two children that lie side by side, each has an edge, or a wall, that is inside of the
/// whole, and something that slides or rolls over the seam is stopped by what is not there. So children are accepted one by one, the deepest first.
/// One whose depth along the normal of an accepted one is no greater than the depth of that, to within a tolerance, yields: resolving that resolves
/// this as well. Its contacts are found once more along that normal; where the features do not overlap along it there are none.
/// </para>
/// <para>
/// A child yields only to one that it shares a child of either shape with: two boxes of one floor that touch the same ball. Nothing can be lost: what
/// has yielded is apart when what it has yielded to is, but for rotations.
/// </para>
/// </remarks>
static class ChildAgreement
{
    /// <summary>Part of a mover's inner radius by which it may be deeper than what it yields to: a lip of that height is none.</summary>
    public const float Tolerance = 1e-3f;

    // Cosine of 1e-3 rad: normals nearer to each other are one.
    const float SameNormal = 1 - 5e-7f;

    // Nobody yields to what points the other way, however thin he is: that way leads through.
    const float LeastCosine = -0.5f;

    /// <summary>Child of A of contacts of which it is not known: they share it with all others.</summary>
    public const int AnyChild = -1;

    // Directions that others may yield to. What comes after these is accepted as it is.
    const int MaximumLeaderCount = 32;

    /// <summary>Makes children agree.</summary>
    /// <param name="memory">The children that touch, in their order, and room for tests.</param>
    /// <param name="results">What was found for each child, and then what is left of it.</param>
    /// <param name="placed">Shapes and poses of each.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Run(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, BufferPool pool)
    {
        memory.Leaders.Count = 0;
        var ranked = memory.Ranked.AsSpan();
        for (int i = 0; i < ranked.Length && memory.Leaders.Count < MaximumLeaderCount; ++i)
        {
            if (ranked[i].HasYielded || HasLeader(memory.Leaders, ranked, results, i) || YieldsToNext(ref memory, results, placed, i, pool))
                continue;
            memory.Leaders.Add(i, pool);
            Offer(ref memory, results, placed, i, pool);
        }
    }

    // Whether those that might yield to it may yield to leaders with its normal as well: of these one shares its A, and one its B, if others have that, too.
    static bool HasLeader(in QuickList<int> leaders, Span<RankedChild> ranked, Span<ChildResult> results, int index)
    {
        ref var child = ref ranked[index];
        ref var result = ref results[child.Slot];
        var (hasA, hasB) = (false, false);
        for (int i = 0; i < leaders.Count && !(hasA && hasB); ++i)
        {
            ref var leader = ref ranked[leaders[i]];
            ref var accepted = ref results[leader.Slot];
            if (leader.Group != child.Group || !HasOneNormal(accepted.Manifold.Normal, result.Manifold.Normal))
                continue;
            hasA |= accepted.Children.A == result.Children.A || accepted.Children.A == AnyChild;
            hasB |= leader.Pair == child.Pair && accepted.Children.B == result.Children.B;
        }
        if (!hasA && (!hasB || result.Children.A == AnyChild || !IsAlone(ranked, results, index, byA: true)))
            return false;
        // Children of one pair have agreed when those of several do.
        return hasB || child.Pair != 0 || IsAlone(ranked, results, index, byA: false);
    }

    // Whether no child with another normal has its A, or its B.
    static bool IsAlone(Span<RankedChild> ranked, Span<ChildResult> results, int index, bool byA)
    {
        ref var result = ref results[ranked[index].Slot];
        foreach (ref var child in ranked)
        {
            ref var other = ref results[child.Slot];
            if ((byA ? other.Children.A == result.Children.A : other.Children.B == result.Children.B) &&
                !HasOneNormal(other.Manifold.Normal, result.Manifold.Normal))
            {
                return false;
            }
        }
        return true;
    }

    /// <summary>Whether two normals are nearer to each other than those of one surface may be.</summary>
    public static bool HasOneNormal(in Vector3 a, in Vector3 b) => Exact.Dot(a, b) > SameNormal;

    static bool SharesChild(in RankedChild a, in RankedChild b, in ChildIds idsA, in ChildIds idsB) =>
        idsA.A == idsB.A || idsA.A == AnyChild || idsB.A == AnyChild || (a.Pair == b.Pair && idsA.B == idsB.B);

    // Depths that are the same to within the tolerance are in no order: what would yield to one of those that come next, which would not yield to it, does
    // so. A step of a search may find a wall that is not there as deep as the floor, and a little deeper by rounding.
    static bool YieldsToNext(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, int index, BufferPool pool)
    {
        var ranked = memory.Ranked.AsSpan();
        ref var child = ref ranked[index];
        if (!placed[child.Slot].AreKnown)
            return false;
        if (!HasNext(ranked, results, placed, index))
            return false;
        var tolerance = placed[child.Slot].InnerRadius() * Tolerance;
        MeasureOverlaps(ref memory, results, placed, index, tolerance, pool);
        memory.Tests.Begin();
        for (int i = index + 1; i < ranked.Length && ranked[i].Class == child.Class && memory.Tests.Count < 2 * MaximumLeaderCount; ++i)
        {
            if (!MayYield(ranked[i], ranked[index], results, placed))
                continue;
            if (ranked[i].Depth < child.Depth - tolerance)
                break;
            memory.Tests.Add(placed[child.Slot], results[ranked[i].Slot].Manifold.Normal, ranked[i].Overlap + tolerance,
                placed[child.Slot].SpeculativeMargin, i, pool);
            memory.Tests.Add(placed[ranked[i].Slot], results[child.Slot].Manifold.Normal, child.Overlap + tolerance,
                placed[ranked[i].Slot].SpeculativeMargin, i, pool);
        }
        memory.Tests.Execute();
        for (int i = 0; i < memory.Tests.Count; i += 2)
        {
            if (!memory.Tests[i].IsWithinDepth || memory.Tests[i + 1].IsWithinDepth)
                continue;
            child.HasYielded = true;
            results[child.Slot].Replace(memory.Tests[i]);
            return true;
        }
        return false;
    }

    static bool HasNext(Span<RankedChild> ranked, Span<ChildResult> results, Span<PlacedChildren> placed, int index)
    {
        for (int i = index + 1; i < ranked.Length && ranked[i].Class == ranked[index].Class; ++i)
        {
            if (MayYield(ranked[i], ranked[index], results, placed))
                return true;
        }
        return false;
    }

    // Measures a child, and those that come next and are as deep.
    static void MeasureOverlaps(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, int index, float tolerance, BufferPool pool)
    {
        var ranked = memory.Ranked.AsSpan();
        memory.Tests.Begin();
        for (int i = index; i < ranked.Length && ranked[i].Class == ranked[index].Class && ranked[i].Depth >= ranked[index].Depth - tolerance; ++i)
        {
            if (ranked[i].Overlap == RankedChild.Unknown && placed[ranked[i].Slot].AreKnown && !ranked[i].HasYielded)
                memory.Tests.Add(placed[ranked[i].Slot], results[ranked[i].Slot].Manifold.Normal, float.MinValue, 0, i, pool);
        }
        memory.Tests.Execute();
        for (int i = 0; i < memory.Tests.Count; ++i)
        {
            ref var child = ref ranked[memory.Tests[i].Owner];
            child.Overlap = Math.Max(child.Depth, memory.Tests[i].Depth);
        }
    }

    // Whether one child, in the order of children, may yield to another at all.
    static bool MayYield(in RankedChild child, in RankedChild other, Span<ChildResult> results, Span<PlacedChildren> placed)
    {
        if (child.HasYielded || !placed[child.Slot].AreKnown || child.Group != other.Group || (child.Pair != 0 && child.Pair == other.Pair) ||
            !SharesChild(child, other, results[child.Slot].Children, results[other.Slot].Children))
        {
            return false;
        }
        var cosine = Exact.Dot(results[child.Slot].Manifold.Normal, results[other.Slot].Manifold.Normal);
        return cosine is >= LeastCosine and <= SameNormal;
    }

    // Lets all that come later yield to a leader.
    static void Offer(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, int leader, BufferPool pool)
    {
        var ranked = memory.Ranked.AsSpan();
        ref var accepted = ref results[ranked[leader].Slot];
        var next = leader + 1;
        while (next < ranked.Length && !MayYield(ranked[next], ranked[leader], results, placed))
            ++next;
        if (next == ranked.Length)
            return;
        if (placed[ranked[leader].Slot].AreKnown)
            MeasureOverlaps(ref memory, results, placed, leader, 0, pool);
        else
            ranked[leader].Overlap = ranked[leader].Depth;
        memory.Tests.Begin();
        for (int i = next; i < ranked.Length; ++i)
        {
            if (!MayYield(ranked[i], ranked[leader], results, placed))
                continue;
            var slot = ranked[i].Slot;
            var depth = ranked[leader].Overlap + placed[slot].InnerRadius() * Tolerance;
            memory.Tests.Add(placed[slot], accepted.Manifold.Normal, depth, placed[slot].SpeculativeMargin, i, pool);
        }
        memory.Tests.Execute();
        for (int i = 0; i < memory.Tests.Count; ++i)
        {
            ref var test = ref memory.Tests[i];
            if (!test.IsWithinDepth)
                continue;
            ranked[test.Owner].HasYielded = true;
            results[ranked[test.Owner].Slot].Replace(test);
        }
    }
}
