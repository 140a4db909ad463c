using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Children that are tested at other places than those where they are, by the tasks that test all pairs; at most one for each set.</summary>
struct MovedTests
{
    PairBatches batches;

    /// <summary>Number of tests that wait.</summary>
    public int Count { get; private set; }

    /// <summary>Adds a test.</summary>
    /// <param name="children">The two shapes.</param>
    /// <param name="way">By how much A is beside its place, m.</param>
    /// <param name="owner">Number of the set that is told of what is found.</param>
    /// <param name="sets">The sets.</param>
    /// <param name="registry">The tasks.</param>
    /// <param name="pool">Source of memory.</param>
    public unsafe void Add(in PlacedChildren children, in Vector3 way, int owner, SeamSet* sets, CollisionTaskRegistry registry, BufferPool pool)
    {
        var task = registry.GetTask(children.TypeA, children.TypeB, out var taskIndex, out var flipped);
        if (!batches.Has(taskIndex))
            batches.Take(task, taskIndex, registry.TaskCount, pool);
        var input = new PairInput(children.SpeculativeMargin, owner, flipped, PairInput.NoHistory);
        var offsetB = children.OffsetB - way;
        ref var batch = ref batches[taskIndex];
        fixed (byte* a = children.ShapeA.Bytes, b = children.ShapeB.Bytes)
        {
            if (flipped)
                task.WriteDirectly(ref batch, b, a, offsetB, children.OrientationB, children.OrientationA, input);
            else
                task.WriteDirectly(ref batch, a, b, offsetB, children.OrientationA, children.OrientationB, input);
        }
        ++Count;
        // Its sets wait for the end of the round all the same.
        if (batch.Count == PairBatch.Capacity)
        {
            var receiver = new Receiver(sets);
            task.Execute(ref batch, null, ref receiver);
        }
    }

    /// <summary>Makes the tests, and tells the sets.</summary>
    public unsafe void Execute(SeamSet* sets, CollisionTaskRegistry registry)
    {
        if (Count == 0)
            return;
        var receiver = new Receiver(sets);
        for (int i = batches.First; i < batches.End; ++i)
        {
            if (batches[i].Count > 0)
                registry[i].Execute(ref batches[i], null, ref receiver);
        }
        Count = 0;
    }

    public void Dispose(BufferPool pool) => batches.Dispose(pool);

    readonly unsafe struct Receiver(SeamSet* sets) : ICollisionCallbacks
    {
        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            sets[pairId].Foresight.Manifold = Unsafe.As<TManifold, ConvexContactManifold>(ref manifold);

        void ICollisionCallbacks.OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        bool ICollisionCallbacks.AllowCollisionTesting(int pairId, int childA, int childB) => true;
    }
}
