using System.Numerics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Pairs of children that are looked at along directions, in bundles of one pair of shape types each.</summary>
/// <remarks>Takes no memory before the first. In rounds: while what the last one has found is read, pairs of the next are added.</remarks>
unsafe struct DirectedTests
{
    PairBatches batches;
    // A bit for each task whose batch has pairs: there are fewer tasks than bits.
    ulong waiting;
    QuickList<DirectedPair> added;
    QuickList<DirectedPair> found;

    const int InitialCapacity = 32;

    /// <summary>Number of pairs that were added since the last round.</summary>
    public readonly int Count => added.Count;

    /// <summary>Number of pairs of the last round.</summary>
    public readonly int FoundCount => found.Count;

    /// <summary>A pair of the last round, in the order in which they were added.</summary>
    public readonly ref DirectedPair this[int index] => ref found[index];

    /// <summary>Adds a pair.</summary>
    /// <param name="children">The two shapes.</param>
    /// <param name="normal">Unit direction in world axes, from B to A.</param>
    /// <param name="greatestDepth">Depth up to which contacts are wanted, m.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists, m.</param>
    /// <param name="owner">What the pair is of.</param>
    /// <param name="pool">Source of memory.</param>
    /// <param name="findsFace">Whether the face of what is not the mover is wanted.</param>
    public void Add(in PlacedChildren children, in Vector3 normal, float greatestDepth, float speculativeMargin, int owner, BufferPool pool,
        bool findsFace = false)
    {
        var registry = DirectedTasks.Registry;
        var task = registry.GetTask(children.TypeA, children.TypeB, out var taskIndex, out var flipped);
        if (!batches.Has(taskIndex))
        {
            batches.Take(task, taskIndex, registry.TaskCount, pool);
            // What a lane without a pair holds must not be a hull that is gone. Those of this step are not.
            batches[taskIndex].Bundles.Clear(0, task.BatchByteCount);
        }
        var input = new PairInput(speculativeMargin, added.Count, flipped, PairInput.NoHistory);
        added.EnsureCapacity(InitialCapacity, pool);
        // The rest is written when the pair is looked at.
        ref var pair = ref added.Allocate(pool);
        pair.Normal = normal;
        pair.GreatestDepth = greatestDepth;
        pair.Owner = owner;
        pair.FindsFaceOfA = findsFace && children.MoverIsB;
        pair.FindsFaceOfB = findsFace && !children.MoverIsB;
        waiting |= 1ul << taskIndex;
        ref var batch = ref batches[taskIndex];
        fixed (byte* a = children.ShapeA.Bytes, b = children.ShapeB.Bytes)
        {
            if (flipped)
                task.WriteDirectly(ref batch, b, a, children.OffsetB, children.OrientationB, children.OrientationA, input);
            else
                task.WriteDirectly(ref batch, a, b, children.OffsetB, children.OrientationA, children.OrientationB, input);
        }
        if (batch.Count == PairBatch.Capacity)
            ((IDirectedTask)task).Execute(ref batch, added.Span.Memory);
    }

    /// <summary>Ends a round: looks at all pairs that were added.</summary>
    public void Execute()
    {
        for (; waiting != 0; waiting &= waiting - 1)
        {
            var taskIndex = BitOperations.TrailingZeroCount(waiting);
            ((IDirectedTask)DirectedTasks.Registry[taskIndex]).Execute(ref batches[taskIndex], added.Span.Memory);
        }
        (added, found) = (found, added);
        added.Count = 0;
    }

    public void Dispose(BufferPool pool)
    {
        batches.Dispose(pool);
        added.DisposeIfTaken(pool);
        found.DisposeIfTaken(pool);
    }
}
