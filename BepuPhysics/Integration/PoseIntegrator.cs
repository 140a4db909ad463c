using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using static BepuPhysics.BodyRows;

namespace BepuPhysics;

/// <summary>Moves bodies, compiled for the callbacks of a game.</summary>
/// <remarks>What <see cref="Simulation.PoseIntegrator"/> is: cast it to this to reach the callbacks.</remarks>
// A pass over all bodies between two substeps does all that happens to a body there: the pose follows the velocity that the solver left,
// the callbacks change the velocity for the next substep, and the inverse inertia is turned to the new orientation.
//
// The translations of a step's substeps are summed and added once: far from the origin a substep's translation may be too small to change
// a position at all. Positions within the step are the position at its beginning plus that sum, rounded once. What that rounding leaves
// over at the end of the step is where the next sum begins, so that it does not add up from step to step.
//
// The same holds for the velocity of a fast body: 0.04 m/s of gravity is added to 500 m/s with an error of 4e-4 of itself, and with the same
// sign for many substeps on end. What is lost is kept and added back, unless the velocity was written since the step that lost it.
public sealed unsafe class PoseIntegrator<TCallbacks> : IPoseIntegrator where TCallbacks : struct, IPoseIntegratorCallbacks
{
    // Velocity over change of velocity from which on rounding takes up to 6e-5 of the change.
    const float FastRatio = 1024;
    // Half of the distance from one float to the next is the most that rounding takes, 2^-24 of the sum; the sum may be half of what is compared.
    const float GreatestLoss = 1f / (1 << 23);

    /// <summary>The callbacks themselves: <see cref="Simulation.Create"/> copied the struct that it was given. Not to be changed during a step.</summary>
    public TCallbacks Callbacks;
    Bodies bodies = null!;
    Quarantine quarantine = null!;
    // Whether any body was ever so fast that rounding took of its velocity. Set by any worker, read in later stages.
    bool keepsLostVelocity;

    internal PoseIntegrator(in TCallbacks callbacks) => Callbacks = callbacks;

    void IPoseIntegrator.Initialize(Simulation simulation)
    {
        bodies = simulation.Bodies;
        quarantine = simulation.Quarantine;
        Callbacks.Initialize(simulation);
    }

    void IPoseIntegrator.Compile()
    {
        var type = typeof(PoseIntegrator<TCallbacks>);
        Precompilation.CompileAll(type);
        Precompilation.Compile(typeof(TCallbacks));
        foreach (var rows in new[] { typeof(RowRun), typeof(RowOffsets) })
        {
            Precompilation.Compile(type, nameof(IntegrateBundle), rows);
            Precompilation.Compile(type, nameof(KeepLostVelocity), rows);
            Precompilation.Compile(type, nameof(WriteMovedInertia), rows);
        }
    }

    void IPoseIntegrator.CopyState(StateCopy copy) => copy.Value(ref keepsLostVelocity);

    void IPoseIntegrator.Prepare(float dt)
    {
        var mode = Callbacks.AngularIntegrationMode;
        if (mode is < AngularIntegrationMode.Nonconserving or > AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque)
        {
            throw new InvalidOperationException(
                $"The pose integrator callbacks have an {nameof(AngularIntegrationMode)} of {mode}: there is no such mode.");
        }
        Callbacks.PrepareForIntegration(dt);
    }

    bool IPoseIntegrator.SubstepsFreeBodies => Callbacks.AllowSubstepsForUnconstrainedBodies;

    void IPoseIntegrator.Integrate(
        IntegrationStage stage, float dt, in FreeBodies freeBodies, int startBundle, int endBundle, int workerIndex)
    {
        ref var set = ref bodies.Awake;
        Pass pass = new()
        {
            Motions = (float*)set.MotionStates.Memory,
            LocalInertias = (float*)set.LocalInertias.Memory,
            WorldInertias = (float*)set.WorldInertias.Memory,
            Displacements = (float*)set.Displacements.Memory,
            Origins = (float*)set.Origins.Memory,
            Stiffness = (float*)set.Stiffness.Memory,
            Dt = dt,
            WorkerIndex = workerIndex,
            Stage = stage,
        };
        // Frames of what is called for each bundle begin with a line.
        var above = stackalloc byte[StackLine.Length];
        var line = stackalloc byte[StackLine.BytesBelow(above, sizeof(byte))];
        *line = 0;
        for (int bundle = startBundle; bundle < endBundle; ++bundle)
        {
            var indices = Indices(bundle, set.Count, out var exists);
            if (freeBodies.Exist)
            {
                if (stage == IntegrationStage.First)
                    freeBodies.Find(bundle, set);
                if (!freeBodies.TryRemove(bundle, ref indices, ref exists))
                    continue;
            }
            if (Vector.EqualsAll(exists, Vector<int>.AllBitsSet))
                IntegrateBundle(pass, new RowRun(bundle * Vector<int>.Count), Vector<int>.AllBitsSet);
            else
                IntegrateBundle(pass, new RowOffsets(indices), exists);
        }
    }

    // What all bundles of a pass have in common.
    struct Pass
    {
        public float* Motions, LocalInertias, WorldInertias, Displacements, Origins, Stiffness;
        public float Dt;
        public int WorkerIndex;
        public IntegrationStage Stage;
    }

    // Bodies of nearly all bundles lie in order, all of them: compiled for these, no row has to be looked for.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void IntegrateBundle<TRows>(in Pass pass, in TRows rows, Vector<int> exists) where TRows : unmanaged, IRowPlaces<TRows>
    {
        var stage = pass.Stage;
        var dt = new Vector<float>(pass.Dt);
        var indices = TRows.Indices(rows);
        ReadBodies(pass.Motions, pass.LocalInertias, rows, out var pose, out var velocity, out var localInertia);
        if (Soundness.IsNot(Soundness.OfBodies(pose, velocity), exists, out var unsound))
            StopAndRead(unsound, indices, ref pose, ref velocity);
        if (stage == IntegrationStage.First)
            AddLinkInertia(Begin(pass.Origins, pass.Displacements, rows, pose.Position, velocity.Linear), ref localInertia.InverseInertiaTensor);
        else if (stage != IntegrationStage.Velocities)
            MovePoses(pass.Motions, pass.Origins, pass.Displacements, indices, rows, dt, velocity.Linear, ref localInertia, ref pose, ref velocity);
        else if (pass.Stiffness != null)
            AddLinkInertia(ReadSecondNeighbour(pass.Displacements, rows), ref localInertia.InverseInertiaTensor);
        if (stage is IntegrationStage.Last or IntegrationStage.Poses)
        {
            // The gyroscopic motion changed the angular velocity along with the orientation; of great ones nothing may be left.
            if (Soundness.IsNot(Soundness.OfVelocities(velocity), exists, out unsound))
                StopAndRead(unsound, indices, ref pose, ref velocity);
            WriteVelocity(pass.Motions, rows, velocity);
            if (keepsLostVelocity)
                RememberVelocity(pass.Origins, rows, velocity.Linear);
            if (stage == IntegrationStage.Poses)
                WriteMovedInertia(rows, pose.Orientation, velocity.Angular, dt, localInertia);
            return;
        }
        var before = velocity.Linear;
        IntegrateVelocity(indices, exists, IsKinematic(localInertia), pose, localInertia, pass.WorkerIndex, dt, ref velocity);
        var fast = IsFast(before, velocity.Linear);
        if (Vector.EqualsAny(fast, new Vector<int>(-1)))
            KeepLostVelocity(pass.Origins, rows, indices, fast, pose, localInertia, pass.WorkerIndex, dt, before, ref velocity.Linear);
        var worldInertia = Symmetric3x3Wide.RotateInverseInertia(localInertia.InverseInertiaTensor, pose.Orientation);
        // The warm start that follows the first pass gathers the stiffness of this step.
        if (pass.Stiffness != null)
            Stiffen(pass.Stiffness, rows, dt, stage == IntegrationStage.First, localInertia.InverseMass, ref worldInertia, ref velocity.Angular);
        if (Soundness.IsNot(Soundness.OfVelocities(velocity), exists, out unsound))
        {
            StopAndRead(unsound, indices, ref pose, ref velocity);
            worldInertia = Symmetric3x3Wide.Select(unsound, default, worldInertia);
        }
        WriteVelocity(pass.Motions, rows, velocity);
        WriteWorldInertia(pass.WorldInertias, rows, worldInertia, localInertia.InverseMass);
    }

    // The mean of the velocities at both ends is that of the whole time where the acceleration is the same all along: a parabola, whatever dt is. Forces
    // that depend on the place are those of the middle of the way, half a drift on: a drift, a kick and a drift keep the energy of an orbit, where a kick
    // from the place at the beginning would add to it in each turn.
    void IPoseIntegrator.IntegrateFree(float dt, in FreeBodies freeBodies, int startBundle, int endBundle, int workerIndex)
    {
        ref var set = ref bodies.Awake;
        var motions = (float*)set.MotionStates.Memory;
        var localInertias = (float*)set.LocalInertias.Memory;
        var displacements = (float*)set.Displacements.Memory;
        var origins = (float*)set.Origins.Memory;
        var wideDt = new Vector<float>(dt);
        for (int bundle = startBundle; bundle < endBundle; ++bundle)
        {
            var indices = Indices(bundle, set.Count, out var exists);
            if (!freeBodies.TryKeep(bundle, ref indices, ref exists))
                continue;
            var rows = new RowOffsets(indices);
            ReadBodies(motions, localInertias, rows, out var pose, out var velocity, out var localInertia);
            if (Soundness.IsNot(Soundness.OfBodies(pose, velocity), exists, out var unsound))
                StopAndRead(unsound, indices, ref pose, ref velocity);
            Begin(origins, displacements, rows, pose.Position, velocity.Linear);
            var before = velocity.Linear;
            var middle = pose;
            middle.Position += before * (wideDt * new Vector<float>(0.5f));
            IntegrateVelocity(indices, exists, IsKinematic(localInertia), middle, localInertia, workerIndex, wideDt, ref velocity);
            var fast = IsFast(before, velocity.Linear);
            if (Vector.EqualsAny(fast, new Vector<int>(-1)))
                KeepLostVelocity(origins, rows, indices, fast, middle, localInertia, workerIndex, wideDt, before, ref velocity.Linear);
            if (Soundness.IsNot(Soundness.OfVelocities(velocity), exists, out unsound))
            {
                // Where they are now is where they stay.
                quarantine.Stop(unsound, indices);
                indices |= unsound;
                exists = Vector.AndNot(exists, unsound);
                rows = new RowOffsets(indices);
            }
            var mean = (before + velocity.Linear) * new Vector<float>(0.5f);
            MovePoses(motions, origins, displacements, indices, rows, wideDt, mean, ref localInertia, ref pose, ref velocity);
            if (Soundness.IsNot(Soundness.OfVelocities(velocity), exists, out unsound))
                StopAndRead(unsound, indices, ref pose, ref velocity);
            WriteVelocity(motions, rows, velocity);
            if (keepsLostVelocity)
                RememberVelocity(origins, rows, velocity.Linear);
        }
    }

    void IPoseIntegrator.PredictVelocities(
        int bundle, float dt, int workerIndex, out RigidPoseWide pose, out BodyVelocityWide velocity, out Vector<float> speedSquared, out Vector<float> gain)
    {
        ref var set = ref bodies.Awake;
        var indices = Indices(bundle, set.Count, out var exists);
        BodyInertiaWide localInertia;
        if (Vector.EqualsAll(exists, Vector<int>.AllBitsSet))
        {
            RowRun run = new(bundle * Vector<int>.Count);
            ReadBodies((float*)set.MotionStates.Memory, (float*)set.LocalInertias.Memory, run, out pose, out velocity, out localInertia);
        }
        else
        {
            ReadBodies((float*)set.MotionStates.Memory, (float*)set.LocalInertias.Memory, new RowOffsets(indices), out pose, out velocity, out localInertia);
        }
        var sound = Soundness.OfBodies(pose, velocity, UnitTolerance.Combined) & Soundness.OfInertias(localInertia);
        if (Soundness.IsNot(sound, exists, out var unsound))
            StraightenOrStop(unsound, indices, localInertia, ref pose, ref velocity);
        var kinematic = IsKinematic(localInertia);
        if ((kinematic & exists) != Vector<int>.Zero)
            bodies.NoteMovedByPose(bundle * Vector<int>.Count, kinematic & exists);
        quarantine.Remember(bundle);
        var before = velocity;
        speedSquared = velocity.Linear.LengthSquared() + velocity.Angular.LengthSquared();
        speedSquared = Wide.Select(
            kinematic & Vector.GreaterThan(speedSquared, Vector<float>.Zero), new Vector<float>(float.PositiveInfinity), speedSquared);
        IntegrateVelocity(indices, exists, kinematic, pose, localInertia, workerIndex, new Vector<float>(dt), ref velocity);
        // What the callbacks make of a body is stopped where it is to stay; bounds only have to be bounds.
        sound = Soundness.OfVelocities(velocity);
        velocity.Linear = Vector3Wide.Select(sound, velocity.Linear, before.Linear);
        velocity.Angular = Vector3Wide.Select(sound, velocity.Angular, before.Angular);
        gain = (velocity.Linear - before.Linear).Length();
    }

    // Orientations that a game has written and not quite normalised would turn normals that are not of unit length.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void StraightenOrStop(Vector<int> lanes, Vector<int> indices, in BodyInertiaWide localInertia, ref RigidPoseWide pose, ref BodyVelocityWide velocity)
    {
        quarantine.Straighten(lanes, indices);
        ref var set = ref bodies.Awake;
        ReadBodies((float*)set.MotionStates.Memory, (float*)set.LocalInertias.Memory, new RowOffsets(indices), out pose, out velocity, out _);
        if (Soundness.IsNot(Soundness.OfBodies(pose, velocity) & Soundness.OfInertias(localInertia), lanes, out var unsound))
            StopAndRead(unsound, indices, ref pose, ref velocity);
    }

    // Bodies that are not sound are stopped in memory, whatever has been written of them there; the others are read as they were.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void StopAndRead(Vector<int> lanes, Vector<int> indices, ref RigidPoseWide pose, ref BodyVelocityWide velocity)
    {
        quarantine.Stop(lanes, indices);
        ref var set = ref bodies.Awake;
        ReadBodies((float*)set.MotionStates.Memory, (float*)set.LocalInertias.Memory, new RowOffsets(indices), out var stoppedPose, out _, out _);
        pose.Position = Vector3Wide.Select(lanes, stoppedPose.Position, pose.Position);
        pose.Orientation = QuaternionWide.Select(lanes, stoppedPose.Orientation, pose.Orientation);
        velocity.Linear = Vector3Wide.Mask(~lanes, velocity.Linear);
        velocity.Angular = Vector3Wide.Mask(~lanes, velocity.Angular);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> Indices(int bundle, int bodyCount, out Vector<int> exists)
    {
        var indices = new Vector<int>(bundle * Vector<int>.Count) + Vector<int>.Indices;
        exists = Vector.LessThan(indices, new Vector<int>(bodyCount));
        return Vector.ConditionalSelect(exists, indices, new Vector<int>(-1));
    }

    // A relaxation with inertias from before the turn would give energy to bodies that spin. Of no concern to other stages, and out of their way.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void WriteMovedInertia<TRows>(in TRows rows, in QuaternionWide orientation, Vector3Wide angular, Vector<float> dt, in BodyInertiaWide localInertia)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        ref var set = ref bodies.Awake;
        var worldInertia = Symmetric3x3Wide.RotateInverseInertia(localInertia.InverseInertiaTensor, orientation);
        // The momentum stays as the solve has left it.
        if (set.Stiffness.Allocated)
            Stiffen((float*)set.Stiffness.Memory, rows, dt, false, localInertia.InverseMass, ref worldInertia, ref angular);
        WriteWorldInertia((float*)set.WorldInertias.Memory, rows, worldInertia, localInertia.InverseMass);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsKinematic(in BodyInertiaWide inertia)
    {
        var zero = Vector<float>.Zero;
        var i = inertia.InverseInertiaTensor;
        return Vector.Equals(inertia.InverseMass, zero) & Vector.Equals(i.XX, zero) & Vector.Equals(i.YX, zero) & Vector.Equals(i.YY, zero) &
            Vector.Equals(i.ZX, zero) & Vector.Equals(i.ZY, zero) & Vector.Equals(i.ZZ, zero);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void MovePoses<TRows>(
        float* motions, float* origins, float* displacements, Vector<int> indices, in TRows rows, Vector<float> dt,
        in Vector3Wide meanLinear, ref BodyInertiaWide localInertia, ref RigidPoseWide pose, ref BodyVelocityWide velocity)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var row = Transpose.Gather(displacements, FloatsPerRow, rows);
        var translation = new Vector3Wide(row.R0, row.R1, row.R2) + meanLinear * dt;
        var rotation = new Vector3Wide(row.R4, row.R5, row.R6) + velocity.Angular * dt;
        row.R0 = translation.X;
        row.R1 = translation.Y;
        row.R2 = translation.Z;
        row.R3 = velocity.Linear.Z;
        row.R4 = rotation.X;
        row.R5 = rotation.Y;
        row.R6 = rotation.Z;
        Transpose.Scatter(row, displacements, FloatsPerRow, rows);

        var origin = Transpose.GatherHalf(origins, FloatsPerRow, rows);
        pose.Position = new Vector3Wide(origin.X, origin.Y, origin.Z) + translation;
        AddLinkInertia(row.R7, ref localInertia.InverseInertiaTensor);
        ref readonly var inverseInertia = ref localInertia.InverseInertiaTensor;
        switch (Callbacks.AngularIntegrationMode)
        {
            case AngularIntegrationMode.ConserveMomentum:
                FreeRotation.TurnKeepingMomentum(inverseInertia, dt, ref pose.Orientation, ref velocity.Angular);
                break;
            case AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque:
                FreeRotation.Tumble(inverseInertia, bodies.Awake.PrincipalFrames.Memory, indices, dt, ref pose.Orientation, ref velocity.Angular);
                break;
            default:
                pose.Orientation = FreeRotation.Turn(pose.Orientation, velocity.Angular, dt);
                break;
        }
        Rows8 poseRow;
        poseRow.R0 = pose.Orientation.X;
        poseRow.R1 = pose.Orientation.Y;
        poseRow.R2 = pose.Orientation.Z;
        poseRow.R3 = pose.Orientation.W;
        poseRow.R4 = pose.Position.X;
        poseRow.R5 = pose.Position.Y;
        poseRow.R6 = pose.Position.Z;
        poseRow.R7 = Vector<float>.Zero;
        Transpose.Scatter(poseRow, motions, FloatsPerMotion, rows);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void IntegrateVelocity(
        Vector<int> indices, Vector<int> exists, Vector<int> kinematic, in RigidPoseWide pose, in BodyInertiaWide localInertia, int workerIndex,
        Vector<float> dt, ref BodyVelocityWide velocity)
    {
        var mask = Callbacks.IntegrateVelocityForKinematics ? exists : Vector.AndNot(exists, kinematic);
        // Part by part: a copy of a whole is made by wider registers than its parts were written by, and waits for that.
        BodyVelocityWide changed;
        changed.Linear = new(velocity.Linear.X, velocity.Linear.Y, velocity.Linear.Z);
        changed.Angular = new(velocity.Angular.X, velocity.Angular.Y, velocity.Angular.Z);
        Callbacks.IntegrateVelocity(indices, pose.Position, pose.Orientation, localInertia, mask, workerIndex, dt, ref changed);
        velocity.Linear = Vector3Wide.Select(mask, changed.Linear, velocity.Linear);
        velocity.Angular = Vector3Wide.Select(mask, changed.Angular, velocity.Angular);
    }

    // Lanes in which the change of velocity is so small beside the velocity that what rounding takes of it matters.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> IsFast(in Vector3Wide before, in Vector3Wide after)
    {
        var change = after - before;
        return Vector.GreaterThan(before.LengthSquared(), change.LengthSquared() * new Vector<float>(FastRatio * FastRatio)) &
            Vector.GreaterThan(change.LengthSquared(), Vector<float>.Zero);
    }

    // The change by itself is what the callbacks make of a body at rest, provided that they only add: what they made of the moving body must
    // differ from the sum by no more than rounding. Damping, for one, does not; such lanes keep nothing.
    //
    // Runs where some lane is fast, and must not show it to the others: their rows stay as they are.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void KeepLostVelocity<TRows>(
        float* origins, in TRows rows, Vector<int> indices, Vector<int> fast, in RigidPoseWide pose, in BodyInertiaWide localInertia, int workerIndex,
        Vector<float> dt, in Vector3Wide before, ref Vector3Wide after)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        keepsLostVelocity = true;
        BodyVelocityWide added = default;
        Callbacks.IntegrateVelocity(indices, pose.Position, pose.Orientation, localInertia, fast, workerIndex, dt, ref added);
        var sum = before + added.Linear;
        var adds = fast & Vector.Equals(sum.X, after.X) & Vector.Equals(sum.Y, after.Y) & Vector.Equals(sum.Z, after.Z);
        var origin = Transpose.Gather(origins, FloatsPerRow, rows);
        var change = added.Linear + new Vector3Wide(Plausible(origin.R4, before.X), Plausible(origin.R5, before.Y), Plausible(origin.R6, before.Z));
        var changed = before + change;
        origin.R4 = Vector.ConditionalSelect(fast, Wide.Mask(adds, LeftOver(before.X, change.X, changed.X)), origin.R4);
        origin.R5 = Vector.ConditionalSelect(fast, Wide.Mask(adds, LeftOver(before.Y, change.Y, changed.Y)), origin.R5);
        origin.R6 = Vector.ConditionalSelect(fast, Wide.Mask(adds, LeftOver(before.Z, change.Z, changed.Z)), origin.R6);
        Transpose.Scatter(origin, origins, FloatsPerRow, rows);
        after = Vector3Wide.Select(adds, changed, after);
    }

    // More than rounding can take of a velocity was left by a faster one, before something else slowed the body down.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Plausible(Vector<float> lost, Vector<float> velocity) => Wide.Mask(
        Vector.LessThanOrEqual(Vector.Abs(lost), Vector.Abs(velocity) * new Vector<float>(GreatestLoss)), lost);

}
