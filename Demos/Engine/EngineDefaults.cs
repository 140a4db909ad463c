using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Running;

namespace Demos.Engine;

/// <summary>What differs between engines: here this library, at its own defaults.</summary>
static class EngineDefaults
{
    public const string Name = "tootbird";

    /// <summary>Metres per second.</summary>
    public const float MaximumRecoveryVelocity = 2;

    /// <summary>Seconds.</summary>
    public const float MaximumTimestep = Limits.MaximumTimestep;

    /// <summary>Hz.</summary>
    public const float MaximumSpringFrequency = Limits.MaximumSpringFrequency;

    public const float MaximumDampingRatio = Limits.MaximumDampingRatio;

    /// <summary>Loads are handed down to the ground in one go where that is needed.</summary>
    public const LoadPathChoice LoadPath = LoadPathChoice.WhereNeeded;

    /// <summary>Joints are solved one after the other.</summary>
    public const DirectJointsChoice DirectJoints = DirectJointsChoice.Off;

    /// <summary>Contacts as hard as the step allows.</summary>
    public static SpringSettings ContactSpring => default;

    /// <summary>Joints as hard as the step allows.</summary>
    public static SpringSettings JointSpring => default;

    /// <summary>How bodies turn: as a rigid body does, the library's default.</summary>
    public const AngularIntegrationMode RotationMode = AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;

    /// <summary>How hard the solver works.</summary>
    public static SolveDescription Solve(RunSettings settings) =>
        new(settings.Iterations, settings.Substeps)
        {
            RelaxationIterationCount = settings.Relaxations,
            LoadPath = (LoadPathMode)settings.LoadPath,
            DirectJoints = (DirectJointsMode)settings.DirectJoints,
        };

    /// <summary>Seconds of the stages of the last step.</summary>
    public static StageTimes ReadStages(Simulation simulation)
    {
        SimulationProfiler profiler = simulation.Profiler;
        return new StageTimes(null, profiler[simulation.PoseIntegrator], profiler[simulation.BroadPhase], profiler[simulation.NarrowPhase],
            profiler[SimulationProfiler.Flush], profiler[simulation.Solver], null);
    }

    /// <summary>Colours of the active constraints.</summary>
    public static int? CountBatches(Simulation simulation) => simulation.Solver.ActiveSet.Batches.Count;

    /// <summary>Constraints of bodies that have more of them than there are colours.</summary>
    public static int? CountFallback(Simulation simulation)
    {
        var count = 0;
        foreach (ref ConstraintBatch batch in simulation.Solver.ActiveSet.Batches.AsSpan())
            count += batch.Kind == BatchKind.Fallback ? batch.CountConstraints() : 0;
        return count;
    }

    /// <summary>Bytes that a pool has lent; null where the engine does not tell.</summary>
    public static double? LentBytes(BufferPool pool) => pool.GetTotalTakenByteCount();
}
