using System;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Reads the greatest error of all rigid constraints at the end of a step, for the governor.</summary>
// A greatest number is the same in any order, so neither blocks nor lanes nor threads can change it.
sealed unsafe class ConstraintErrorStage(Solver solver, Bodies bodies) : ISolverStage
{
    const int MaximumBlocks = 64;
    const int LeastBundlesPerBlock = 32;

    readonly float[] errors = new float[MaximumBlocks];
    int blockCount;
    int bundleCount;

    /// <summary>Greatest error of the last step, m.</summary>
    internal float Error
    {
        get
        {
            float greatest = 0;
            for (int i = 0; i < blockCount; ++i)
                greatest = MathHelper.Max(greatest, errors[i]);
            return greatest;
        }
    }

    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep() => solver.Governor is not null;

    int ISolverStage.GetBlockCount(SolverPoint point)
    {
        if (point != SolverPoint.AfterSubsteps || solver.Governor is null)
            return 0;
        bundleCount = 0;
        ref var batches = ref solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            for (int j = 0; j < batches[i].TypeBatches.Count; ++j)
                bundleCount += Bundles(batches[i], j);
        }
        blockCount = Math.Min(MaximumBlocks, (bundleCount + LeastBundlesPerBlock - 1) / LeastBundlesPerBlock);
        return blockCount;
    }

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        var start = (int)((long)bundleCount * block / blockCount);
        var end = (int)((long)bundleCount * (block + 1) / blockCount);
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        // The substep that would be next: bodies have moved since collision detection.
        var next = new Substep(substep.Index + 1, substep.Dt);
        float greatest = 0;
        var first = 0;
        ref var batches = ref solver.ActiveSet.Batches;
        for (int i = 0; i < batches.Count; ++i)
        {
            for (int j = 0; j < batches[i].TypeBatches.Count && first < end; ++j)
            {
                ref var batch = ref batches[i].TypeBatches[j];
                var count = Bundles(batches[i], j);
                var from = Math.Max(start - first, 0);
                var to = Math.Min(end - first, count);
                if (from < to)
                    greatest = MathHelper.Max(greatest, solver.Processor(batch.TypeId).GreatestError(ref batch, awake, next, from, to));
                first += count;
            }
        }
        errors[block] = greatest;
    }

    int Bundles(in ConstraintBatch batch, int typeBatch) =>
        batch.Kind != BatchKind.Disabled && solver.Processor(batch.TypeBatches[typeBatch].TypeId).HasError ? batch.TypeBatches[typeBatch].BundleCount : 0;
}
