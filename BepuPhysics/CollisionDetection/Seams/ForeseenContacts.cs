using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>How one child moves relative to another within a step.</summary>
struct ChildMotion
{
    /// <summary>Way of A's centre as B sees it, m.</summary>
    public Vector3 Way;
    /// <summary>Angle by which A turns relative to B, rad, along its axis.</summary>
    public Vector3 Turn;

    /// <summary>Writes how two children move.</summary>
    /// <param name="a">Velocity of the body of A.</param>
    /// <param name="b">Velocity of the body of B.</param>
    /// <param name="offsetA">Centre of A less that of its body.</param>
    /// <param name="offsetB">Centre of the body of B less that of the body of A.</param>
    /// <param name="dt">Length of the step, s.</param>
    // In place: what is made elsewhere first is copied as a whole, and waits for its parts.
    public void Write(in BodyVelocity a, in BodyVelocity b, in Vector3 offsetA, in Vector3 offsetB, float dt)
    {
        Way = (a.Linear - b.Linear + Exact.Cross(a.Angular, offsetA) - Exact.Cross(b.Angular, offsetA - offsetB)) * dt;
        Turn = (a.Angular - b.Angular) * dt;
    }
}

/// <summary>Where a contact that is foreseen is followed to.</summary>
struct Foresight
{
    /// <summary>Way of A as B sees it within the step, m, with what the contacts before this leave of it.</summary>
    public Vector3 Way;
    /// <summary>From where A is to where it would be if it had not sunk into what carries it, m.</summary>
    public Vector3 Rise;
    /// <summary>Part of the step after which the two were tested last.</summary>
    public float Time;
    /// <summary>Number of tests.</summary>
    public int TestCount;
    /// <summary>What the last test has found.</summary>
    public ConvexContactManifold Manifold;
}

/// <summary>Gives contacts that are foreseen the normal that they will have when they touch.</summary>
/// <remarks>
/// <para>
/// A contact of shapes that are apart keeps them on one side of a plane, as they are at the beginning of the step. That is a wall where none is, if the normal
/// turns on the way there: a ball that rolls to a lip of a tenth of a millimetre has its edge far ahead and hardly below its centre, and comes over it
/// all the same. So two that would touch within the step are tested again where they will be then, until they do, or have passed each other.
/// </para>
/// <para>
/// The way is a straight one, and of it is taken what other contacts of the body leave: what lies on a floor does not fall to the edge ahead. Along a straight
/// way the distance along one normal never is greater than the distance, so that no touch is passed. What is of a turn rather than of a way stays as it is.
/// </para>
/// </remarks>
static class ForeseenContacts
{
    // Part of the mover's inner radius: what is nearer touches. A ball meets an edge at an angle to the normal of the floor that is by a hundredth wrong then.
    const float Touches = 5e-5f;

    // Part of an approach that may be of a turn.
    const float TurnShare = 0.25f;

    // Part of a way that is along it: where an edge comes down on an edge, either side of it touches.
    const float Graze = 1e-3f;

    // A normal that turns away is followed by half of what is left of its way each time.
    const int MaximumTestCount = 12;

    /// <summary>Prepares to follow a child on its way, if its contacts would stop it within the step before it is there.</summary>
    /// <returns>Whether it is to be followed.</returns>
    public static bool Begin(in SeamView view)
    {
        ref var child = ref view.Ranked[view.Set.Index];
        ref var placed = ref view.Placed(child);
        var gap = -child.Depth;
        // Two triangles that touch may as well be behind each other: where they would meet says nothing.
        if (!(gap > 0) || !placed.AreKnown || placed.Motion.Way == default || placed.AreTriangles)
            return false;
        ref var result = ref view.Result(child);
        var normal = result.Manifold.Normal;
        Predict(view, child, out var way, out var rise);
        var approach = -Exact.Dot(way, normal);
        if (!(approach > gap) || gap < placed.InnerRadius() * Touches || TurnOf(result, placed, normal) > TurnShare * approach)
            return false;
        ref var foresight = ref view.Set.Foresight;
        foresight.Way = way;
        foresight.Rise = rise;
        foresight.Time = MathHelper.Max(0, gap + Exact.Dot(rise, normal)) / approach;
        foresight.TestCount = 0;
        return true;
    }

    // What the contacts of those that were accepted leave of its way, and of its depth. The deepest counts last, and whole.
    static void Predict(in SeamView view, in RankedChild child, out Vector3 way, out Vector3 rise)
    {
        way = view.Placed(child).Motion.Way;
        rise = default;
        for (int i = view.Set.LastLeader; i >= 0; i = view.Ranked[i].PreviousLeader)
        {
            ref var leader = ref view.Ranked[i];
            if (leader.Group != child.Group)
                continue;
            var normal = view.Result(leader).Manifold.Normal;
            way += normal * MathHelper.Max(0, -Exact.Dot(way, normal) - MathHelper.Max(0, -leader.Depth));
            rise += normal * MathHelper.Max(0, leader.Depth - Exact.Dot(rise, normal));
        }
    }

    // The greatest way along the normal that a contact makes by the turn of the child.
    static float TurnOf(in ChildResult result, in PlacedChildren placed, in Vector3 normal)
    {
        var greatest = 0f;
        for (int i = 0; i < result.Manifold.Count; ++i)
        {
            var arm = result.Manifold.Read(i).Offset - result.OffsetA;
            greatest = MathHelper.Max(greatest, Math.Abs(Exact.Dot(Exact.Cross(placed.Motion.Turn, arm), normal)));
        }
        return greatest;
    }

    /// <summary>Follows a child to where it touches.</summary>
    /// <param name="tests">Receives the next test.</param>
    /// <param name="view">The children that touch, in their order.</param>
    /// <param name="owner">Number of their set.</param>
    /// <param name="sets">All sets.</param>
    /// <param name="registry">The tasks that test pairs.</param>
    /// <param name="pool">Source of memory.</param>
    public static unsafe void Advance(ref MovedTests tests, in SeamView view, int owner, SeamSet* sets, CollisionTaskRegistry registry, BufferPool pool)
    {
        ref var set = ref view.Set;
        ref var foresight = ref set.Foresight;
        ref var child = ref view.Ranked[set.Index];
        ref var placed = ref view.Placed(child);
        if (foresight.TestCount > 0)
        {
            var approach = -Exact.Dot(foresight.Way, foresight.Manifold.Normal);
            var gap = -foresight.Manifold.GreatestDepth;
            var touches = gap <= placed.InnerRadius() * Touches;
            if (foresight.Manifold.Count == 0 || (approach <= 0 && !touches))
            {
                view.Result(child).Manifold.Count = 0;
                child.HasYielded = true;
                set.Stage = SeamStage.Next;
                return;
            }
            // What is not there at the end of the step has a plane that does not stop it before that, however it grazes.
            if (touches || foresight.TestCount == MaximumTestCount || foresight.Time + gap / approach >= 1)
            {
                if (!touches || approach > Graze * Exact.Length(foresight.Way) || HasLeaderAlong(view, foresight.Manifold.Normal))
                    Take(ref view.Result(child), ref child, placed, foresight, approach);
                set.Stage = SeamStage.Prepared;
                return;
            }
            foresight.Time += gap / approach;
        }
        ++foresight.TestCount;
        tests.Add(placed, foresight.Rise + foresight.Way * foresight.Time, owner, sets, registry, pool);
    }

    // What is grazed and carries nothing yet would be no more than passed: the contact stays as it is then.
    static bool HasLeaderAlong(in SeamView view, in Vector3 normal)
    {
        for (int i = view.Set.LastLeader; i >= 0; i = view.Ranked[i].PreviousLeader)
        {
            if (ChildAgreement.HasOneNormal(view.Result(view.Ranked[i]).Manifold.Normal, normal))
                return true;
        }
        return false;
    }

    // Depths are those at the beginning of the step, along the new normal. Where it has not turned, or would turn to where a neighbour is, all is as it was.
    static void Take(ref ChildResult result, ref RankedChild child, in PlacedChildren placed, in Foresight foresight, float approach)
    {
        if (ChildAgreement.HasOneNormal(result.Manifold.Normal, foresight.Manifold.Normal) || TriangleNeighbours.Has(placed, foresight.Manifold.Normal))
            return;
        var offsetB = result.Manifold.OffsetB;
        result.Manifold = foresight.Manifold;
        var moved = Exact.Dot(foresight.Rise, foresight.Manifold.Normal) - approach * foresight.Time;
        for (int i = 0; i < result.Manifold.Count; ++i)
            result.Manifold.AddDepth(i, moved);
        result.MoveToParent(offsetB);
        child.Depth = result.Manifold.GreatestDepth;
        child.IsTurned = true;
    }
}
