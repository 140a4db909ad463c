using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

// The fallback batch: which bodies are split, into how many parts, and where the parts are.
public sealed unsafe partial class Solver
{
    // Parts of all split bodies, built anew each step in which there is a fallback batch; costs nothing where there is none.
    struct FallbackParts
    {
        // Number of split bodies.
        public int BodyCount;
        // Number of parts by index in the active set, as a float.
        public Buffer<float> Counts;
        // Velocity of each part, type batch after type batch, constraint after constraint, slot after slot.
        public Buffer<BodyVelocity> Parts;
        // Where the parts of each type batch begin.
        public QuickList<int> StartOfTypeBatch;
        // Index in the active set of each split body.
        public QuickList<int> SplitBodies;
        // Parts of split body i are PartsOfBody[StartOfBody[i]] up to StartOfBody[i + 1], in the order of the constraints.
        public QuickList<int> StartOfBody;
        public Buffer<int> PartsOfBody;

        public readonly SplitBodies For(int typeBatch) => new(Counts.Memory, Parts.Memory + StartOfTypeBatch[typeBatch]);

        // The velocity of a body is the mean of its parts, summed in the order of the constraints.
        public readonly void Join(ref BodySet set, int start, int end)
        {
            for (int i = start; i < end; ++i)
            {
                Vector3 linear = default, angular = default;
                for (int j = StartOfBody[i]; j < StartOfBody[i + 1]; ++j)
                {
                    ref var part = ref Parts[PartsOfBody[j]];
                    linear += part.Linear;
                    angular += part.Angular;
                }
                var inverseCount = 1 / Counts[SplitBodies[i]];
                ref var velocity = ref set.MotionStates[SplitBodies[i]].Velocity;
                velocity.Linear = linear * inverseCount;
                velocity.Angular = angular * inverseCount;
            }
        }

        public void Dispose(BufferPool pool)
        {
            if (!Counts.Allocated)
                return;
            pool.Return(ref Counts);
            pool.Return(ref Parts);
            pool.Return(ref PartsOfBody);
            StartOfTypeBatch.Dispose(pool);
            SplitBodies.Dispose(pool);
            StartOfBody.Dispose(pool);
        }
    }

    void BuildSplitBodies(ref FallbackParts split)
    {
        ref var batches = ref ActiveSet.Batches;
        if (batches.Count <= FallbackBatchThreshold || batches[FallbackBatchThreshold].CountConstraints() == 0)
            return;
        ref var typeBatches = ref batches[FallbackBatchThreshold].TypeBatches;
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

        // Count the parts of each body, give each split body a range, then fill the ranges in the order of the constraints.
        VisitParts(ref split, null);
        split.SplitBodies = new QuickList<int>(64, pool);
        split.StartOfBody = new QuickList<int>(64, pool);
        pool.Take<int>(bodies.ActiveSet.Count, out var next);
        int start = 0;
        for (int i = 0; i < bodies.ActiveSet.Count; ++i)
        {
            if (split.Counts[i] == 0)
                continue;
            next[i] = start;
            split.SplitBodies.Add(i, pool);
            split.StartOfBody.Add(start, pool);
            start += (int)split.Counts[i];
        }
        split.StartOfBody.Add(start, pool);
        split.BodyCount = split.SplitBodies.Count;
        VisitParts(ref split, next.Memory);
        pool.Return(ref next);
    }

    // Counts the parts of each body, or, with the next free place of each body's range, fills the ranges.
    void VisitParts(ref FallbackParts split, int* next)
    {
        ref var typeBatches = ref ActiveSet.Batches[FallbackBatchThreshold].TypeBatches;
        for (int i = 0; i < typeBatches.Count; ++i)
        {
            var processor = Processor(typeBatches[i].TypeId);
            for (int constraint = 0; constraint < typeBatches[i].ConstraintCount; ++constraint)
            {
                for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
                {
                    var reference = processor.BodyReference(ref typeBatches[i], constraint, slot);
                    if ((reference & EncodedBody.KinematicFlag) != 0)
                        continue;
                    if (next == null)
                        ++split.Counts[reference];
                    else
                        split.PartsOfBody[next[reference]++] = split.StartOfTypeBatch[i] + constraint * processor.BodiesPerConstraint + slot;
                }
            }
        }
    }
}
