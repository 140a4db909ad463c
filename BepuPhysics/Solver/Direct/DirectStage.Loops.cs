using System;

namespace BepuPhysics.Constraints;

// Joints that close loops may contradict each other: two sockets that hold two bodies at two points which lie closer together in one of them than in the
// other, a chain between two posts that is too short. No motion puts these right, and what nearly does is a great one: bodies that turn at hundreds of
// radians a second to close a gap of centimetres.
sealed unsafe partial class DirectStage
{
    // What a joint may be off by, as a part of its size or in radians, before it gives way to others.
    const double FreeError = 0.05;
    // How far it gives way then, by what it is off by beyond that: softness as a part of its own K. Damped least squares, in the words of inverse kinematics
    // (Wampler 1986, Nakamura and Hanafusa 1986), where motions grow with one over the least singular value in the same way. Of 300 knots of two to four bodies
    // and as many joints or more that are not where they should be 219 had more than a kilojoule without, one of them 1e21 J, and 10 with it, where sweeps
    // leave 6. At .25 a net that has given way under a load does not come back.
    const double LoopSoftness = 0.05;

    // A joint of a loop that is far off is not as stiff as can be, so that those that contradict it are not fought.
    void GiveWay(in JointLane joint, int member)
    {
        ref var island = ref plan.IslandOf(member);
        if (!island.HasLoops || joint.Limit != RowLimit.None || !joint.IsHard)
            return;
        var (linear, part) = joint.Error();
        // Areas and volumes are no lengths.
        if (linear > 0 && solver.Processor(plan.Nodes[member / DirectPlan.Lanes].TypeId).MakesHubs)
            part = Math.Max(part, linear / Correction.Reach(joint, bodies.Awake.LocalInertias));
        if (!(part > FreeError))
            return;
        var softness = hardSoftness + LoopSoftness * (Math.Min(1, part) - FreeError);
        if (island.Lanes == 1)
            Soften<OneVector, OneNumber>(member, softness);
        else if (island.Lanes == DirectPlan.FourLanes)
            Soften<ManyVectors<FourNumbers>, FourNumbers>(member, softness);
        else
            Soften<ManyVectors<EightNumbers>, EightNumbers>(member, softness);
    }

    void Soften<TVectors, TNumbers>(int member, double softness)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var node = ref plan.Nodes[member / DirectPlan.Lanes];
        var equations = new DirectMemory<TVectors, TNumbers>(memory.Memory, plan.Islands[node.Island]);
        for (int row = 0; row < node.RowCount; ++row)
            DirectLane.Of(ref equations.Rows[node.FirstRow + row].Softness, member % DirectPlan.Lanes) = softness;
    }
}
