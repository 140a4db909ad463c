using System;
using BepuPhysics.Constraints;

namespace BepuPhysics;

/// <summary>Sums the impulses of those constraints that may break over the substeps of a step.</summary>
// An impulse is final when the next substep begins, as relaxation still changes it. Each constraint has a place of its own: no order matters.
sealed class BreakStage(Solver solver) : ISolverStage
{
    const int ConstraintsPerBlock = 128;

    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep() => solver.BreakableCount > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) => point is SolverPoint.BeforeWarmStart or SolverPoint.AfterSubsteps
        ? (solver.BreakableCount + ConstraintsPerBlock - 1) / ConstraintsPerBlock : 0;

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        // What the last step left has been counted by it.
        if (point == SolverPoint.BeforeWarmStart && substep.Index == 0)
            return;
        var start = block * ConstraintsPerBlock;
        solver.AddBreakingImpulses(start, Math.Min(start + ConstraintsPerBlock, solver.BreakableCount));
    }
}
