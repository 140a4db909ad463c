using System;
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
    /// <summary>Place of the result, in the order of children.</summary>
    public int Slot;
    /// <summary>Whether it has taken the normal of another.</summary>
    public bool HasYielded;
    /// <summary>Patch that its contacts are in; -1 where there is none.</summary>
    public int Patch;

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

    // Directions that others may yield to. What comes after these is accepted as it is.
    const int MaximumLeaderCount = 32;

    /// <summary>Makes children agree.</summary>
    /// <param name="memory">The children that touch, in their order, and room for tests.</param>
    /// <param name="results">What was found for each child, and then what is left of it.</param>
    /// <param name="placed">Shapes and poses of each.</param>
    /// <param name="margin">Greatest distance at which a contact exists, m.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Run(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, float margin, BufferPool pool)
    {
        memory.Leaders.Count = 0;
        var ranked = memory.Ranked.AsSpan();
        for (int i = 0; i < ranked.Length && memory.Leaders.Count < MaximumLeaderCount; ++i)
        {
            if (ranked[i].HasYielded || HasLeader(memory.Leaders, ranked, results, i) || YieldsToNext(ref memory, results, placed, i, margin, pool))
                continue;
            memory.Leaders.Add(i, pool);
            Offer(ref memory, results, placed, i, margin, pool);
        }
    }

    // Whether a leader that it may yield to has its normal.
    static bool HasLeader(in QuickList<int> leaders, Span<RankedChild> ranked, Span<ChildResult> results, int index)
    {
        ref var result = ref results[ranked[index].Slot];
        for (int i = 0; i < leaders.Count; ++i)
        {
            ref var leader = ref results[ranked[leaders[i]].Slot];
            if (SharesChild(leader.Children, result.Children) && Exact.Dot(leader.Manifold.Normal, result.Manifold.Normal) > SameNormal)
                return true;
        }
        return false;
    }

    static bool SharesChild(in ChildIds a, in ChildIds b) => a.A == b.A || a.B == b.B;

    // Depths that are the same to within the tolerance are in no order: what would yield to one of those that come next, which would not yield to it, does
    // so. A step of a search may find a wall that is not there as deep as the floor, and a little deeper by rounding.
    static bool YieldsToNext(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, int index, float margin, BufferPool pool)
    {
        var ranked = memory.Ranked.AsSpan();
        ref var child = ref ranked[index];
        if (!placed[child.Slot].AreKnown)
            return false;
        var tolerance = -1f;
        memory.Tests.Begin();
        for (int i = index + 1; i < ranked.Length && ranked[i].Class == child.Class && memory.Tests.Count < 2 * MaximumLeaderCount; ++i)
        {
            if (!MayYield(ranked[i], ranked[index], results, placed))
                continue;
            if (tolerance < 0)
                tolerance = placed[child.Slot].InnerRadius() * Tolerance;
            if (ranked[i].Depth < child.Depth - tolerance)
                break;
            memory.Tests.Add(placed[child.Slot], results[ranked[i].Slot].Manifold.Normal, ranked[i].Depth + tolerance, margin, i, pool);
            memory.Tests.Add(placed[ranked[i].Slot], results[child.Slot].Manifold.Normal, child.Depth + tolerance, margin, i, pool);
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

    // Whether one child, in the order of children, may yield to another at all.
    static bool MayYield(in RankedChild child, in RankedChild other, Span<ChildResult> results, Span<PlacedChildren> placed)
    {
        if (child.HasYielded || !placed[child.Slot].AreKnown || !SharesChild(results[child.Slot].Children, results[other.Slot].Children))
            return false;
        var cosine = Exact.Dot(results[child.Slot].Manifold.Normal, results[other.Slot].Manifold.Normal);
        return cosine is >= LeastCosine and <= SameNormal;
    }

    // Lets all that come later yield to a leader.
    static void Offer(ref SeamMemory memory, Span<ChildResult> results, Span<PlacedChildren> placed, int leader, float margin, BufferPool pool)
    {
        var ranked = memory.Ranked.AsSpan();
        ref var accepted = ref results[ranked[leader].Slot];
        memory.Tests.Begin();
        for (int i = leader + 1; i < ranked.Length; ++i)
        {
            if (!MayYield(ranked[i], ranked[leader], results, placed))
                continue;
            var slot = ranked[i].Slot;
            var depth = ranked[leader].Depth + placed[slot].InnerRadius() * Tolerance;
            memory.Tests.Add(placed[slot], accepted.Manifold.Normal, depth, margin, i, pool);
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
