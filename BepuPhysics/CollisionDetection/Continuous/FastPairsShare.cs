using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is done for <see cref="FastPairs"/> before impacts are made, mostly by all threads.</summary>
/// <param name="fastPairs">The pairs.</param>
/// <param name="part">Which part of it.</param>
sealed class FastPairsShare(FastPairs fastPairs, FastPairsShare.Part part) : ISolverStage
{
    /// <summary>The parts in their order.</summary>
    internal enum Part
    {
        /// <summary>The ways of bodies begin.</summary>
        Ways,
        /// <summary>The bounds of those grow who were thrown aside. For one thread.</summary>
        Growth,
        /// <summary>Pairs are swept, and those who were thrown aside look around.</summary>
        Sweeps,
    }

    bool ISolverStage.BeginStep() => fastPairs.SharedBlockCount > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) => point is not (SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps) ? 0
        : part == Part.Growth ? int.Min(1, fastPairs.SharedBlockCount) : fastPairs.SharedBlockCount;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block, BufferPool workerPool)
    {
        if (!FastPairs.HasMoved(point, substep))
            return;
        var blocks = fastPairs.SharedBlockCount;
        switch (part)
        {
            case Part.Ways:
                fastPairs.BeginWays(block, blocks, substep.Dt);
                break;
            case Part.Growth:
                fastPairs.GrowTurnedAside(fastPairs.EndOf(point, substep));
                break;
            default:
                fastPairs.SweepAll(block, blocks, substep.Dt, fastPairs.EndOf(point, substep), workerPool);
                fastPairs.LookAll(block, blocks);
                break;
        }
    }
}
