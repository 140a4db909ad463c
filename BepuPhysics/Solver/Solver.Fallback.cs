using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

// The fallback batch: which bodies are split, into how many parts, and where the parts are.
public sealed unsafe partial class Solver
{
    /// <summary>Split bodies per block.</summary>
    const int SplitBodiesPerBlock = 64;
    /// <summary>Parts beyond which a split body is a block of its own.</summary>
    const int HeavyPartCount = 2 * SplitBodiesPerBlock;

    // Parts of all split bodies, built anew each step in which there is a fallback batch; costs nothing where there is none.
    struct FallbackParts
    {
        // Number of split bodies.
        public int BodyCount;
        // Number of parts by index in the active set.
        public Buffer<int> Counts;
        // Share of its body's mass that each part has; 1 for kinematic bodies and unused lanes.
        public Buffer<float> Shares;
        // Velocity of each part, type batch after type batch, bundle after bundle, slot after slot, lane after lane: so a slot's shares are a vector.
        public Buffer<BodyVelocity> Parts;
        // Where the parts of each type batch begin.
        public QuickList<int> StartOfTypeBatch;
        // Bodies with very many parts: each is a block of its own, and these come first, so that nobody begins with one when all others have ended.
        public int HeavyCount;
        // Index in the active set of each split body, those with very many parts first.
        public QuickList<int> SplitBodies;
        // Parts of split body i are PartsOfBody[StartOfBody[i]] up to StartOfBody[i + 1], in the order of the constraints.
        public QuickList<int> StartOfBody;
        public Buffer<int> PartsOfBody;

        public readonly SplitBodies For(
            int typeBatch) => new(Shares.Memory + StartOfTypeBatch[typeBatch], Parts.Memory + StartOfTypeBatch[typeBatch]);

        public readonly int JoinBlockCount => HeavyCount + BlockCount(BodyCount - HeavyCount, SplitBodiesPerBlock);

        public readonly void Join(ref BodySet set, int block)
        {
            var first = block < HeavyCount ? block : HeavyCount + (block - HeavyCount) * SplitBodiesPerBlock;
            Join(ref set, first, block < HeavyCount ? first + 1 : Math.Min(first + SplitBodiesPerBlock, BodyCount));
        }

        // The velocity of a body is the mean of its parts by mass, summed in the order of the constraints. What changed is summed, since the
        // parts started from that velocity: so a body that nothing pushes keeps every bit of it.
        readonly void Join(ref BodySet set, int start, int end)
        {
            for (int i = start; i < end; ++i)
            {
                ref var velocity = ref set.MotionStates[SplitBodies[i]].Velocity;
                var before = Row(ref velocity);
                var change = Vector256<float>.Zero;
                for (int j = StartOfBody[i]; j < StartOfBody[i + 1]; ++j)
                    change += (Row(ref Parts[PartsOfBody[j]]) - before) * Shares[PartsOfBody[j]];
                velocity.Linear += change.GetLower().AsVector3();
                velocity.Angular += change.GetUpper().AsVector3();
            }
        }

        // Linear in the lower half, angular in the upper one, and one number of padding in each.
        static Vector256<float> Row(ref BodyVelocity velocity) => Vector256.LoadUnsafe(ref Unsafe.As<BodyVelocity, float>(ref velocity));

        public void Dispose(BufferPool pool)
        {
            if (!Counts.Allocated)
                return;
            pool.Return(ref Counts);
            pool.Return(ref Shares);
            pool.Return(ref Parts);
            pool.Return(ref PartsOfBody);
            StartOfTypeBatch.Dispose(pool);
            SplitBodies.Dispose(pool);
            StartOfBody.Dispose(pool);
        }
    }

    // Who is split, and how, has nothing to do with the motion of bodies, nor with what rests on what: another worker finds out beside the latter, which
    // is the longer part, if it is asked for, else beside the first integration.
    void AddSplitting(ref SolveWork work)
    {
        if (!HasFallback)
            return;
        var stage = work.Stages.Count - 1;
        while (work.Stages[stage].Kind != StageKind.Integrate && work.Stages[stage].Point != SolverPoint.BeforeFirstWarmStart)
            --stage;
        work.Stages[stage].Splits = true;
    }

    // Whether any constraint is swept over on split bodies.
    bool HasFallback => FindBatch(ActiveSet, BatchKind.Fallback) is >= 0 and var index && ActiveSet.Batches[index].TypeBatches.Count > 0;

    // On some worker, which alone uses the pool then.
    void BuildSplitBodies(ref FallbackParts split)
    {
        ref var batches = ref ActiveSet.Batches;
        var fallback = FindBatch(ActiveSet, BatchKind.Fallback);
        ref var typeBatches = ref batches[fallback].TypeBatches;
        pool.Take(bodies.ActiveSet.Count, out split.Counts);
        split.Counts.Clear(0, split.Counts.Length);
        split.StartOfTypeBatch = new QuickList<int>(typeBatches.Count, pool);
        int partCount = 0;
        for (int i = 0; i < typeBatches.Count; ++i)
        {
            split.StartOfTypeBatch.Add(partCount, pool);
            partCount += typeBatches[i].BundleCount * Vector<float>.Count * Processor(typeBatches[i].TypeId).BodiesPerConstraint;
        }
        pool.Take(partCount, out split.Parts);
        pool.Take(partCount, out split.PartsOfBody);
        pool.Take(partCount, out split.Shares);
        split.Shares.AsSpan().Fill(1);

        // Count the parts of each body, give each split body a range, then fill the ranges in the order of the constraints.
        VisitParts(ref split, batches[fallback], null);
        split.SplitBodies = new QuickList<int>(64, pool);
        split.StartOfBody = new QuickList<int>(64, pool);
        pool.Take<int>(bodies.ActiveSet.Count, out var next);
        int start = 0;
        for (int i = 0; i < bodies.ActiveSet.Count; ++i)
        {
            if (split.Counts[i] > HeavyPartCount)
                AddSplitBody(ref split, i, next, ref start);
        }
        split.HeavyCount = split.SplitBodies.Count;
        for (int i = 0; i < bodies.ActiveSet.Count; ++i)
        {
            if (split.Counts[i] is > 0 and <= HeavyPartCount)
                AddSplitBody(ref split, i, next, ref start);
        }
        split.StartOfBody.Add(start, pool);
        split.BodyCount = split.SplitBodies.Count;
        VisitParts(ref split, batches[fallback], next.Memory);
        pool.Return(ref next);
        for (int i = 0; i < split.BodyCount; ++i)
            Normalize(ref split, split.StartOfBody[i], split.StartOfBody[i + 1]);
    }

    void AddSplitBody(ref FallbackParts split, int body, Buffer<int> next, ref int start)
    {
        next[body] = start;
        split.SplitBodies.Add(body, pool);
        split.StartOfBody.Add(start, pool);
        start += split.Counts[body];
    }

    // Shares of a body add up to one.
    static void Normalize(ref FallbackParts split, int start, int end)
    {
        float sum = 0;
        for (int i = start; i < end; ++i)
            sum += split.Shares[split.PartsOfBody[i]];
        for (int i = start; i < end; ++i)
            split.Shares[split.PartsOfBody[i]] /= sum;
    }

    // How much of a body's mass a constraint can make use of: as much as the mass that it moves together with the others'. The ground under a
    // table needs all of the table's, a cup on it no more than the cup's. With equal shares the ground would hold a table with 300 cups by a
    // three-hundredth of its mass, and the table would sink through it.
    static float Need(float inverseMass, float sumOfInverseMasses)
    {
        // Keeps a part from being so light that its velocity means nothing.
        const float Least = 1e-3f;
        // Bodies that cannot be moved, only turned, have no mass to compare.
        return sumOfInverseMasses > 0 ? MathF.Max(Least, inverseMass / sumOfInverseMasses) : 1;
    }

    // Counts the parts of each body, or, with the next free place of each body's range, fills the ranges. In the order of the types' ids: that of
    // the type batches is the order in which constraints of the types were first there, be they removed since.
    void VisitParts(ref FallbackParts split, ConstraintBatch batch, int* next)
    {
        ref var typeBatches = ref batch.TypeBatches;
        for (int typeId = 0; typeId < MaximumTypeCount; ++typeId)
        {
            var i = batch.Find(typeId);
            if (i < 0)
                continue;
            var bodyCount = Processor(typeId).BodiesPerConstraint;
            var lanes = Vector<float>.Count;
            var firstPart = split.StartOfTypeBatch[i];
            for (int constraint = 0; constraint < typeBatches[i].ConstraintCount; ++constraint)
            {
                // Parts lie as references do.
                var first = constraint / lanes * bodyCount * lanes + constraint % lanes;
                var references = typeBatches[i].BodyReferences.Memory + first;
                if (next == null)
                    CountParts(ref split, references, bodyCount, firstPart + first);
                else
                    FillParts(ref split, references, bodyCount, firstPart + first, next);
            }
        }
    }

    void CountParts(ref FallbackParts split, int* references, int bodyCount, int firstPart)
    {
        ref var inertias = ref bodies.ActiveSet.LocalInertias;
        var lanes = Vector<float>.Count;
        float sum = 0;
        for (int slot = 0; slot < bodyCount; ++slot)
            sum += inertias[references[slot * lanes] & EncodedBody.IndexMask].InverseMass;
        for (int slot = 0; slot < bodyCount; ++slot)
        {
            var reference = references[slot * lanes];
            if ((reference & EncodedBody.KinematicFlag) != 0)
                continue;
            var body = reference & EncodedBody.IndexMask;
            ++split.Counts[body];
            split.Shares[firstPart + slot * lanes] = Need(inertias[body].InverseMass, sum);
        }
    }

    static void FillParts(ref FallbackParts split, int* references, int bodyCount, int firstPart, int* next)
    {
        var lanes = Vector<float>.Count;
        for (int slot = 0; slot < bodyCount; ++slot)
        {
            var reference = references[slot * lanes];
            if ((reference & EncodedBody.KinematicFlag) == 0)
                split.PartsOfBody[next[reference & EncodedBody.IndexMask]++] = firstPart + slot * lanes;
        }
    }
}
