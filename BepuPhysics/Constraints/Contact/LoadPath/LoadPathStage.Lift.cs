using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What overlaps what carries it is moved out of it, and all that it carries along with it.
//
// Held contacts that took their overlaps out by velocities would be at odds with the load path. The deeper corner of a patch that lies askew is pushed out by
// itself, which turns the body about its centre; friction, which holds the face, moves the centre aside; the patch above stops the turn and leaves that. The
// transfer takes what is left for a load, and finds friction that stops it, which the next sweep takes back. Stacks walked aside by that until they fell, and
// what had sunk in by some centimetres took ten seconds to come out, as the transfer stopped it in each substep.
//
// So contacts through which a load is handed down know no overlap, and in each step it is taken out of the poses: from the ground upwards each body goes
// with what is below and out of its own overlaps, by the least squares of its contacts, like a thing that is glued to them. No velocity tells of it.
sealed unsafe partial class LoadPathStage
{
    // Part of the band to which it is taken out, so that it comes to an end.
    const float AimedBand = 0.9375f;
    // Steps of acceleration up to which what rests is lifted.
    const float CalmSteps = 0.25f;

    void Lift(int island, int block, in Substep substep)
    {
        var start = graph.Islands[island];
        var end = graph.Islands[island + 1];
        var firstSupport = graph.Nodes[start].FirstSupport;
        var part = 1 - Left(solver.LastSubstepCount);
        var greatest = substep.Dt * solver.LastSubstepCount;
        var supports = ReadSupports(island, block);
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (GoesAlong(node))
                Lift(ref node, SupportsOf(node, supports, firstSupport), part, greatest);
        }
    }

    // What is left of an overlap.
    static float Left(int substepCount)
    {
        var left = 1f;
        for (int i = 0; i < substepCount; ++i)
            left *= 1 - ContactMaterialWide.HeldRecovery;
        return left;
    }

    // What something else touches or holds is left to velocities, which that may withstand: bricks that were turned by their poses pushed their neighbours
    // apart, until the last of a row fell.
    bool MayLift(in LoadNode node) =>
        !node.Leans && IsCalm(node) && bodies.Awake.Constraints[node.Body].Count == node.SupportCount + graph.CountAbove(node.Body);

    // What still moves sways, lands or goes aside: what is under it now is not what it will lie on.
    bool IsCalm(in LoadNode node)
    {
        ref var set = ref bodies.Awake;
        ref var motion = ref set.MotionStates[node.Body];
        var floor = MotionOf(node, 0);
        var speed = Exact.Length(before[node.Body].Linear - floor.At(motion.Pose.Position)) +
            Exact.Length(motion.Velocity.Angular - floor.Angular) * node.Radius;
        return speed <= CalmSteps * solver.LastSubstepCount * node.Gain;
    }

    bool GoesAlong(in LoadNode node)
    {
        if (node.Overlaps)
            return true;
        for (int i = node.FirstSupport; i < node.FirstSupport + node.SupportCount; ++i)
        {
            var (way, turn) = WayOf(graph.Links[i].Lower);
            if (way != default || turn != default)
                return MayLift(node);
        }
        return false;
    }

    void Lift(ref LoadNode node, Span<LoadSupport> supports, float part, float greatest)
    {
        var normal = LoadTransfer.MeanNormal(supports, out _);
        LoadTransfer.Axes(normal, out var x, out var y);
        var inverseRadius = node.Radius > 0 ? 1 / node.Radius : 0;
        Symmetric3x3 system = default;
        Vector3 wanted = default, along = default;
        float twist = 0;
        for (int i = 0; i < supports.Length; ++i)
        {
            ref var support = ref supports[i];
            ref var link = ref graph.Links[node.FirstSupport + i];
            var (way, turn) = WayOf(support.Lower);
            along += way + Exact.Cross(turn, support.Center - support.ToLower);
            twist += Exact.Dot(turn, normal);
            var most = greatest * link.MaximumRecoveryVelocity;
            for (int j = 0; j < support.Count; ++j)
            {
                if ((support.Open & 1 << j) != 0)
                    continue;
                var lift = MathHelper.Min(MathHelper.Max(0, (DepthOf(link, j) + link.Spring * AimedBand) * part), most);
                var row = LoadTransfer.Row(support, j, normal, x, y, inverseRadius);
                wanted += row * (Exact.Dot(way + Exact.Cross(turn, support.Arms[j] - support.ToLower), support.Normal) + lift);
                LoadTransfer.AddSquare(ref system, row);
            }
        }
        if (!LoadTransfer.TrySolve(system, wanted, out var found))
            return;
        var share = 1f / supports.Length;
        node.Turn = (x * found.Y + y * found.Z) * inverseRadius + normal * (twist * share);
        // The faces do not slide on each other.
        along *= share;
        foreach (ref var support in supports)
            along -= Exact.Cross(node.Turn, support.Center) * share;
        node.Way = along + normal * (found.X - Exact.Dot(along, normal));
        bodies.Awake.Move(node.Body, node.Way);
        bodies.Awake.Turn(node.Body, node.Turn);
    }

    (Vector3 Way, Vector3 Turn) WayOf(int lower)
    {
        if (lower < 0)
            return default;
        ref var node = ref graph.Nodes[graph.NodeOf[lower]];
        return (node.Way, node.Turn);
    }
}
