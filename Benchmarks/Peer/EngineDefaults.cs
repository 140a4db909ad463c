using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Engine;

/// <summary>What differs between engines: here bepuphysics2, at the settings of its own demos.</summary>
static class EngineDefaults
{
    public const string Name = "bepuphysics2";

    /// <summary>Metres per second.</summary>
    public const float MaximumRecoveryVelocity = 2;

    /// <summary>Seconds: it has no limit of its own, and hangs without one.</summary>
    public const float MaximumTimestep = 1;

    /// <summary>Hz.</summary>
    public const float MaximumSpringFrequency = 1e6f;

    public const float MaximumDampingRatio = 1e6f;

    public static SpringSettings ContactSpring => new(30, 1);

    public static SpringSettings JointSpring => new(30, 1);

    public const AngularIntegrationMode RotationMode = AngularIntegrationMode.Nonconserving;

    /// <summary>It has none.</summary>
    public const LoadPathChoice LoadPath = LoadPathChoice.Off;

    /// <summary>It has none.</summary>
    public const DirectJointsChoice DirectJoints = DirectJointsChoice.Off;

    /// <summary>How hard the solver works.</summary>
    public static SolveDescription Solve(RunSettings settings) =>
        settings is { Relaxations: 0, LoadPath: LoadPathChoice.Off, DirectJoints: DirectJointsChoice.Off }
        ? new(settings.Iterations, settings.Substeps)
        : throw new SceneException("this engine has neither relaxation sweeps nor a load path nor direct joints");

    /// <summary>
    /// Seconds of the last step, as far as the engine was built with its profiler. It counts the prediction of bounds and the last
    /// integration together, here as "predict"; its narrow phase runs while the broad phase looks for overlaps.
    /// </summary>
    public static StageTimes ReadStages(Simulation simulation) => new(
        Seconds(simulation, simulation.Sleeper), Seconds(simulation, simulation.PoseIntegrator), Seconds(simulation, simulation.BroadPhase),
        Seconds(simulation, simulation.BroadPhaseOverlapFinder), Seconds(simulation, simulation.NarrowPhase),
        Seconds(simulation, simulation.Solver), Seconds(simulation, simulation.SolverBatchCompressor));

    /// <summary>A build without profiler answers -1.</summary>
    static double? Seconds(Simulation simulation, object stage) => simulation.Profiler[stage] is >= 0 and double seconds ? seconds : null;

    public static int? CountBatches(Simulation simulation) => simulation.Solver.ActiveSet.Batches.Count;

    public static int? CountFallback(Simulation simulation)
    {
        ref ConstraintSet active = ref simulation.Solver.ActiveSet;
        int threshold = simulation.Solver.FallbackBatchThreshold;
        int count = 0;
        if (active.Batches.Count > threshold)
        {
            ref ConstraintBatch fallback = ref active.Batches[threshold];
            for (int i = 0; i < fallback.TypeBatches.Count; ++i)
                count += fallback.TypeBatches[i].ConstraintCount;
        }
        return count;
    }

    /// <summary>Its pools do not tell.</summary>
    public static double? LentBytes(BufferPool pool) => null;
}
