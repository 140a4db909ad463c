using System.Diagnostics;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Two children that touch, by what makes one come before another.</summary>
struct RankedChild
{
    /// <summary>0 for contacts that are as the test found them; 1 where a triangle's neighbours have changed their normal.</summary>
    public int Class;
    /// <summary>Whether its contacts are those of a triangle's neighbours, if these have any: it has none then.</summary>
    public bool IsOfNeighbours;
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
    /// <summary>Whether it has another normal than the test has found, as it will have that when it touches.</summary>
    public bool IsTurned;
    /// <summary>Whether it is not as the test has found it.</summary>
    public readonly bool HasChanged => HasYielded || IsTurned;
    /// <summary>Of a leader, whose normal others may take: the one that was accepted before it; negative for the first.</summary>
    public int PreviousLeader;
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
    /// <summary>Of those that may yield: one more than the place of the last leader that they were asked to yield to.</summary>
    public int Asked;
    /// <summary>Depth by which it may be deeper than what it yields to, m; zero where nobody has asked for it.</summary>
    public float Tolerance;

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
/// A child yields only to a normal of one that it shares a child of either shape with: two boxes of one floor that touch the same ball. Nothing can be
/// lost: what has yielded is apart when what it has yielded to is, but for rotations.
/// </para>
/// </remarks>
static class ChildAgreement
{
    /// <summary>Part of a mover's inner radius: a lip of that height is none.</summary>
    public const float GreatestLip = 1e-3f;

    // Part of it by which a mover may be deeper than what it yields to: such a lip, as rounding of places may show it.
    const float Tolerance = 1.05f * GreatestLip;

    // Cosine of 1e-3 rad: normals nearer to each other are one.
    const float SameNormal = 1 - 5e-7f;

    // Distance of two unit normals up to which one says nothing that the other does not. At 20 m/s a body is thrown up by 1 mm/s by a normal that is off by
    // so much.
    const float EqualNormal = 5e-5f;

    // Cosine of 1e-2 rad: normals nearer to each other may be those of one face, as two tests have found it.
    const float NearNormal = 1 - 5e-5f;

    // Fewer contacts are those of an edge, or of a point.
    const int LeastFaceCount = 3;

    // Nobody yields to what points the other way, however thin he is: that way leads through.
    const float LeastCosine = -0.5f;

    /// <summary>Child of A of contacts of which it is not known: they share it with all others.</summary>
    public const int AnyChild = -1;

    // Directions that others may yield to. What comes after these is accepted as it is.
    const int MaximumLeaderCount = 32;

    /// <summary>Brings the children of a set in order.</summary>
    public static unsafe void Begin(in SeamView view)
    {
        ref var set = ref view.Set;
        set.Count = SeamMemory.Sort(view.Ranked, set.Results);
        set.Index = set.LastLeader = -1;
        // What is alone agrees with itself.
        set.Stage = set.Count > 1 ? SeamStage.Next : SeamStage.Done;
    }

    /// <summary>Works on a set, until tests are to be looked at or all children agree.</summary>
    /// <param name="tests">What the last round has found, and room for the tests of the next.</param>
    /// <param name="view">The children that touch, in their order.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Advance(ref DirectedTests tests, in SeamView view, BufferPool pool)
    {
        ref var set = ref view.Set;
        switch (set.Stage)
        {
            case SeamStage.Next:
                FindNext(ref tests, view, pool);
                break;
            case SeamStage.Prepared:
                Prepare(ref tests, view, pool);
                break;
            case SeamStage.Rivals:
                if (YieldsToRival(tests, view))
                    set.Stage = SeamStage.Next;
                else
                    Accept(ref tests, view, pool);
                break;
            case SeamStage.Followers:
                var count = tests.Count;
                for (int i = set.Tests.First; i < set.Tests.End; ++i)
                    Follow(view, tests[i]);
                // Those that have taken the normal offer it to others.
                if (set.Tests.Count > 0)
                    AddFollowers(ref tests, view, pool);
                if (tests.Count == count)
                    set.Stage = SeamStage.Next;
                break;
            default:
                throw new UnreachableException();
        }
    }

    static void FindNext(ref DirectedTests tests, in SeamView view, BufferPool pool)
    {
        ref var set = ref view.Set;
        var ranked = view.Ranked;
        do
        {
            ++set.Index;
            if (set.Index >= ranked.Length || set.LeaderCount == MaximumLeaderCount)
            {
                set.Stage = SeamStage.Done;
                return;
            }
        }
        while (ranked[set.Index].HasYielded || HasLeader(view, set.Index));
        if (ForeseenContacts.Begin(view))
        {
            set.HasForeseen = true;
            set.Stage = SeamStage.Foreseen;
        }
        else
            Prepare(ref tests, view, pool);
    }

    static void Prepare(ref DirectedTests tests, in SeamView view, BufferPool pool)
    {
        ref var set = ref view.Set;
        if (view.Placed(view.Ranked[set.Index]).AreKnown)
        {
            AddRivals(ref tests, view, pool);
            set.Stage = SeamStage.Rivals;
        }
        else
            Accept(ref tests, view, pool);
    }

    // Whether those that might yield to it may yield to a leader with its normal as well, as that is offered to all that it might be offered to. Children of
    // one pair have agreed when those of several do.
    static bool HasLeader(in SeamView view, int index)
    {
        ref var child = ref view.Ranked[index];
        for (int i = view.Set.LastLeader; i >= 0; i = view.Ranked[i].PreviousLeader)
        {
            if (view.Ranked[i].Group == child.Group && HasOneNormal(view, view.Ranked[i], child))
                return true;
        }
        return false;
    }

    static bool HasOneNormal(in SeamView view, in RankedChild a, in RankedChild b) =>
        HasOneNormal(view.Result(a).Manifold.Normal, view.Result(b).Manifold.Normal);

    /// <summary>Whether two normals are nearer to each other than those of one surface may be.</summary>
    public static bool HasOneNormal(in Vector3 a, in Vector3 b) => Exact.Dot(a, b) > SameNormal;

    /// <summary>Whether two normals are the same, to within what changes nothing.</summary>
    public static bool HasEqualNormal(in Vector3 a, in Vector3 b) => Exact.DistanceSquared(a, b) <= EqualNormal * EqualNormal;

    // Whether the normal of a leader is offered to a child: by the leader itself, or by another child with its normal. A body is moved as a whole, but what one
    // leg stands on says nothing of what another meets that stands on nothing.
    static bool IsOffered(in RankedChild child, in RankedChild leader, in SeamView view, ref NormalOfferers offerers)
    {
        if (MayOffer(leader, child) && SharesChild(child, leader, view))
            return true;
        for (int i = offerers.First(leader, view); i < view.Ranked.Length; i = offerers.Next(i, leader, view))
        {
            ref var other = ref view.Ranked[i];
            if (MayOffer(other, child) && SharesChild(child, other, view))
                return true;
        }
        return false;
    }

    // Children of one pair have agreed when those of several do.
    static bool MayOffer(in RankedChild leader, in RankedChild child) => child.Pair == 0 || child.Pair != leader.Pair;

    static bool SharesChild(in RankedChild a, in RankedChild b, in SeamView view)
    {
        ref readonly var idsA = ref view.Result(a).Children;
        ref readonly var idsB = ref view.Result(b).Children;
        return idsA.A == idsB.A || idsA.A == AnyChild || idsB.A == AnyChild || (a.Pair == b.Pair && idsA.B == idsB.B) || AreOfSurface(a, b, view);
    }

    // Triangles of one body are one thing: what its side is stopped by is what its bottom, which has an edge with it, lies on.
    static bool AreOfSurface(in RankedChild a, in RankedChild b, in SeamView view) =>
        view.Placed(a).TypeA == Triangle.Id && view.Placed(b).TypeA == Triangle.Id;

    // Whether one child, in the order of children, may yield to another at all.
    static bool MayYield(in RankedChild child, in RankedChild other, in SeamView view, ref NormalOfferers offerers)
    {
        if (child.HasYielded || child.Group != other.Group)
            return false;
        ref var result = ref view.Result(child);
        ref var accepted = ref view.Result(other);
        return Exact.Dot(result.Manifold.Normal, accepted.Manifold.Normal) >= LeastCosine &&
            !HasEqualNormal(result.Manifold.Normal, accepted.Manifold.Normal) && IsOffered(child, other, view, ref offerers) &&
            view.Placed(child).AreKnown;
    }

    // Depth by which a child may be deeper than what it yields to.
    static float ToleranceOf(ref RankedChild child, in SeamView view)
    {
        if (child.Tolerance == 0)
            child.Tolerance = view.Placed(child).InnerRadius() * Tolerance;
        return child.Tolerance;
    }

    // Measures a child along its normal, when that is asked for.
    static float OverlapOf(ref RankedChild child, in SeamView view)
    {
        if (child.Overlap == RankedChild.Unknown)
        {
            ref var placed = ref view.Placed(child);
            child.Overlap = placed.AreKnown ? MathHelper.Max(child.Depth, placed.DepthAlong(view.Result(child).Manifold.Normal)) : child.Depth;
        }
        return child.Overlap;
    }

    // Depths that are the same to within the tolerance are in no order: what would yield to one of those that come next, which would not yield to it, does
    // so. A step of a search may find a wall that is not there as deep as the floor, and a little deeper by rounding. Two tests for each rival.
    static void AddRivals(ref DirectedTests tests, in SeamView view, BufferPool pool)
    {
        var ranked = view.Ranked;
        var index = view.Set.Index;
        ref var child = ref ranked[index];
        var tolerance = ToleranceOf(ref child, view);
        var first = tests.Count;
        NormalOfferers offerers = default;
        for (int i = index + 1; i < ranked.Length && ranked[i].Class == child.Class && tests.Count - first < 2 * MaximumLeaderCount; ++i)
        {
            if (ranked[i].Depth < child.Depth - tolerance)
                break;
            if (!MayYield(ranked[i], child, view, ref offerers))
                continue;
            if (CannotFollow(view, index, i, tolerance) && CannotFollow(view, i, index, tolerance))
                continue;
            var areNear = Exact.Dot(view.Result(ranked[i]).Manifold.Normal, view.Result(child).Manifold.Normal) > NearNormal;
            AddFollower(ref tests, view, index, i, tolerance, pool, areNear);
            AddFollower(ref tests, view, i, index, tolerance, pool, areNear);
        }
    }

    static bool YieldsToRival(in DirectedTests tests, in SeamView view)
    {
        var last = view.Set.Tests;
        for (int i = last.First; i < last.End; i += 2)
        {
            if (tests[i].IsWithinDepth && (!tests[i + 1].IsWithinDepth || IsOfFace(tests[i], tests[i + 1])))
            {
                Follow(view, tests[i]);
                return true;
            }
        }
        return false;
    }

    // Of two that would yield to each other, with normals that may be those of one face: whether only the rival's is. The end of what is round, or an edge of
    // what leans, that is over the border of a child has a normal that leans by a little, and is as deep as what lies on the face of the next.
    static bool IsOfFace(in DirectedPair test, in DirectedPair rival) =>
        HasEqualNormal(test.Normal, rival.Face) && !HasEqualNormal(rival.Normal, test.Face) && Exact.Dot(test.Normal, rival.Normal) > NearNormal;

    // Lets all that come later yield to a child. Whether its rivals do is known.
    static void Accept(ref DirectedTests tests, in SeamView view, BufferPool pool)
    {
        ref var set = ref view.Set;
        view.Ranked[set.Index].PreviousLeader = set.LastLeader;
        set.LastLeader = set.Index;
        ++set.LeaderCount;
        AddFollowers(ref tests, view, pool);
        set.Stage = SeamStage.Followers;
    }

    static void AddFollowers(ref DirectedTests tests, in SeamView view, BufferPool pool)
    {
        var index = view.Set.Index;
        // Of two tests of a rival the second says whether it follows.
        var known = view.Set.Stage == SeamStage.Rivals ? view.Set.Tests.First + 1 : view.Set.Tests.End;
        NormalOfferers offerers = default;
        for (int i = index + 1; i < view.Ranked.Length; ++i)
        {
            var isRival = known < view.Set.Tests.End && tests[known].Owner == i;
            if (view.Ranked[i].Asked == index + 1)
                continue;
            if (isRival || MayYield(view.Ranked[i], view.Ranked[index], view, ref offerers))
            {
                view.Ranked[i].Asked = index + 1;
                var tolerance = ToleranceOf(ref view.Ranked[i], view);
                // A rival was allowed what the leader is, which may be another child of the body.
                if (isRival && tests[known].GreatestDepth == OverlapOf(ref view.Ranked[index], view) + tolerance)
                {
                    Follow(view, tests[known]);
                    offerers.Forget();
                }
                else if (!CannotFollow(view, i, index, tolerance))
                    AddFollower(ref tests, view, i, index, tolerance, pool);
            }
            known += isRival ? 2 : 0;
        }
    }

    // Whether it is known without a test that a child is too deep along the normal of a leader: a floor has no way out to its sides. A triangle hardly ever is.
    static bool CannotFollow(in SeamView view, int follower, int leader, float tolerance)
    {
        ref var placed = ref view.Placed(view.Ranked[follower]);
        return placed.TypeA != Triangle.Id && placed.TypeB != Triangle.Id &&
            placed.AreDeeper(view.Result(view.Ranked[leader]).Manifold.Normal, OverlapOf(ref view.Ranked[leader], view) + tolerance);
    }

    static void AddFollower(ref DirectedTests tests, in SeamView view, int follower, int leader, float tolerance, BufferPool pool, bool findsFace = false)
    {
        ref var placed = ref view.Placed(view.Ranked[follower]);
        var normal = view.Result(view.Ranked[leader]).Manifold.Normal;
        tests.Add(placed, normal, OverlapOf(ref view.Ranked[leader], view) + tolerance, placed.SpeculativeMargin, follower, pool, findsFace);
    }

    static void Follow(in SeamView view, in DirectedPair test)
    {
        if (!test.IsWithinDepth)
            return;
        ref var child = ref view.Ranked[test.Owner];
        child.HasYielded = true;
        ref var result = ref view.Result(child);
        // What lies on its face to within what it leans goes on with the contacts that its pair remembers.
        if (result.Manifold.Count >= LeastFaceCount && HasOneNormal(result.Manifold.Normal, test.Normal))
            result.Manifold.Normal = test.Normal;
        else
            result.Replace(test);
    }
}
