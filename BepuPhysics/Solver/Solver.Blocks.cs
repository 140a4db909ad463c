using System;
using BepuUtilities.Collections;

namespace BepuPhysics;

// The constraints of a sweep, cut into blocks, and the stages that go through them.
public sealed unsafe partial class Solver
{
    // A range of bundles of one batch: its type batches are counted one after the other. A batch is cut where it comes out
    // even, whatever types it is of, so that each worker has as much to do as the others and finds in its cache what it had in the stage before.
    struct Block
    {
        public int Batch;
        public int StartBundle;
        public int EndBundle;
    }

    struct BlockRange
    {
        public int Start;
        public int Count;
        // Whether it has so few constraints that sharing them takes longer than solving them.
        public bool IsSmall;
        // Whether it is swept over in random order.
        public bool IsDrawn;
    }

    void BuildBlocks(ref SolveWork work)
    {
        ref var batches = ref ActiveSet.Batches;
        work.Blocks = new QuickList<Block>(64, pool);
        work.BlocksOfBatch = new QuickList<BlockRange>(Math.Max(1, batches.Count), pool);
        for (int i = 0; i < batches.Count; ++i)
        {
            var start = work.Blocks.Count;
            if (!batches[i].IsSwept)
            {
                work.BlocksOfBatch.Add(default, pool);
                continue;
            }
            var bundles = AddBlocks(ref work, i);
            work.BlocksOfBatch.Add(new()
            {
                Start = start,
                Count = work.Blocks.Count - start,
                IsSmall = bundles <= ConstraintBundlesPerBlock && batches[i].IsOfColour,
            }, pool);
        }
    }

    // Returns the number of bundles.
    int AddBlocks(ref SolveWork work, int batchIndex)
    {
        ref var batch = ref ActiveSet.Batches[batchIndex];
        var bundles = 0;
        foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
            bundles += typeBatch.BundleCount;
        var count = EvenBlockCount(bundles, ConstraintBundlesPerBlock);
        for (int i = 0; i < count; ++i)
        {
            work.Blocks.Add(new()
            {
                Batch = batchIndex,
                StartBundle = StartOfBlock(i, count, bundles),
                EndBundle = StartOfBlock(i + 1, count, bundles),
            }, pool);
        }
        return bundles;
    }

    // Numbers that two and four workers share evenly, but for what is one block.
    static int EvenBlockCount(int bundles, int mostPerBlock) =>
        bundles <= mostPerBlock ? Math.Min(bundles, 1) : EvenParts * BlockCount(bundles, EvenParts * mostPerBlock);

    static int StartOfBlock(int block, int blockCount, int bundles) => (int)((long)bundles * block / blockCount);

    void AddSweep(ref SolveWork work, StageKind kind, int substep)
    {
        for (int i = 0; i < work.Order.Count; ++i)
            AddBatch(ref work, kind, substep, work.Order[i].Batch);
        for (int i = 0; i < work.BlocksOfBatch.Count; ++i)
        {
            if (!work.BlocksOfBatch[i].IsDrawn)
                AddBatch(ref work, kind, substep, i);
        }
    }

    void AddBatch(ref SolveWork work, StageKind kind, int substep, int batch)
    {
        var (firstBlock, blockCount, isSmall) = (work.BlocksOfBatch[batch].Start, work.BlocksOfBatch[batch].Count, work.BlocksOfBatch[batch].IsSmall);
        if (blockCount == 0)
            return;
        if (isSmall && TryContinueRow(ref work, kind, firstBlock, blockCount))
            return;
        work.Stages.Add(new()
        {
            Kind = kind,
            Substep = substep,
            Batch = batch,
            FirstBlock = firstBlock,
            BlockCount = isSmall ? 1 : blockCount,
            BlocksInRow = isSmall ? blockCount : 0,
        }, pool);
        if (IsFallback(batch))
            work.Stages.Add(new() { Kind = StageKind.JoinParts, Batch = batch, BlockCount = -1 }, pool);
    }

    // A body with hundreds of contacts has a batch for each of the first of them, most of which have no other constraint. To hand work over after each
    // would take longer than the work.
    static bool TryContinueRow(ref SolveWork work, StageKind kind, int firstBlock, int blockCount)
    {
        ref var last = ref work.Stages[work.Stages.Count - 1];
        if (last.Kind != kind || last.BlocksInRow == 0 || last.FirstBlock + last.BlocksInRow != firstBlock)
            return false;
        last.BlocksInRow += blockCount;
        return true;
    }
}
