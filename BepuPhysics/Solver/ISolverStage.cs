using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Points of a step at which optional stages of the solver may run.</summary>
enum SolverPoint
{
    /// <summary>Before the first substep: velocities are those of the last step.</summary>
    BeforeSubsteps,
    /// <summary>As the one before, when all stages are done there.</summary>
    LastBeforeSubsteps,
    /// <summary>Bodies of a substep have been integrated.</summary>
    AfterIntegration,
    /// <summary>As the one before, when all stages are done there: the place for what needs all of their results.</summary>
    BeforeWarmStart,
    /// <summary>Before the warm start of the first substep only, when all is done that comes before it: the place to look at all velocities.</summary>
    BeforeFirstWarmStart,
    /// <summary>As the one before, when all stages are done there: the place to arrange what they have seen.</summary>
    AmidBeforeFirstWarmStart,
    /// <summary>As the one before, when all stages are done there.</summary>
    LastBeforeFirstWarmStart,
    /// <summary>The impulses of the last substep have been applied: the place to look at all velocities.</summary>
    AfterWarmStart,
    /// <summary>As the one before, when all stages are done there: the place for stages that move a load across a whole structure.</summary>
    LastAfterWarmStart,
    /// <summary>The constraints of a substep have been solved; the bodies have not moved yet.</summary>
    AfterSolve,
    /// <summary>The bodies have moved to where they are at the end of the step.</summary>
    AfterSubsteps,
}

/// <summary>How many points there are.</summary>
static class SolverPoints
{
    internal const int Count = (int)SolverPoint.AfterSubsteps + 1;
}

/// <summary>An optional stage of the solver. A stage without blocks at a point costs nothing there.</summary>
interface ISolverStage
{
    /// <summary>Whether it changes velocities after the substeps.</summary>
    bool ChangesVelocities => true;

    /// <summary>Makes ready for a step. Called on the caller's thread.</summary>
    /// <returns>Whether it may have blocks anywhere in the step; one that has none is not asked where.</returns>
    bool BeginStep() => true;

    /// <summary>Number of independent blocks of work at a point, as far as it is known before the step.</summary>
    int GetBlockCount(SolverPoint point);

    /// <summary>How many blocks there are after all, now that all is done that comes before them. Called once per point, on some worker.</summary>
    /// <param name="point">The point.</param>
    /// <param name="most">What <see cref="GetBlockCount"/> has said.</param>
    int CountBlocks(SolverPoint point, int most) => most;

    /// <summary>Does one block. Called on worker threads.</summary>
    /// <param name="point">The point.</param>
    /// <param name="substep">The substep.</param>
    /// <param name="block">The block.</param>
    /// <param name="workerPool">Temporary memory, of this worker alone.</param>
    void Execute(SolverPoint point, in Substep substep, int block, BufferPool workerPool) => Execute(point, substep, block);

    /// <summary>As the other one, for stages that need no memory.</summary>
    void Execute(SolverPoint point, in Substep substep, int block)
    {
    }

    /// <summary>Ends a step, also one that an exception of the game broke off. Called on the caller's thread.</summary>
    void EndStep() { }
}
