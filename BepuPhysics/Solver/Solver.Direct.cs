using System;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

// Which joints are solved all at once. Chosen anew when a joint has come or gone, or a body of one has moved in memory, before a step.
public sealed unsafe partial class Solver
{
    DirectJointsMode directJoints;
    readonly DirectStage directStage;
    readonly JointNeedStage needStage;
    // How often joints of the active set have changed, and how often they had when they were chosen.
    int jointVersion;
    int chosenVersion;
    DirectJointsMode chosenMode;

    /// <summary>Whether all joints of a structure are solved at once.</summary>
    /// <remarks>
    /// May be changed between any two steps. What goes back to the sweeps when it is switched off begins there without impulses. From
    /// <see cref="DirectJointsMode.Always"/> to <see cref="DirectJointsMode.WhereNeeded"/> nothing changes at first, until the loads say which structures
    /// the sweeps bear. What sweeps have let open closes within a second or some, not at once, and does not fall asleep by itself meanwhile.
    /// </remarks>
    /// <exception cref="ArgumentOutOfRangeException">There is no such mode.</exception>
    public DirectJointsMode DirectJoints
    {
        get => directJoints;
        set
        {
            SolveDescription.Check(value);
            using var change = world.Change("Solver.DirectJoints");
            if (directJoints == value)
                return;
            var areNumbered = AreNumbered;
            directJoints = value;
            if (value != DirectJointsMode.Off)
                BeginNeeds(areNumbered);
            else if (!AreNumbered)
                EndNeeds();
        }
    }

    /// <summary>Changes whenever a joint of the active set comes, goes or has a body that moves in memory.</summary>
    internal int JointVersion => jointVersion;

    /// <summary>Number of structures that are solved at once, equal ones that are solved side by side as one.</summary>
    internal int DirectIslandCount => directStage.IslandCount;

    /// <summary>Whether factors stay that do not depend on who leans on what; else all are worked out anew, to the same bits, which tests compare.</summary>
    internal bool KeepsDirectFactors
    {
        set => directStage.KeepsFactors = value;
    }

    // Joints of the active set, or their bodies, are not where they were.
    void NoteJointChange(int typeId)
    {
        if (typeId >= ConstraintTypeIds.ContactTypeCount)
            ++jointVersion;
    }

    void ChooseDirectJoints()
    {
        if (chosenMode == directJoints && (chosenVersion == jointVersion && !needsChanged || directJoints == DirectJointsMode.Off))
            return;
        if (ChoosesDirectJoints && !MayChoose())
            return;
        var plan = DirectPlan.Create(pool);
        var joints = FindJoints();
        if (directJoints != DirectJointsMode.Off)
        {
            new DirectChooser(joints, bodies.Awake.Count, pool).Choose(ref plan);
            ChangeOver(ref joints);
        }
        for (int i = 0; i < joints.Count; ++i)
        {
            // Where the solver chooses, what goes back to the sweeps bears little. Elsewhere the impulses are those of one substep in which nothing gave way,
            // which may have been a blow: a hundred times what is borne, given to light links that have turned since.
            var bearsLittle = ChoosesDirectJoints && !joints[i].IsRefused;
            if (!joints[i].IsDirect && !bearsLittle && KindOf(Locations[joints[i].Handle.Slot]) == BatchKind.Direct)
                ForgetImpulses(joints[i].Handle);
            SetSwept(joints[i].Handle, !joints[i].IsDirect);
        }
        joints.Dispose(pool);
        directStage.Replace(plan);
        if (directJoints == DirectJointsMode.Off)
            EndNeeds();
        chosenMode = directJoints;
        chosenVersion = jointVersion;
        needsChanged = false;
    }

    // Where the solver chooses: whether anything may be solved at once now, or was before. All that is looked at where nothing needs anything.
    bool MayChoose()
    {
        if (needsChanged || chosenMode != directJoints || directStage.HasJoints || FindBatch(ActiveSet, BatchKind.Direct) >= 0)
            return true;
        chosenVersion = jointVersion;
        return false;
    }

    // They are chosen anew when the first of them wakes.
    void ForgetDirectJoints()
    {
        if (chosenMode == DirectJointsMode.Off)
            return;
        directStage.Replace(default);
        chosenVersion = jointVersion - 1;
    }

    // All that may be solved at once. Where they lie and which handles they have says who was there before, and may not decide anything: their numbers do.
    QuickList<DirectCandidate> FindJoints()
    {
        var joints = new QuickList<DirectCandidate>(16, pool);
        foreach (ref var batch in ActiveSet.Batches.AsSpan())
        {
            if (batch.IsSwept || batch.Kind == BatchKind.Direct)
                AddJoints(batch, ref joints);
        }
        return joints;
    }

    void AddJoints(in ConstraintBatch batch, ref QuickList<DirectCandidate> joints)
    {
        foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
        {
            var processor = Processor(typeBatch.TypeId);
            if (!MayBeDirect(typeBatch.TypeId))
                continue;
            for (int i = 0; i < typeBatch.ConstraintCount; ++i)
            {
                ref var joint = ref joints.Allocate(pool);
                joint = default;
                if (directJoints != DirectJointsMode.Off)
                {
                    ref var need = ref needs[typeBatch.IndexToHandle[i].Slot];
                    (joint.Number, joint.Asks) = (need.Number, ChoosesDirectJoints ? need.Asks > 0 : MayAsk(typeBatch.TypeId));
                }
                joint.Handle = typeBatch.IndexToHandle[i];
                ref var node = ref joint.Joint;
                node = new()
                {
                    TypeId = typeBatch.TypeId,
                    RowCount = processor.RowCount,
                    BodyCount = processor.BodiesPerConstraint,
                    Limit = processor.LimitOf(0),
                    SeesLinear = processor.SeesLinear,
                };
                for (int slot = 0; slot < node.BodyCount; ++slot)
                    node.Bodies[slot] = processor.BodyReference(ref typeBatch, i, slot) & (EncodedBody.IndexMask | EncodedBody.KinematicFlag);
            }
        }
    }

    /// <summary>Whether joints of a type may be solved at once.</summary>
    internal bool MayBeDirect(int typeId) => typeId >= ConstraintTypeIds.ContactTypeCount && Processor(typeId).RowCount > 0;

    /// <summary>Whether joints of a type hold both ways, and may ask for their structure to be solved at once.</summary>
    // Limits, servos and motors go with the joints beside them: those of which some structure consists alone are what sweeps are good at.
    internal bool MayAsk(int typeId) => MayBeDirect(typeId) && Processor(typeId).LimitOf(0) == RowLimit.None;
}
