using System;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;

namespace BepuPhysics;

// The constraints of a sweep, cut into blocks, and the stages that go through them.
public sealed unsafe partial class Solver
{
    // A range of bundles of the joints, or of the contacts, of one batch: their type batches are counted one after the other. A batch is cut where it comes out
    // even, whatever types it is of, so that each worker has as much to do as the others and finds in its cache what it had in the stage before.
    struct Block
    {
        public int Batch;
        public bool IsOfJoints;
        public int StartBundle;
        public int EndBundle;
    }

    // Blocks of a batch: those of joints, then those of contacts.
    struct BlockRange
    {
        public int Start;
        public int JointCount;
        public int Count;
        // Whether it has so few constraints that sharing them takes longer than solving them.
        public bool IsSmall;
    }

    void BuildBlocks(ref SolveWork work)
    {
        ref var batches = ref ActiveSet.Batches;
        work.Blocks = new QuickList<Block>(64, pool);
        work.BlocksOfBatch = new QuickList<BlockRange>(Math.Max(1, batches.Count), pool);
        for (int i = 0; i < batches.Count; ++i)
        {
            var start = work.Blocks.Count;
            if (batches[i].Kind is BatchKind.Direct or BatchKind.Disabled)
            {
                work.BlocksOfBatch.Add(default, pool);
                continue;
            }
            var bundles = AddBlocks(ref work, i, ofJoints: true);
            var firstContacts = work.Blocks.Count;
            bundles += AddBlocks(ref work, i, ofJoints: false);
            work.BlocksOfBatch.Add(new()
            {
                Start = start,
                JointCount = firstContacts - start,
                Count = work.Blocks.Count - start,
                IsSmall = bundles <= ConstraintBundlesPerBlock && batches[i].Kind == BatchKind.Coloured,
            }, pool);
        }
    }

    // Returns the number of bundles.
    int AddBlocks(ref SolveWork work, int batchIndex, bool ofJoints)
    {
        ref var batch = ref ActiveSet.Batches[batchIndex];
        var bundles = 0;
        foreach (ref var typeBatch in batch.TypeBatches.AsSpan())
            bundles += IsOfJoints(typeBatch) == ofJoints ? typeBatch.BundleCount : 0;
        var count = EvenBlockCount(bundles, ConstraintBundlesPerBlock);
        for (int i = 0; i < count; ++i)
        {
            work.Blocks.Add(new()
            {
                Batch = batchIndex,
                IsOfJoints = ofJoints,
                StartBundle = StartOfBlock(i, count, bundles),
                EndBundle = StartOfBlock(i + 1, count, bundles),
            }, pool);
        }
        return bundles;
    }

    static bool IsOfJoints(in TypeBatch batch) => batch.TypeId >= ConstraintTypeIds.ContactTypeCount;

    // Numbers that two and four workers share evenly, but for what is one block.
    static int EvenBlockCount(int bundles, int mostPerBlock) =>
        bundles <= mostPerBlock ? Math.Min(bundles, 1) : EvenParts * BlockCount(bundles, EvenParts * mostPerBlock);

    static int StartOfBlock(int block, int blockCount, int bundles) => (int)((long)bundles * block / blockCount);

    void AddSweep(ref SolveWork work, StageKind kind, int substep)
    {
        if (!work.ShufflesOrder)
        {
            for (int i = 0; i < work.BlocksOfBatch.Count; ++i)
                AddBatch(ref work, kind, substep, i, work.BlocksOfBatch[i].Start, work.BlocksOfBatch[i].Count);
            return;
        }
        for (int i = 0; i < work.Order.Count; ++i)
        {
            var batch = work.Order[i];
            ref var blocks = ref work.BlocksOfBatch[batch];
            // Split bodies are joined once for all of their constraints.
            AddBatch(ref work, kind, substep, batch, blocks.Start, IsFallback(batch) ? blocks.Count : blocks.JointCount);
        }
        for (int i = 0; i < work.BlocksOfBatch.Count; ++i)
        {
            ref var blocks = ref work.BlocksOfBatch[i];
            if (!IsFallback(i) || blocks.JointCount == 0)
                AddBatch(ref work, kind, substep, i, blocks.Start + blocks.JointCount, blocks.Count - blocks.JointCount);
        }
    }

    void AddBatch(ref SolveWork work, StageKind kind, int substep, int batch, int firstBlock, int blockCount)
    {
        if (blockCount == 0)
            return;
        var isSmall = work.BlocksOfBatch[batch].IsSmall;
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
