using System;
using BepuPhysics.Constraints;

namespace BepuPhysics;

// Hubs: dynamic bodies with several joints that hold points of them, or that carry their weight.
//
// All joints of one body are coupled with each other, where those of a chain see two neighbours. A sweep from the first to the last that starts
// from the impulses of the substep before then carries errors along the order of the joints like a wave (Solver.Order.cs), and the correction of
// positions feeds it, the more the stiffer the joints are. With one sweep the stiffness of a chain is what few joints on a body bear as well; each
// further sweep is worth less to them than to a chain, about as much as to a heap of contacts. So the joints of a hub take the contacts' stiffness
// (Substep.Hubs). A kinematic body couples nothing, as no joint moves it.
//
// How many such joints a body has is kept with the body. The joints of a hub know it by a flag in their references to it, which is written
// when the number passes the limit: sweeps read what they read anyway, and contacts read nothing.
public sealed unsafe partial class Solver
{
    /// <summary>Joints that make a body a hub.</summary>
    const int JointsOfHub = 3;

    // The number of joints that are coupled through a body.
    int Degree(int bodyIndex) =>
        Bodies.IsKinematic(bodies.ActiveSet.LocalInertias[bodyIndex]) ? 0 : bodies.ActiveSet.JointCounts[bodyIndex];

    /// <summary>Takes note of a joint that was just added and makes hubs.</summary>
    void CountJoint(ConstraintHandle joint, ReadOnlySpan<BodyHandle> bodyHandles)
    {
        bodies.ActiveSet.EnsureJointCounts(pool);
        for (int i = 0; i < bodyHandles.Length; ++i)
            ChangeJointCount(bodies.Locations[bodyHandles[i].Slot].Index, 1);
        MarkHubs(Locations[joint.Slot]);
        MoveJointsOfTurned();
    }

    /// <summary>Follows a body that got a joint, or lost one.</summary>
    void ChangeJointCount(int bodyIndex, int change)
    {
        var before = Degree(bodyIndex);
        bodies.ActiveSet.JointCounts[bodyIndex] += change;
        var after = Degree(bodyIndex);
        NoteTurned(bodyIndex, before, after);
        if (before >= JointsOfHub == after >= JointsOfHub)
            return;
        foreach (var constraint in new BodyConstraints(this, bodies.ActiveSet.Constraints[bodyIndex]))
        {
            ref var location = ref Locations[constraint.ConnectingConstraintHandle.Slot];
            if (Processor(location.TypeId).MakesHubs)
                MarkHubs(location);
        }
    }

    /// <summary>Writes into the references of a joint which of its bodies are hubs.</summary>
    void MarkHubs(in ConstraintLocation location)
    {
        var processor = Processor(location.TypeId);
        var isEnabled = KindOf(location) != BatchKind.Disabled;
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            ref var reference = ref processor.BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, slot);
            var isHub = isEnabled && Degree(reference & EncodedBody.IndexMask) >= JointsOfHub;
            reference = isHub ? reference | EncodedBody.HubFlag : reference & ~EncodedBody.HubFlag;
        }
    }
}
