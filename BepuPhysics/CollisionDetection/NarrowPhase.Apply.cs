using System;
using System.Runtime.ExceptionServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.CollisionDetection;

// How a note is made true: its pair, which constraint it has, and what that holds.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    /// <summary>What a note is about, found before any is applied.</summary>
    struct NoteTarget
    {
        /// <summary>Index of the pair; negative for one that was not known.</summary>
        public int Pair;
        /// <summary>Number of contacts.</summary>
        public int ContactCount;
        /// <summary>How the constraint refers to its bodies.</summary>
        public int ReferenceA, ReferenceB;
    }

    void ApplyNow()
    {
        for (int i = 0; i < order.Count; ++i)
        {
            PrefetchPending(i);
            ref var pending = ref workers[order[i].Worker].Pending[order[i].Index];
            Apply(ref order[i], new() { Pair = Pairs.Pairs.IndexOf(pending.Pair), ContactCount = pending.Manifold.Count });
            if (order[i].HasConstraint)
                WriteAdded(order[i], new ConstraintHandle(order[i].Number));
        }
    }

    // The structure alone: which constraints there are. What they hold is written when all are there.
    void Apply(ref NoteKey note, in NoteTarget target)
    {
        ref var worker = ref workers[note.Worker];
        ref var pending = ref worker.Pending[note.Index];
        var ofChildren = pending.Children != ChildIds.None;
        // Several notes may be about one new pair.
        var index = target.Pair >= 0 ? target.Pair : Pairs.FindOrAdd(pending.Pair, ofChildren, Pool);
        ref var cached = ref Pairs.Pairs.Values[index];
        if (cached.IsOfChildren != ofChildren)
        {
            // One of the two has a shape of another kind now.
            RemoveConstraints(index);
            Pairs.Empty(ref cached, ofChildren, Pool);
        }
        ref var manifold = ref cached.Single;
        var place = index;
        if (ofChildren)
        {
            place = Pairs.FindOrAddIndex(ref cached, pending.Children, Pool);
            ref var record = ref Pairs.Manifolds.Memory[place];
            manifold = ref record.Manifold;
            if (pending.Children.IsPatch)
                record.Patch.Write(pending.Manifold);
        }
        if (pending.KeepsParentHistory && cached.Single.History < 0)
            cached.Single.History = Pairs.Parents.Take(Pool);
        if (pending.KeepsHistory && manifold.History < 0)
            manifold.History = Pairs.Histories.Take(Pool);
        var contactCount = target.ContactCount;
        var old = PendingManifold.NotRead;
        if (manifold.HasConstraint)
        {
            if (pending.Old == PendingManifold.NotRead && contactCount > 0 && pending.Inherited == StaticPairs.Nothing)
            {
                Check.That(!leavesColumns);
                Read(ref worker, ref pending, manifold);
            }
            old = pending.Old;
            RemoveConstraint(pending.Pair, ref cached, ref manifold);
        }
        note.SetNothing();
        if (contactCount == 0)
            return;
        var ends = new ContactEnds(pending.Pair.A.Slot, target.ReferenceA, pending.Pair.B.Slot, target.ReferenceB);
        var number = AddConstraint(pending.Pair, ends, ConstraintType(pending.Pair, contactCount), ref cached, ref manifold);
        pending.Old = old;
        note.SetConstraint(number, place);
    }

    void Locate(in NoteKey note, out NoteTarget target)
    {
        ref var pending = ref workers[note.Worker].Pending[note.Index];
        target = new()
        {
            Pair = Pairs.Pairs.IndexOf(pending.Pair),
            ContactCount = pending.Manifold.Count,
            ReferenceA = ReferenceTo(pending.Pair.A),
            ReferenceB = pending.Pair.B.Mobility == CollidableMobility.Static ? -1 : ReferenceTo(pending.Pair.B),
        };
    }

    int ReferenceTo(CollidableReference body)
    {
        ref var location = ref Simulation.Bodies.Locations[body.Slot];
        var isKinematic = Bodies.IsKinematic(Simulation.Bodies.SetOf(location).LocalInertias[location.Index]);
        return isKinematic ? location.Index | EncodedBody.KinematicFlag : location.Index;
    }

    // What the flush has left. Notes are looked at side by side, and applied by one thread; then constraints come and go, and those that are new are
    // written: each of them has a lane of its own, so it does not matter who writes which when.
    struct ChangeWork : IStagedWork
    {
        const int PerBlock = 32;
        const int LocateStage = 0;
        const int ApplyStage = 1;
        const int ChangeStage = 2;

        public NarrowPhase<TCallbacks> NarrowPhase;
        public int ThreadCount;
        /// <summary>Room for what each note is about; none where none is to be applied.</summary>
        public Buffer<NoteTarget> Targets;
        /// <summary>Why not all notes were applied. What was, is done to the end.</summary>
        public ExceptionDispatchInfo? Failure;
        /// <summary>Whether the tree is tidied beside the notes, which are one after another.</summary>
        public bool Tidies;
        /// <summary>None without other workers.</summary>
        public WorkerBufferPools? WorkerPools;
        int appliedCount;

        public readonly int StageCount => 4;

        public readonly int GetBlockCount(int stage) => stage switch
        {
            LocateStage => BlocksOf(Targets.Allocated ? NarrowPhase.order.Count : 0),
            ApplyStage => Tidies ? 2 : 1,
            ChangeStage => NarrowPhase.Simulation.Solver.DeferredBlockCount,
            _ => NarrowPhase.Simulation.Solver.LastBlockCount + BlocksOf(appliedCount),
        };

        static int BlocksOf(int count) => (count + PerBlock - 1) / PerBlock;

        public void Execute(int stage, int block, int workerIndex)
        {
            NarrowPhase.World.MarkWorker();
            switch (stage)
            {
                case LocateStage:
                    Locate(block);
                    break;
                case ApplyStage when block == 0:
                    Apply();
                    break;
                case ApplyStage:
                    NarrowPhase.Simulation.BroadPhase.TidyActiveTree(WorkerPools?[workerIndex] ?? NarrowPhase.Pool);
                    break;
                case ChangeStage:
                    NarrowPhase.Simulation.Solver.DoDeferred(block);
                    break;
                default:
                    var lastCount = NarrowPhase.Simulation.Solver.LastBlockCount;
                    if (block < lastCount)
                        NarrowPhase.Simulation.Solver.DoLast(block);
                    else
                        Write(block - lastCount);
                    break;
            }
        }

        readonly void Locate(int block)
        {
            var end = Math.Min((block + 1) * PerBlock, NarrowPhase.order.Count);
            for (int i = block * PerBlock; i < end; ++i)
                NarrowPhase.Locate(NarrowPhase.order[i], out Targets[i]);
        }

        void Apply()
        {
#pragma warning disable CA1031 // Whatever it is, it is thrown when what was applied is whole.
            try
            {
                for (; Targets.Allocated && appliedCount < NarrowPhase.order.Count; ++appliedCount)
                {
                    NarrowPhase.PrefetchTarget(Targets, appliedCount);
                    NarrowPhase.Apply(ref NarrowPhase.order[appliedCount], Targets[appliedCount]);
                }
            }
            catch (Exception exception)
            {
                Failure = ExceptionDispatchInfo.Capture(exception);
            }
#pragma warning restore CA1031
            NarrowPhase.Simulation.Solver.PrepareDeferred(ThreadCount);
        }

        readonly void Write(int block)
        {
            var end = Math.Min((block + 1) * PerBlock, appliedCount);
            for (int i = block * PerBlock; i < end; ++i)
            {
                ref var note = ref NarrowPhase.order[i];
                if (note.HasConstraint)
                    NarrowPhase.WriteAdded(note, NarrowPhase.Simulation.Solver.Place(note.Number));
            }
        }
    }

    void PrefetchTarget(in Buffer<NoteTarget> targets, int index)
    {
        const int distance = 6;
        if (index + 2 * distance < order.Count)
        {
            ref var later = ref order[index + 2 * distance];
            var pair = targets[index + 2 * distance].Pair;
            if (pair >= 0)
                Prefetch.Read(Pairs.Pairs.Values.Memory + pair);
            else
                Pairs.Pairs.PrefetchSlot(PairOf(later.Key));
            Prefetch.Read((PendingManifold*)workers[later.Worker].Pending.Span.Memory + later.Index);
        }
        if (index + distance >= order.Count)
            return;
        var next = targets[index + distance].Pair;
        if (next >= 0 && Pairs.Pairs.Values[next].Single.HasConstraint)
            Simulation.Solver.Prefetch(Pairs.Pairs.Values[next].Single.Constraint);
    }

    void WriteAdded(in NoteKey note, ConstraintHandle constraint)
    {
        ref var worker = ref workers[note.Worker];
        ref var pending = ref worker.Pending[note.Index];
        ContactPatch none = default;
        ref var old = ref none;
        if (pending.Inherited != StaticPairs.Nothing)
            old = ref worker.Statics.Inheritances[pending.Inherited].Load;
        else if (pending.Old != PendingManifold.NotRead)
            old = ref worker.Old[pending.Old];
        ref var manifold = ref pending.Children == ChildIds.None ? ref Pairs.Pairs.Values[note.Place].Single : ref Pairs.Manifolds.Memory[note.Place].Manifold;
        new ContactConstraint(Simulation.Solver, constraint, pending.Manifold.Count)
            .WriteNew(ref old, pending.Manifold, pending.Material, pending.FrictionCenter, ref manifold.Features);
    }
}
