using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

// A blow is a load that nobody knew of. A crooked chain of light links that its heavy end pulls taut is one: what stops the load in a substep is a hundred
// times its weight, and what its links were given to stand up to (GeometricStiffness.cs) is of the substep before. Solved for as if nothing hindered their
// turning, they turn by radians in that substep, which leaves gaps of their own length; the load falls on along these, and pulls the links on. So where a
// body turns far, and its own joints pull at it so hard that it would swing back within the substep, all is solved once more with the stiffness of these
// very loads; and again with more of it, as a link that gave way has not borne all that it should. Structures with limits, servos or motors are left out: who
// of these is held was found by the velocities that there were.
sealed unsafe partial class DirectStage
{
    // Radians in a substep: up to here what joints are left off by is small against their arms.
    const float FarTurn = 0.1f;
    // (w h)^2 of a swing that a substep cannot follow, of a body that takes its mass along on its arm. By a blow bodies of about the same mass have v h / r,
    // however long their arms: below one until they go farther in a substep than their arms reach. Light links have that times the ratio of the masses.
    const float LeastSwing = 1;
    // How often it is solved once more. Each time bodies are given so many times the stiffness of before.
    const int MostBlowRounds = 4;
    const float BlowGrowth = 4;
    // By bodies of the plan. Nothing of it stays.
    Buffer<BlowLoad> blowLoads;

    struct BlowLoad
    {
        // N m: the sum of f.r of the loads that pull outwards.
        public float Tension;
        // Square of the longest arm of these.
        public float ArmSquared;
    }

    /// <summary>Solves once more, with the stiffness of the loads that there are, where light links are hit.</summary>
    /// <param name="island">The structures.</param>
    /// <param name="equations">Their equations, solved.</param>
    /// <param name="substep">The substep.</param>
    /// <param name="lanes">A bit for each that has been solved.</param>
    void SolveBlows<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations, in Substep substep, int lanes)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        if (island.HasBounds)
            return;
        var margin = GeometricStiffness.DirectMargin;
        for (int round = 0; round < MostBlowRounds; ++round, margin *= BlowGrowth)
        {
            lanes &= LanesThatTurnFar(island, equations, substep.Dt);
            if (lanes == 0)
                return;
            for (int lane = 0; lane < island.MemberCount; ++lane)
            {
                if ((lanes >> lane & 1) != 0 && !FindBlow(island, equations, substep, lane, round == 0 ? LeastSwing : 0))
                    lanes &= ~(1 << lane);
            }
            if (lanes == 0)
                return;
            // The impulses of the joints are taken back and given to what is stiff now: they are a start like any other.
            var system = new DirectEquations<TVectors, TNumbers>(plan, island, equations, KeepsFactors);
            var mask = DirectLane.MaskOf<TNumbers>(lanes);
            system.TakeBack(mask);
            for (int lane = 0; lane < island.MemberCount; ++lane)
            {
                if ((lanes >> lane & 1) != 0)
                    Stiffen(island, equations, substep, lane, margin);
            }
            system.GiveAgain(mask);
            system.Solve(mask);
        }
    }

    // A bit for each structure of which a body turns far.
    static int LanesThatTurnFar<TVectors, TNumbers>(in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations, float dt)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        TNumbers far = default;
        var least = TNumbers.Of((double)FarTurn / dt * ((double)FarTurn / dt));
        for (int i = island.FirstBody; i < island.FirstBody + island.DynamicCount; ++i)
        {
            ref var angular = ref equations.Bodies[i].Velocity.Angular;
            far |= TNumbers.Above(TVectors.Sum(angular * angular), least);
        }
        return TNumbers.Bits(far);
    }

    // Adds up what the joints of a structure pull at its bodies with. Returns whether one of them turns far that cannot follow it.
    bool FindBlow<TVectors, TNumbers>(
        in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations, in Substep substep, int lane, float leastSwing)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        var end = island.FirstBody + island.DynamicCount;
        for (int i = island.FirstBody; i < end; ++i)
            blowLoads[i * DirectPlan.Lanes + lane] = default;
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            ref var node = ref plan.Nodes[k];
            var holdsPoint = HoldsPoint(node);
            for (int slot = 0; slot < node.BodyCount; ++slot)
            {
                if (holdsPoint && node.Bodies[slot] < end)
                    AddLoad(node, equations, slot, lane, substep.InverseDt);
            }
        }
        for (int i = island.FirstBody; i < end; ++i)
        {
            ref var body = ref equations.Bodies[i];
            var turn = Exact.LengthSquared(DirectLane.Read<TVectors, TNumbers>(ref body.Velocity.Angular, lane)) * (substep.Dt * substep.Dt);
            ref var load = ref blowLoads[i * DirectPlan.Lanes + lane];
            if (!(turn > FarTurn * FarTurn) || !(load.Tension > 0))
                continue;
            // Three over the trace is no more than the greatest moment.
            var inverse = body.ReadInertia(lane);
            var moment = 3 / (inverse.XX + inverse.YY + inverse.ZZ) + load.ArmSquared / (float)DirectLane.Of(ref body.InverseMass, lane);
            if (load.Tension * (substep.Dt * substep.Dt) > leastSwing * moment)
                return true;
        }
        return false;
    }

    bool HoldsPoint(in DirectNode node)
    {
        var processor = solver.Processor(node.TypeId);
        var linear = 0;
        for (int row = 0; row < node.RowCount; ++row)
            linear += processor.IsLinear(row) ? 1 : 0;
        return processor.CarriesPointLoad && node.BodyCount == 2 && linear == 3;
    }

    // Of the three rows along axes that hold a point the parts r x n of the Jacobian say where it is: the sum of n x (r x n) is 2 r.
    void AddLoad<TVectors, TNumbers>(in DirectNode node, in DirectMemory<TVectors, TNumbers> equations, int slot, int lane, float inverseDt)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        Vector3 impulse = default, arm = default;
        for (int row = 0; row < node.RowCount; ++row)
        {
            ref var j = ref equations.Jacobians[node.Jacobian + row * node.BodyCount + slot];
            var linear = DirectLane.Read<TVectors, TNumbers>(ref j.Linear, lane);
            impulse += linear * (float)DirectLane.Of(ref equations.Rows[node.FirstRow + row].Impulse, lane);
            arm += 0.5f * Exact.Cross(linear, DirectLane.Read<TVectors, TNumbers>(ref j.Angular, lane));
        }
        var tension = Exact.Dot(impulse, arm) * inverseDt;
        if (!(tension > 0))
            return;
        ref var load = ref blowLoads[node.Bodies[slot] * DirectPlan.Lanes + lane];
        load.Tension += tension;
        load.ArmSquared = MathHelper.Max(load.ArmSquared, Exact.LengthSquared(arm));
    }

    // About all axes alike: the arms turn far, and the one about which nothing hindered the body now would be another one when it gets there.
    void Stiffen<TVectors, TNumbers>(
        in DirectIsland island, in DirectMemory<TVectors, TNumbers> equations, in Substep substep, int lane, float margin)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        for (int i = island.FirstBody; i < island.FirstBody + island.DynamicCount; ++i)
        {
            ref var load = ref blowLoads[i * DirectPlan.Lanes + lane];
            ref var body = ref equations.Bodies[i];
            var inverseMass = (float)DirectLane.Of(ref body.InverseMass, lane);
            if (!(load.Tension > 0) || !(inverseMass > 0))
                continue;
            var inertia = Lanes.Broadcast<Symmetric3x3, Symmetric3x3Wide>(body.ReadInertia(lane));
            var angular = Vector3Wide.Broadcast(DirectLane.Read<TVectors, TNumbers>(ref body.Velocity.Angular, lane));
            var stiffness = Symmetric3x3Wide.AddDiagonal(default, new Vector<float>(margin * load.Tension));
            GeometricStiffness.Apply(
                stiffness, new Vector<float>(load.ArmSquared / inverseMass), new Vector<float>(substep.Dt), ref inertia, ref angular);
            var turn = Lanes.Read<Vector3, Vector3Wide>(ref angular, 0);
            DirectLane.Write<TVectors, TNumbers>(ref body.Velocity.Angular, lane, turn.X, turn.Y, turn.Z);
            body.WriteInertia(lane, Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref inertia, 0));
        }
    }
}
