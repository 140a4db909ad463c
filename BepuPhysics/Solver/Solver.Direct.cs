using System;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

// Which joints are solved all at once. Chosen anew when a joint has come or gone, or a body of one has moved in memory, before a step.
public sealed unsafe partial class Solver
{
    DirectJointsMode directJoints;
    readonly DirectStage directStage;
    // How often joints of the active set have changed, and how often they had when they were chosen.
    int jointVersion;
    int chosenVersion;
    DirectJointsMode chosenMode;

    /// <summary>Whether all joints of a structure are solved at once.</summary>
    /// <remarks>May be changed between any two steps: impulses stay.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">There is no such mode.</exception>
    public DirectJointsMode DirectJoints
    {
        get => directJoints;
        set
        {
            SolveDescription.Check(value);
            world.CheckChangeable("Solver.DirectJoints");
            directJoints = value;
        }
    }

    // Joints of the active set, or their bodies, are not where they were.
    void NoteJointChange(int typeId)
    {
        if (typeId >= ConstraintTypeIds.ContactTypeCount)
            ++jointVersion;
    }

    void ChooseDirectJoints()
    {
        if (chosenMode == directJoints && (chosenVersion == jointVersion || directJoints == DirectJointsMode.Off))
            return;
        var plan = DirectPlan.Create(pool);
        var joints = FindJoints();
        if (directJoints != DirectJointsMode.Off)
            new DirectChooser(joints, bodies.Awake.Count, pool).Choose(ref plan);
        for (int i = 0; i < joints.Count; ++i)
            SetSwept(new ConstraintHandle(owners.ValueAt(joints[i].Slot)), !joints[i].IsDirect);
        joints.Dispose(pool);
        directStage.Replace(plan);
        chosenMode = directJoints;
        chosenVersion = jointVersion;
    }

    // They are chosen anew when the first of them wakes.
    void ForgetDirectJoints()
    {
        if (chosenMode == DirectJointsMode.Off)
            return;
        directStage.Replace(default);
        chosenVersion = jointVersion - 1;
    }

    // All that may be solved at once, by slots: where they are in memory says nothing.
    QuickList<DirectCandidate> FindJoints()
    {
        var joints = new QuickList<DirectCandidate>(16, pool);
        foreach (ref var batch in ActiveSet.Batches.AsSpan())
        {
            foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
            {
                var processor = Processor(typeBatch.TypeId);
                if (batch.Kind == BatchKind.Disabled || !IsOfJoints(typeBatch) || !IsHeldBothWays(processor))
                    continue;
                for (int i = 0; i < typeBatch.ConstraintCount; ++i)
                {
                    ref var joint = ref joints.Allocate(pool);
                    joint = new() { Slot = typeBatch.IndexToHandle[i].Slot };
                    ref var node = ref joint.Node;
                    node = new() { Slot = joint.Slot, TypeId = typeBatch.TypeId, RowCount = processor.RowCount, BodyCount = processor.BodiesPerConstraint };
                    for (int slot = 0; slot < node.BodyCount; ++slot)
                        node.Bodies[slot] = processor.BodyReference(ref typeBatch, i, slot) & (EncodedBody.IndexMask | EncodedBody.KinematicFlag);
                }
            }
        }
        joints.AsSpan().Sort(static (a, b) => a.Slot.CompareTo(b.Slot));
        return joints;
    }

    // Limits, servos and motors have bounds, which sweeps are good at.
    static bool IsHeldBothWays(TypeProcessor processor)
    {
        for (int row = 0; row < processor.RowCount; ++row)
        {
            if (processor.LimitOf(row) != RowLimit.None)
                return false;
        }
        return processor.RowCount > 0;
    }
}
