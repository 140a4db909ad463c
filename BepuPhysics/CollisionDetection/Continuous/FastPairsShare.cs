using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What all threads do for <see cref="FastPairs"/> before impacts are made.</summary>
/// <param name="fastPairs">The pairs.</param>
/// <param name="sweeps">Whether pairs are swept; before that the ways of bodies begin.</param>
sealed class FastPairsShare(FastPairs fastPairs, bool sweeps) : ISolverStage
{
    bool ISolverStage.BeginStep() => fastPairs.SharedBlockCount > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) =>
        point is SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps ? fastPairs.SharedBlockCount : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block, BufferPool workerPool)
    {
        if (!FastPairs.HasMoved(point, substep))
            return;
        var blocks = fastPairs.SharedBlockCount;
        if (sweeps)
            fastPairs.SweepAll(block, blocks, substep.Dt, workerPool);
        else
            fastPairs.BeginWays(block, blocks, substep.Dt);
    }
}
