using BepuPhysics;
using BepuPhysics.Constraints;
using Demos.Running;

namespace Demos.Engine;

/// <summary>What differs between engines: here bepuphysics2, at the settings of its own demos.</summary>
static class EngineDefaults
{
    public const string Name = "bepuphysics2";

    /// <summary>Metres per second.</summary>
    public const float MaximumRecoveryVelocity = 2;

    public static SpringSettings ContactSpring => new(30, 1);

    public static SpringSettings JointSpring => new(30, 1);

    /// <summary>
    /// Seconds of the last step. The engine counts the prediction of bounds and the last integration together, here as "predict"; its
    /// narrow phase runs while the broad phase looks for overlaps.
    /// </summary>
    public static StageTimes ReadStages(Simulation simulation)
    {
        SimulationProfiler profiler = simulation.Profiler;
        return new StageTimes(profiler[simulation.Sleeper], profiler[simulation.PoseIntegrator], profiler[simulation.BroadPhase],
            profiler[simulation.BroadPhaseOverlapFinder], profiler[simulation.NarrowPhase], profiler[simulation.Solver],
            profiler[simulation.SolverBatchCompressor]);
    }

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
}
