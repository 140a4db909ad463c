using System;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What is done with an island that has something to hand down.
sealed unsafe partial class LoadPathStage
{
    void Transfer(int island, int block, in Substep substep)
    {
        var start = graph.Islands[island];
        var end = graph.Islands[island + 1];
        ref var first = ref graph.Nodes[start];
        if (substep.Index == 0 && first.HasSunken)
            KeepAwake(island);
        if (substep.Index == 0 && first.HasOverlaps)
            Lift(island, block, substep);
        first.IsActive = first.NeedsWork;
        first.NeedsWork = false;
        if (!first.IsActive)
            return;
        var firstSupport = first.FirstSupport;
        var floor = MotionOf(first, substep.Dt);
        var supports = ReadSupports(island, block);
        for (int i = end - 1; i >= start; --i)
        {
            ref var node = ref graph.Nodes[i];
            if (!node.HasLoad)
                continue;
            var carrying = SupportsOf(node, supports, firstSupport);
            foreach (ref var support in carrying)
                support.Read();
            // What leans hands nothing down: what bears it stays as the sweeps have it.
            if (!node.Leans)
                HandDown(ref node, carrying, floor);
        }
        // Of tens of milliseconds for some hundreds of bricks, that is for who asks for it.
        var mayTip = Mode == LoadPathMode.Always && SupportGraph.MayTip(end - start);
        var leavesMuch = (mayTip || first.MayBeColumn) && !first.IsOfColumn && !first.IsRelaxed && LeavesMuch(start, end, floor);
        var isColumn = first.IsOfColumn || (leavesMuch && first.MayBeColumn && IsColumn(start, end));
        var tips = leavesMuch && mayTip && !isColumn;
        if (tips)
        {
            first.Tips = true;
            hasTipped[block] = true;
            Shorten(start, end, supports, floor);
        }
        if (first.IsRelaxed || isColumn || tips)
            Relax(start, end, supports, block, isColumn, floor);
        Apply(start, end, supports, floor);
    }

    // Whether any body has more left, after all was handed down, than a step of acceleration gives: what tips over does, and turns together with all that is
    // on it. Less comes and goes in what stands, and a column that was relaxed by turns would fall by the luck of each.
    bool LeavesMuch(int start, int end, in FloorMotion floor)
    {
        ref var set = ref bodies.Awake;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            ref var velocity = ref set.MotionStates[node.Body].Velocity;
            ref var inertia = ref set.WorldInertias[node.Body];
            var speed = Exact.Length(velocity.Linear - floor.At(set.MotionStates[node.Body].Pose.Position - node.Lag) + node.Linear * inertia.InverseMass) +
                Exact.Length(velocity.Angular - floor.Angular + inertia.InverseInertiaTensor * node.Angular) * node.Radius;
            if (speed > node.Gain * solver.LastSubstepCount)
                return true;
        }
        return false;
    }

    // The moment that a face cannot bear is left to the one body above it, which would turn alone. What tips over turns with all that is on it: on the way
    // from what the warm start has left to where all is handed down the kinetic energy falls for a small part, and then rises. There the rounds begin.
    void Shorten(int start, int end, Span<LoadSupport> supports, in FloorMotion floor)
    {
        var part = Descent(start, end, floor);
        var firstSupport = graph.Nodes[start].FirstSupport;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (!node.HasLoad)
                continue;
            node.Linear *= part;
            node.Angular *= part;
            foreach (ref var support in SupportsOf(node, supports, firstSupport))
                support.Shorten(part);
        }
    }

    // Whether bodies of which each has one support stand one on the other, and nothing else touches or holds them but what may be on top.
    bool IsColumn(int start, int end)
    {
        var bottoms = 0;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (graph.Links[node.FirstSupport].Lower < 0)
                ++bottoms;
            if (bodies.Awake.Constraints[node.Body].Count > 2)
                return false;
        }
        // Each has one below, and so no more than one above.
        return bottoms == 1;
    }

    // In each substep: what a bounce hides of an overlap, depths do not say in that substep, and friction acts where contacts touch.
    Span<LoadSupport> ReadSupports(int island, int block)
    {
        var first = FirstSupport(island);
        var read = new Span<LoadSupport>(supports.Memory + rooms[block], EndOfSupports(island) - first);
        for (int i = 0; i < read.Length; ++i)
            read[i] = new LoadSupport(graph.Links[first + i]);
        return read;
    }

    // All of its bodies at once, and all of its patches: those through which nothing was handed down are read here.
    void Relax(int start, int end, Span<LoadSupport> supports, int block, bool isColumn, in FloorMotion floor)
    {
        var patches = this.patches.Memory + patchRooms[block];
        var firstSupport = graph.Nodes[start].FirstSupport;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            var isRead = node.HasLoad;
            node.HasLoad = true;
            for (int j = node.FirstSupport - firstSupport; j < node.FirstSupport - firstSupport + node.SupportCount; ++j)
            {
                if (!isRead)
                    supports[j].Read();
                patches[j].Upper = i - start;
                patches[j].Lower = supports[j].Lower < 0 ? -1 : graph.NodeOf[supports[j].Lower] - start;
            }
        }
        ref var set = ref bodies.Awake;
        var relaxation = new LoadRelaxation(
            new Span<LoadNode>(graph.Nodes.Span.Memory + start, end - start), supports, patches, relaxedBodies.Memory + bodyRooms[block],
            set.MotionStates, set.WorldInertias, floor);
        if (isColumn)
            relaxation.RunColumn(new Span<ColumnBlock>(columns.Memory + block * graph.LongestColumn, end - start));
        else
            relaxed[block] += supports.Length * relaxation.Run(Mode == LoadPathMode.Always);
    }

    static Span<LoadSupport> SupportsOf(in LoadNode node, Span<LoadSupport> ofIsland, int firstOfIsland) =>
        ofIsland.Slice(node.FirstSupport - firstOfIsland, node.SupportCount);

    void HandDown(ref LoadNode node, Span<LoadSupport> supports, in FloorMotion floor)
    {
        ref var set = ref bodies.Awake;
        ref var motion = ref set.MotionStates[node.Body];
        ref var inertia = ref set.WorldInertias[node.Body];
        LoadTransfer.Find(supports, (motion.Velocity.Linear - floor.At(motion.Pose.Position - node.Lag)) * (1 / inertia.InverseMass) + node.Linear,
            Symmetric3x3.Invert(inertia.InverseInertiaTensor) * (motion.Velocity.Angular - floor.Angular) + node.Angular, node.Radius);
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

    // As far as it lowers the kinetic energy of the island, to who moves along with its floor, and no farther than all of it. Both ends obey what bounds
    // the impulses, and these bounds are convex: so does all between.
    float Descent(int start, int end, in FloorMotion floor)
    {
        ref var set = ref bodies.Awake;
        float slope = 0, curvature = 0;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (!node.HasLoad)
                continue;
            ref var motion = ref set.MotionStates[node.Body];
            ref var inertia = ref set.WorldInertias[node.Body];
            slope += Exact.Dot(motion.Velocity.Linear - floor.At(motion.Pose.Position - node.Lag), node.Linear) +
                Exact.Dot(motion.Velocity.Angular - floor.Angular, node.Angular);
            curvature += Exact.LengthSquared(node.Linear) * inertia.InverseMass + Exact.Dot(node.Angular, inertia.InverseInertiaTensor * node.Angular);
        }
        // Not if a number went wrong: the comparison is false then.
        var part = -slope / curvature;
        return part > 0 ? MathHelper.Min(part, 1) : 0;
    }

    void Apply(int start, int end, Span<LoadSupport> supports, in FloorMotion floor)
    {
        var part = Descent(start, end, floor);
        if (part == 0)
            return;
        ref var set = ref bodies.Awake;
        var firstSupport = graph.Nodes[start].FirstSupport;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            if (!node.HasLoad)
                continue;
            ref var velocity = ref set.MotionStates[node.Body].Velocity;
            ref var inertia = ref set.WorldInertias[node.Body];
            velocity.Linear += node.Linear * (inertia.InverseMass * part);
            velocity.Angular += inertia.InverseInertiaTensor * (node.Angular * part);
            foreach (ref var support in SupportsOf(node, supports, firstSupport))
                support.Write(part);
        }
    }
}
