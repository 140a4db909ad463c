using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// What workers note of pairs, and the order of pairs into which that is brought.
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
        /// <summary>Whether the pair as a whole is to have a history.</summary>
        public bool KeepsParentHistory;
        /// <summary>What the constraint holds that the manifold has had so far, in the list of the worker; negative where it has not been read.</summary>
        public int Old = NotRead;
        public ConvexContactManifold Manifold;
        public PairMaterialProperties Material;
        /// <summary>Place of what the contacts take over from others of their body; negative where there is nothing.</summary>
        public int Inherited = StaticPairs.Nothing;
        /// <summary>Where friction acts of a patch on several statics; zero for a patch on one.</summary>
        public Vector3 FrictionCenter;

        public const int NotRead = -1;
    }

    // A pair with a coefficient of restitution.
    struct BouncingPair : INote
    {
        public CollidablePair Pair { get; init; }
        public float Coefficient;
        public float LeastHit;
    }

    // Where a note is, with the key by which all are put in order.
    struct NoteKey
    {
        public ulong Key;
        public int Worker;
        public int Index;

        const uint Nothing = uint.MaxValue;

        /// <summary>Whether a constraint was added for it: it has a place then instead of its key, which nobody needs any more.</summary>
        public readonly bool HasConstraint => (uint)Key != Nothing;
        /// <summary>Its number (<see cref="Solver.AddLater"/>), or its handle where it was added at once.</summary>
        public readonly int Number => (int)Key;
        /// <summary>Place of the pair, or of the manifold of two children, where it is remembered what its contacts are called.</summary>
        public readonly int Place => (int)(Key >> 32);

        public void SetNothing() => Key = Nothing;
        public void SetConstraint(int number, int place) => Key = (ulong)place << 32 | (uint)number;
    }

    // By slots alone: whether these were others' before must not change the order. The notes of one pair are one worker's, which has made
    // them in the order of children, and are gathered in that order.
    struct ByKey : IComparerRef<NoteKey>, ISortKey<NoteKey>
    {
        const ulong Ordering = (ulong)CollidableReference.OrderMask << 32 | CollidableReference.OrderMask;

        public readonly int Compare(ref NoteKey a, ref NoteKey b)
        {
            var pairs = Of(a).CompareTo(Of(b));
            return pairs != 0 ? pairs : a.Index - b.Index;
        }

        public static ulong Of(in NoteKey note) => note.Key & Ordering;
    }

    // Only some steps, and some pairs, need a list; no others pay for it.
    static void Note<T>(ref QuickList<T> notes, in T note, BufferPool pool, int room = LeastRoom) where T : unmanaged
    {
        if (!notes.Span.Allocated)
            notes = new QuickList<T>(room, pool);
        notes.Add(note, pool);
    }

    const int LeastRoom = 64;

    // Room for the notes of a worker in a step that makes everything anew, as the first does: room that is not used is not touched and costs next to
    // nothing, lists that double touch twice as much and copy it. Up to some bound, as there are systems that promise memory when it is asked for.
    static int RoomForNotes(int bodyCount, int workerCount) => Math.Clamp(bodyCount / workerCount, LeastRoom, 1 << 17);

    void Gather<T>(ref QuickList<T> notes, int worker) where T : unmanaged, INote
    {
        if (notes.Count > 0)
            MakeRoom(ref order, order.Count + notes.Count, Pool);
        for (int i = 0; i < notes.Count; ++i)
            Note(ref order, new() { Key = Key(notes[i].Pair), Worker = worker, Index = i }, Pool);
    }

    static void MakeRoom<T>(ref QuickList<T> notes, int count, BufferPool pool) where T : unmanaged
    {
        if (!notes.Span.Allocated)
            notes = new QuickList<T>(Math.Max(LeastRoom, count), pool);
        notes.EnsureCapacity(count, pool);
    }

    void SortByKey(int first = 0)
    {
        var notes = order.AsSpan()[first..];
        if (notes.Length >= RadixSort<NoteKey, ByKey>.LeastCount)
        {
            RadixSort<NoteKey, ByKey>.Sort(notes, Pool);
            return;
        }
        var comparer = new ByKey();
        QuickSort.Sort(notes, ref comparer);
    }

    static CollidablePair PairOf(ulong key) =>
        new(new CollidableReference { Packed = (uint)(key >> 32) }, new CollidableReference { Packed = (uint)key });
}
