using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Moves the load of what rests on others down to the ground in one go, where the sweeps have not yet.</summary>
// A sweep moves a load over one contact. So a stack of n bodies knows its weight after n of them, and until then it sinks; contacts that are soft enough
// to be stable meanwhile stay soft, and a stack of 100 boxes a metre shorter. Here each body, from the top down, hands the momentum that it has left after
// the warm start to what it rests on (LoadTransfer); what that does to all of an island is taken as far as it lowers the kinetic energy of the island, which
// at rest is the measure of what contacts are after, so that the stage can give none.
//
// The contacts through which a load is handed are held: they keep the speed of their surfaces at zero with no softness, and know no overlap within a band
// about zero. A soft row would give back in the sweep what it was handed.
//
// Only contacts that are quiet carry: their surfaces move no faster along or apart than the acceleration from outside gives in two steps. What
// slides, rolls fast, tumbles or is hit is left to the sweeps, and so is what rests on something that moves.
sealed unsafe class LoadPathStage(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    // Islands share this many blocks; any number gives the same bits.
    const int Blocks = 16;
    // Steps of acceleration up to which a contact is quiet.
    const float QuietSteps = 2;
    // Least part of the acceleration from outside along the normal of a contact that carries against it: 37 degrees. What leans on steeper faces, as the
    // stones of an arch, is held by both of its neighbours at once, and no order from the top down is right for it.
    const float LeastSlope = 0.8f;
    // Half the width of the band in which a contact knows no overlap, per size of the smaller body.
    const float BandPerSize = 5e-4f;
    const float LeastBand = 1e-30f;
    // Velocity left after the warm start, per that from outside, from which on an island is worked on.
    const float LeastResidual = 0.02f;
    // The same, per that of a fall by the distance from a body's centre to its contacts, as strong gravity and small bodies make the first great for it.
    const float LeastFall = 3e-4f;
    // Part of that from which on a body takes part, and from which on an island is worked on again that was worked on in the last substep.
    const float ActiveShare = 0.05f;

    SupportGraph graph;
    // Velocities before the first integration, then what it has changed.
    Buffer<Vector3> gains;

    LoadPathMode Mode => solver.LoadPath;

    int ISolverStage.GetBlockCount(SolverPoint point)
    {
        if (Mode == LoadPathMode.Off)
            return 0;
        return point switch
        {
            SolverPoint.BeforeSubsteps or SolverPoint.BeforeWarmStart => 1,
            SolverPoint.AfterWarmStart => Blocks,
            _ => 0,
        };
    }

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        switch (point)
        {
            case SolverPoint.BeforeSubsteps:
                RememberVelocities();
                break;
            case SolverPoint.BeforeWarmStart when substep.Index == 0:
                Build(substep.Dt);
                break;
            case SolverPoint.AfterWarmStart:
                for (int island = block; island < graph.Islands.Count - 1; island += Blocks)
                    Transfer(island);
                break;
        }
    }

    void RememberVelocities()
    {
        ref var set = ref bodies.Awake;
        pool.TakeAtLeast(Math.Max(1, set.Count), out gains);
        for (int i = 0; i < set.Count; ++i)
            gains[i] = set.MotionStates[i].Velocity.Linear;
    }

    void Build(float dt)
    {
        ref var set = ref bodies.Awake;
        for (int i = 0; i < set.Count; ++i)
            gains[i] = set.MotionStates[i].Velocity.Linear - gains[i];
        ref var batches = ref solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            if (batches[i].Kind != BatchKind.Coloured)
                continue;
            for (int j = 0; j < batches[i].TypeBatches.Count; ++j)
            {
                ref var typeBatch = ref batches[i].TypeBatches[j];
                if (typeBatch.TypeId >= ConstraintTypeIds.ContactTypeCount)
                    continue;
                for (int k = 0; k < typeBatch.ConstraintCount; ++k)
                    Consider(ref typeBatch, k);
            }
        }
        pool.TakeAtLeast<float>(Math.Max(1, set.Count), out var heights);
        for (int i = 0; i < set.Count; ++i)
            heights[i] = -Exact.Dot(set.MotionStates[i].Pose.Position, gains[i]);
        graph.Build(set.Count, new ReadOnlySpan<float>(heights.Memory, set.Count), pool);
        pool.Return(ref heights);
        for (int i = 0; i < graph.Nodes.Count; ++i)
            SetTolerance(ref graph.Nodes[i], dt);
        for (; graph.HeldCount < graph.Supports.Count; ++graph.HeldCount)
            Hold(ref graph.Supports[graph.HeldCount]);
    }

    // Adds a contact constraint to the graph if it carries one of its bodies.
    void Consider(ref TypeBatch batch, int index)
    {
        var count = ConstraintTypeIds.ContactCount(batch.TypeId);
        var contacts = new ContactRows(solver, bodies, ref batch, index, count);
        // Springs that a game asked for stay springs.
        if (contacts.Spring != 0)
            return;
        ref var set = ref bodies.Awake;
        var a = contacts.A;
        var b = contacts.B;
        var isFixed = contacts.IsFixedB;
        var normal = contacts.Normal;
        var gain = isFixed ? gains[a] : gains[a] + gains[b];
        var along = -Exact.Dot(gain, normal);
        var isUpperA = along > 0;
        if (!(along * along > LeastSlope * LeastSlope * Exact.LengthSquared(gain)) || (isFixed && !isUpperA))
            return;
        var velocityA = contacts.VelocityA;
        var velocityB = contacts.VelocityB;
        if (isFixed && Exact.LengthSquared(velocityB.Linear) + Exact.LengthSquared(velocityB.Angular) > 0)
            return;
        if (!(set.LocalInertias[a].InverseMass > 0) || !(isFixed || set.LocalInertias[b].InverseMass > 0))
            return;
        Unsafe.SkipInit(out LoadSupport support);
        var quiet = QuietSteps * solver.LastSubstepCount * MathHelper.Max(Exact.Length(gains[a]), isFixed ? 0 : Exact.Length(gains[b]));
        float extent = float.MaxValue;
        for (int i = 0; i < count; ++i)
        {
            var arm = contacts.Arm(i);
            var armB = arm - contacts.OffsetB;
            var velocity = velocityA.Linear + Exact.Cross(velocityA.Angular, arm) - velocityB.Linear - Exact.Cross(velocityB.Angular, armB);
            var apart = Exact.Dot(velocity, normal);
            if (!(apart < quiet) || !(Exact.LengthSquared(velocity - normal * apart) < quiet * quiet))
                return;
            extent = MathHelper.Min(extent, MathF.Abs(Exact.Dot(arm, normal)));
            if (!isFixed)
                extent = MathHelper.Min(extent, MathF.Abs(Exact.Dot(armB, normal)));
            support.Arms[i] = isUpperA ? arm : armB;
        }
        support.Band = BandPerSize * 2 * extent;
        // Friction acts where the sweeps let it act: at the mean of the contacts that touch, or of all if none does.
        Vector3 touching = default, all = default;
        int touches = 0;
        support.Open = 0;
        for (int i = 0; i < count; ++i)
        {
            var depth = contacts.Depth(i);
            if (!(depth >= -2 * support.Band) && !(contacts.Impulse(i) > 0))
                support.Open |= 1 << i;
            all += support.Arms[i];
            if (depth < -support.Band)
                continue;
            touching += support.Arms[i];
            ++touches;
        }
        if (support.Open == (1 << count) - 1)
            return;
        support.Center = touches > 0 ? touching * (1f / touches) : all * (1f / count);
        support.Upper = isUpperA ? a : b;
        support.Lower = isFixed ? -1 : isUpperA ? b : a;
        support.Count = count;
        support.Sign = isUpperA ? 1 : -1;
        support.Impulses = (float*)Unsafe.AsPointer(ref contacts.Impulse(0));
        support.Spring = (float*)Unsafe.AsPointer(ref contacts.Spring);
        support.Friction = contacts.Friction;
        support.Normal = normal * support.Sign;
        support.ToLower = contacts.OffsetB * support.Sign;
        graph.Add(support, pool);
    }

    // What a heavy body has left of its velocity is much to a light one below.
    void SetTolerance(ref LoadNode node, float dt)
    {
        ref var set = ref bodies.Awake;
        var inverseMass = set.LocalInertias[node.Body].InverseMass;
        var ratio = 1f;
        for (int i = node.FirstSupport; i < node.FirstSupport + node.SupportCount; ++i)
        {
            var lower = graph.Supports[i].Lower;
            if (lower >= 0)
                ratio = MathHelper.Min(ratio, inverseMass / set.LocalInertias[lower].InverseMass);
        }
        var gain = Exact.Length(gains[node.Body]);
        // The second is the velocity that a fall of some twenty-millionth of the body's size would give.
        node.Tolerance = ratio * MathHelper.Min(LeastResidual * gain, LeastFall * MathF.Sqrt(gain / dt * node.Radius));
    }

    // A band of no width at all would be a spring that is not held.
    static void Hold(ref LoadSupport support) => *support.Spring = -MathHelper.Max(support.Band, LeastBand);

    void Transfer(int island)
    {
        ref var set = ref bodies.Awake;
        var start = graph.Islands[island];
        var end = graph.Islands[island + 1];
        if (!Begin(start, end))
            return;
        for (int i = end - 1; i >= start; --i)
        {
            ref var node = ref graph.Nodes[i];
            if (node.HasLoad)
                HandDown(ref node);
        }
        Apply(start, end);
    }

    // Finds which bodies have something to hand down, and whether it is worth while for any of them.
    bool Begin(int start, int end)
    {
        ref var set = ref bodies.Awake;
        // What was taken out in the last substep came from more than one, so its impulses overshoot now: until that has died down, less counts.
        ref var first = ref graph.Nodes[start];
        var share = Mode == LoadPathMode.Always ? 0 : first.IsActive ? ActiveShare : 1;
        first.IsActive = false;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            ref var velocity = ref set.MotionStates[node.Body].Velocity;
            var speed = Exact.Length(velocity.Linear) + Exact.Length(velocity.Angular) * node.Radius;
            node.HasLoad = speed > node.Tolerance * MathHelper.Min(share, ActiveShare);
            first.IsActive |= speed > node.Tolerance * share;
            node.Linear = default;
            node.Angular = default;
        }
        return first.IsActive;
    }

    void HandDown(ref LoadNode node)
    {
        ref var set = ref bodies.Awake;
        ref var velocity = ref set.MotionStates[node.Body].Velocity;
        ref var inertia = ref set.WorldInertias[node.Body];
        var supports = new Span<LoadSupport>(graph.Supports.Span.Memory + node.FirstSupport, node.SupportCount);
        foreach (ref var support in supports)
            support.Read();
        LoadTransfer.Find(supports, velocity.Linear * (1 / inertia.InverseMass) + node.Linear,
            Symmetric3x3.Invert(inertia.InverseInertiaTensor) * velocity.Angular + node.Angular, node.Radius);
        foreach (ref var support in supports)
        {
            support.Change(out var linear, out var angular);
            node.Linear += linear;
            node.Angular += angular;
            if (support.Lower < 0)
                continue;
            ref var lower = ref graph.Nodes[graph.NodeOf[support.Lower]];
            lower.Linear -= linear;
            lower.Angular -= angular - Exact.Cross(support.ToLower, linear);
            lower.HasLoad = true;
        }
    }

    // As far as it lowers the kinetic energy of the island, and no farther than all of it. Both ends obey what bounds the impulses, and these
    // bounds are convex: so does all between.
    void Apply(int start, int end)
    {
        ref var set = ref bodies.Awake;
        float slope = 0, curvature = 0;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (!node.HasLoad)
                continue;
            ref var velocity = ref set.MotionStates[node.Body].Velocity;
            ref var inertia = ref set.WorldInertias[node.Body];
            slope += Exact.Dot(velocity.Linear, node.Linear) + Exact.Dot(velocity.Angular, node.Angular);
            curvature += Exact.LengthSquared(node.Linear) * inertia.InverseMass + Exact.Dot(node.Angular, inertia.InverseInertiaTensor * node.Angular);
        }
        // Not if a number went wrong: the comparison is false then.
        var part = -slope / curvature;
        if (!(part > 0))
            return;
        part = MathHelper.Min(part, 1);
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (!node.HasLoad)
                continue;
            ref var velocity = ref set.MotionStates[node.Body].Velocity;
            ref var inertia = ref set.WorldInertias[node.Body];
            velocity.Linear += node.Linear * (inertia.InverseMass * part);
            velocity.Angular += inertia.InverseInertiaTensor * (node.Angular * part);
            for (int j = node.FirstSupport; j < node.FirstSupport + node.SupportCount; ++j)
                graph.Supports[j].Write(part);
        }
    }

    // Lets go of the contacts, and gives back what the step took.
    void ISolverStage.EndStep()
    {
        for (int i = 0; i < graph.HeldCount; ++i)
            *graph.Supports[i].Spring = 0;
        graph.Dispose(pool);
        if (gains.Allocated)
            pool.Return(ref gains);
    }
}
