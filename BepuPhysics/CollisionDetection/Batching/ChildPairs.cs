using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the test of two children has found.</summary>
struct ChildResult
{
    public ChildIds Children;
    /// <summary>Whether the test of the two shapes keeps a history.</summary>
    public bool KeepsHistory;
    /// <summary>Centre of A's child less that of A.</summary>
    public Vector3 OffsetA;
    /// <summary>The contacts: as the test found them until they are complete, then in the frame of A.</summary>
    public ConvexContactManifold Manifold;
}

/// <summary>The pairs of children of one batcher that wait to be tested, and the slots that their results are written to.</summary>
/// <remarks>
/// A parent has a slot for each two children, in the order of these. It is complete when nothing is waited for any more; which child was
/// the last is up to chance, and changes nothing.
/// </remarks>
unsafe struct ChildPairs(BufferPool pool)
{
    /// <summary>The children that wait, in the tasks that test them; their ids are those of <see cref="waiting"/>.</summary>
    public PairBatches Batches;
    /// <summary>What the task that expands has found.</summary>
    public QuickList<FoundChild> Found = new(InitialCapacity, pool);
    /// <summary>Ids of the children that the last batch has tested.</summary>
    public QuickList<int> Tested = new(PairBatch.Capacity, pool);
    WaitingList<WaitingChild> waiting = new(InitialCapacity, pool);
    WaitingList<OpenParent> parents = new(InitialCapacity, pool);

    const int InitialCapacity = 64;

    /// <summary>Where the result of a child goes.</summary>
    public readonly record struct WaitingChild(int Parent, int Slot);

    struct OpenParent
    {
        public Buffer<ChildResult> Slots;
        public Vector3 OffsetB;
        public int PairId;
        public int SlotCount;
        public int WaitCount;
    }

    // By parent, then by children.
    struct InOrder : IComparerRef<FoundChild>
    {
        public readonly int Compare(ref FoundChild a, ref FoundChild b) =>
            a.Parent != b.Parent ? a.Parent.CompareTo(b.Parent) : a.Children.Order.CompareTo(b.Children.Order);
    }

    /// <summary>Brings what was found in the order of parents and children; most tasks find it so.</summary>
    public readonly void SortFound()
    {
        var order = new InOrder();
        for (int i = 1; i < Found.Count; ++i)
        {
            if (order.Compare(ref Found[i - 1], ref Found[i]) < 0)
                continue;
            QuickSort.Sort(Found.Span, Found.Count, ref order);
            return;
        }
    }

    /// <summary>Opens a parent with room for a number of children. It stays open until <see cref="Release"/> has said that it is complete.</summary>
    public int Open(in ParentPair pair, int capacity, BufferPool pool)
    {
        var parent = new OpenParent { OffsetB = pair.OffsetB, PairId = pair.PairId, WaitCount = 1 };
        pool.TakeAtLeast(Math.Max(1, capacity), out parent.Slots);
        return parents.Add(parent, pool);
    }

    /// <summary>Gives a child the next slot of its parent.</summary>
    public readonly WaitingChild TakeSlot(int parent, in ChildResult child)
    {
        ref var target = ref parents[parent];
        target.Slots[target.SlotCount] = child;
        ++target.WaitCount;
        return new(parent, target.SlotCount++);
    }

    /// <summary>Lets a child wait for its test.</summary>
    /// <returns>The id that it is to be tested with.</returns>
    public int Wait(WaitingChild child, BufferPool pool) => waiting.Add(child, pool);

    /// <summary>Takes a child that was tested.</summary>
    public WaitingChild Take(int id, BufferPool pool) => waiting.Take(id, pool);

    /// <summary>The slot of a child that waits.</summary>
    public readonly ref ChildResult Slot(int id) => ref Slot(waiting[id]);

    /// <summary>The slot of a child.</summary>
    public readonly ref ChildResult Slot(WaitingChild child) => ref parents[child.Parent].Slots[child.Slot];

    /// <summary>The results of a parent, in the order of children.</summary>
    public readonly Span<ChildResult> Results(int parent) => new(parents[parent].Slots.Memory, parents[parent].SlotCount);

    /// <summary>Id that a parent was added with.</summary>
    public readonly int PairId(int parent) => parents[parent].PairId;

    /// <summary>Position of the parent's B less that of its A.</summary>
    public readonly Vector3 OffsetB(int parent) => parents[parent].OffsetB;

    /// <summary>Notes that a parent waits for one thing less.</summary>
    /// <returns>Whether it waits for nothing any more.</returns>
    public readonly bool Release(int parent) => --parents[parent].WaitCount == 0;

    /// <summary>Closes a parent.</summary>
    public void Close(int parent, BufferPool pool)
    {
        pool.Return(ref parents[parent].Slots);
        parents.Take(parent, pool);
    }

    public void Dispose(BufferPool pool)
    {
        // Where a callback has thrown, some are still open.
        for (int i = 0; i < parents.Span; ++i)
        {
            if (parents[i].Slots.Allocated)
                pool.Return(ref parents[i].Slots);
        }
        parents.Dispose(pool);
        waiting.Dispose(pool);
        Tested.Dispose(pool);
        Found.Dispose(pool);
        Batches.Dispose(pool);
    }
}

/// <summary>Receives what the tasks find for children: writes it to its slot, and calls nobody.</summary>
readonly unsafe struct ChildReceiver(ChildPairs* children) : ICollisionCallbacks
{
    public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        children->Slot(pairId).Manifold = Unsafe.As<TManifold, ConvexContactManifold>(ref manifold);
        children->Tested.AddUnsafely(pairId);
    }

    void ICollisionCallbacks.OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

    bool ICollisionCallbacks.AllowCollisionTesting(int pairId, int childA, int childB) => true;
}
