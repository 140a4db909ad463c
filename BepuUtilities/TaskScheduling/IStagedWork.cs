namespace BepuUtilities.TaskScheduling;

/// <summary>
/// Work made of ordered stages. The blocks of one stage are independent of each other and run in any order on any worker; a stage
/// begins when all blocks of the one before have ended, and sees what they wrote.
/// </summary>
public interface IStagedWork
{
    /// <summary>Number of stages. It does not change while the work runs.</summary>
    int StageCount { get; }

    /// <summary>Number of blocks of a stage; zero is allowed. Called once per stage, on some worker, when the stage before has ended.</summary>
    int GetBlockCount(int stage);

    /// <summary>Does a block.</summary>
    /// <param name="stage">Index of the stage.</param>
    /// <param name="block">Index of the block within the stage.</param>
    /// <param name="workerIndex">Index of the worker that calls, for its memory pool: below the dispatcher's thread count.</param>
    void Execute(int stage, int block, int workerIndex);
}
