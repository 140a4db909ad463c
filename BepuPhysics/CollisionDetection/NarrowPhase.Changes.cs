using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// What the workers have noted is brought into the order of its pairs and made on one thread.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    QuickList<NoteKey> order;

    /// <summary>Something that a worker has noted about a pair, for the flush.</summary>
    interface INote
    {
        CollidablePair Pair { get; }
    }

    // A manifold whose contacts need a constraint that it does not have, or that has one and no contacts, or that is to have a history.
    struct PendingManifold(CollidablePair pair, ChildIds children, bool keepsHistory) : INote
    {
        public CollidablePair Pair { get; } = pair;
        public ChildIds Children { get; } = children;
        public bool KeepsHistory { get; } = keepsHistory;
        public ConvexContactManifold Manifold;
        public PairMaterialProperties Material;
        /// <summary>Place of what the contacts take over from others of their body; negative where there is nothing.</summary>
        public int Inherited = StaticPairs.Nothing;
    }

    // A pair with a coefficient of restitution.
    struct BouncingPair : INote
    {
        public CollidablePair Pair { get; init; }
        public float Coefficient;
    }

    // Where a note is, with the key by which all are put in order.
    struct NoteKey
    {
        public ulong Key;
        public int Worker;
        public int Index;
    }

    // By slots alone: whether these were others' before must not change the order. The notes of one pair are one worker's, which has made
    // them in the order of children.
    struct ByKey : IComparerRef<NoteKey>
    {
        const ulong Ordering = (ulong)CollidableReference.OrderMask << 32 | CollidableReference.OrderMask;

        public readonly int Compare(ref NoteKey a, ref NoteKey b)
        {
            var pairs = (a.Key & Ordering).CompareTo(b.Key & Ordering);
            return pairs != 0 ? pairs : a.Index - b.Index;
        }
    }

    internal override void Flush()
    {
        try
        {
            ApplyChanges();
        }
        finally
        {
            // There may be no room for another constraint: the step is lost, the memory is not, and the workers' pools are free again.
            Release(ref order, Pool);
            ReleaseWorkers();
        }
    }

    void ApplyChanges()
    {
        if (Simulation.Events.UsesSensors)
            GatherSensed();
        RemoveUnseenPairs();
        RemoveGoneManifolds();
        order.Count = 0;
        for (int i = 0; i < workers.Length; ++i)
            Gather(ref workers[i].Pending, i);
        SortByKey();
        WakeTouched();
        for (int i = 0; i < order.Count; ++i)
        {
            PrefetchPending(i);
            Apply(workers[order[i].Worker].Pending[order[i].Index], workers[order[i].Worker].Statics);
        }
        WatchBouncingPairs();
    }

    // Who is touched is in the solver in this very step.
    void WakeTouched()
    {
        if (Simulation.Bodies.Asleep.Count == 0)
            return;
        var awakener = Simulation.Awakener;
        awakener.BeginRequests();
        awakener.RequestHeldByMovingKinematics();
        for (int i = 0; i < order.Count; ++i)
        {
            ref var pending = ref workers[order[i].Worker].Pending[order[i].Index];
            if (pending.Manifold.Count == 0)
                continue;
            awakener.Request(pending.Pair.A.Slot);
            if (pending.Pair.B.Mobility != CollidableMobility.Static)
                awakener.Request(pending.Pair.B.Slot);
        }
        awakener.WakeRequested();
    }

    // Only some steps, and some pairs, need a list; no others pay for it.
    static void Note<T>(ref QuickList<T> notes, in T note, BufferPool pool) where T : unmanaged
    {
        if (!notes.Span.Allocated)
            notes = new QuickList<T>(64, pool);
        notes.Add(note, pool);
    }

    void Gather<T>(ref QuickList<T> notes, int worker) where T : unmanaged, INote
    {
        for (int i = 0; i < notes.Count; ++i)
            Note(ref order, new() { Key = Key(notes[i].Pair), Worker = worker, Index = i }, Pool);
    }

    void SortByKey()
    {
        if (order.Count < 2)
            return;
        var comparer = new ByKey();
        QuickSort.Sort(order.Span, order.Count, ref comparer);
    }

    /// <summary>Asks the processor to load what pairs need that are soon to be applied: they are in the order of their handles.</summary>
    void PrefetchPending(int index)
    {
        const int distance = 8;
        if (index + 2 * distance < order.Count)
            Pairs.Pairs.PrefetchSlot(PairOf(order[index + 2 * distance].Key));
        if (index + distance >= order.Count)
            return;
        ref var next = ref order[index + distance];
        Pairs.Pairs.PrefetchElement(PairOf(next.Key));
        ref var pending = ref workers[next.Worker].Pending[next.Index];
        Prefetch.Read(Unsafe.AsPointer(ref pending));
        Prefetch.Read(Unsafe.AsPointer(ref pending.Material));
    }

    void Apply(in PendingManifold pending, in StaticPairs statics)
    {
        ContactPatch old = default;
        var solver = Simulation.Solver;
        var ofChildren = pending.Children != ChildIds.None;
        var index = Pairs.FindOrAdd(pending.Pair, ofChildren, Pool);
        ref var cached = ref Pairs.Pairs.Values[index];
        if (cached.IsOfChildren != ofChildren)
        {
            // One of the two has a shape of another kind now.
            RemoveConstraints(index);
            Pairs.Empty(ref cached, ofChildren, Pool);
        }
        ref var manifold = ref cached.Single;
        if (ofChildren)
        {
            ref var record = ref Pairs.FindOrAdd(ref cached, pending.Children, Pool);
            manifold = ref record.Manifold;
            if (pending.Children.IsPatch)
                record.Patch.Write(pending.Manifold);
        }
        if (pending.KeepsHistory && manifold.History < 0)
            manifold.History = Pairs.Histories.Take(Pool);
        if (manifold.HasConstraint)
        {
            new ContactConstraint(solver, manifold.Constraint, ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId))
                .ReadPatch(manifold.Features, out old);
            RemoveConstraint(ref cached, ref manifold);
        }
        var contactCount = pending.Manifold.Count;
        if (contactCount == 0)
            return;
        if (pending.Inherited != StaticPairs.Nothing)
            old = statics.Inheritances[pending.Inherited].Load;
        AddConstraint(pending.Pair, ConstraintType(pending.Pair, contactCount), ref cached, ref manifold);
        new ContactConstraint(solver, manifold.Constraint, contactCount).WriteNew(ref old, pending.Manifold, pending.Material, ref manifold.Features);
    }

    void WatchBouncingPairs()
    {
        Restitution.BeginStep();
        order.Count = 0;
        for (int i = 0; i < workers.Length; ++i)
            Gather(ref workers[i].Bouncing, i);
        SortByKey();
        for (int i = 0; i < order.Count; ++i)
        {
            ref var bouncing = ref workers[order[i].Worker].Bouncing[order[i].Index];
            var index = Pairs.Pairs.IndexOf(bouncing.Pair);
            // Statics beside it have taken its contacts.
            if (index < 0)
                continue;
            foreach (ref var manifold in Pairs.ManifoldsOf(index))
            {
                if (manifold.HasConstraint)
                    Restitution.Watch(manifold.Constraint, ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId), bouncing.Coefficient);
            }
        }
    }

    static ulong Key(in CollidablePair pair) => (ulong)pair.A.Packed << 32 | pair.B.Packed;

    static CollidablePair PairOf(ulong key) =>
        new(new CollidableReference { Packed = (uint)(key >> 32) }, new CollidableReference { Packed = (uint)key });

    static int ConstraintType(in CollidablePair pair, int contactCount) =>
        ConstraintTypeIds.ConvexContact(contactCount, pair.B.Mobility == CollidableMobility.Static ? 1 : 2);
}
