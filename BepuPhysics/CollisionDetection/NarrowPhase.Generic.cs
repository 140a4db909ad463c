using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The narrow phase, compiled for the callbacks of a game.</summary>
/// <remarks>What <see cref="Simulation.NarrowPhase"/> is: cast it to this to reach the callbacks.</remarks>
public sealed unsafe partial class NarrowPhase<TCallbacks> : NarrowPhase where TCallbacks : struct, INarrowPhaseCallbacks
{
    /// <summary>The callbacks themselves: <see cref="Simulation.Create"/> copied the struct that it was given. Not to be changed during a step.</summary>
    public TCallbacks Callbacks;
    Worker[] workers = [];

    internal NarrowPhase(Simulation simulation, in TCallbacks callbacks, CollisionTaskRegistry collisionTaskRegistry, int initialPairCapacity)
        : base(simulation, collisionTaskRegistry, initialPairCapacity) => Callbacks = callbacks;

    // What a worker has found; its memory is its own.
    struct Worker
    {
        public PairQueue Queue;
        public CollisionBatcher<Completion> Batcher;
        public WaitingList<TestedPair> TestedPairs;
        public ContactQueue Contacts;
        public QuickList<PendingManifold> Pending;
        public QuickList<ContactPatch> Old;
        public QuickList<BouncingPair> Bouncing;
        public QuickList<GoneManifold> Gone;
        public QuickList<Bend> Bends;
        public QuickList<FastNote> Fast;
        public QuickList<CollidablePair> Sensed;
        /// <summary>Pairs that wait for others of their body.</summary>
        public StaticPairs Statics;
        /// <summary>Null where the worker has no memory: before a step, and after it.</summary>
        public BufferPool Pool;
        /// <summary>Notes for which there is room from the first one on.</summary>
        public int Room;
        /// <summary>Pairs until the worker tells how many it has found.</summary>
        public int PairsLeft;
        public int SkippedPairCount;
        public int RefusedPairCount;
        /// <summary>Manifold of the pair that is expanded which comes next, in the order of children.</summary>
        public int NextManifold;
        public RimMemory Rims;
    }

    // Receives the manifolds of one worker's batcher.
    readonly struct Completion(NarrowPhase<TCallbacks> narrowPhase, int workerIndex) : ICollisionCallbacks
    {
        NarrowPhase<TCallbacks> NarrowPhase => narrowPhase;
        int WorkerIndex => workerIndex;

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            narrowPhase.OnPairCompleted(workerIndex, pairId, ref manifold);

        void ICollisionCallbacks.OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) =>
            narrowPhase.ConfigureChildren(workerIndex, pairId, childA, childB, ref manifold);

        bool ICollisionCallbacks.AllowCollisionTesting(int pairId, int childA, int childB) =>
            narrowPhase.AllowsChildren(workerIndex, pairId, childA, childB);

        static bool ICollisionCallbacks.ChangesChildren => TCallbacks.DecidesOnChildren;

        static void ICollisionCallbacks.PrefetchChildren<T>(ref T callbacks, ReadOnlySpan<int> pairIds, bool areTested)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            self.NarrowPhase.PrefetchChildren(self.WorkerIndex, pairIds, areTested);
        }

        static void ICollisionCallbacks.BeginChildren<T>(ref T callbacks, int pairId)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            self.NarrowPhase.BeginChildren(self.WorkerIndex, pairId);
        }

        static bool ICollisionCallbacks.Recall<T>(ref T callbacks, int pairId, ChildIds ids, in ChildShapes children, float speculativeMargin,
            out int history, ref ConvexContactManifold manifold)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            return self.NarrowPhase.Recall(self.WorkerIndex, ids, children, speculativeMargin, out history, ref manifold);
        }

        static void ICollisionCallbacks.RecallPatches<T>(ref T callbacks, int pairId, out KnownPatches known)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            self.NarrowPhase.RecallPatches(self.WorkerIndex, pairId, out known);
        }

        static bool ICollisionCallbacks.KeepsChildren<T>(ref T callbacks, int pairId)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            return Waits(self.NarrowPhase.workers[self.WorkerIndex].TestedPairs[pairId]);
        }

        static void ICollisionCallbacks.RecallMotion<T>(ref T callbacks, int pairId, out LastMotion motion)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            self.NarrowPhase.RecallMotion(self.WorkerIndex, pairId, out motion);
        }

        static void ICollisionCallbacks.OnChildrenCompleted<T>(ref T callbacks, int pairId, Vector3 offsetB, Span<ChildResult> results)
        {
            ref var self = ref Unsafe.As<T, Completion>(ref callbacks);
            self.NarrowPhase.CompleteChildren(self.WorkerIndex, pairId, offsetB, results);
        }
    }

    internal override void Initialize() => Callbacks.Initialize(Simulation);

    internal override void DisposeCallbacks() => Callbacks.Dispose();

    // The margin is negative where the game was not asked yet.
    void TestPair(int workerIndex, CollidablePair pair, int cacheIndex, float askedMargin)
    {
        var a = pair.A;
        var b = pair.B;
        var isSensor = false;
        if (Simulation.Events.UsesSensors && !IsTested(pair, out isSensor))
            return;
        var bodies = Simulation.Bodies;
        ref var locationA = ref bodies.Locations[a.Slot];
        ref var setA = ref bodies.SetOf(locationA);
        ref var collidableA = ref setA.Collidables[locationA.Index];
        scoped ref var poseA = ref setA.MotionStates[locationA.Index].Pose;
        var margin = collidableA.SpeculativeMargin;
        var mode = collidableA.Continuity.Mode;
        TypedIndex shapeB;
        scoped ref var poseB = ref Unsafe.NullRef<RigidPose>();
        if (b.Mobility == CollidableMobility.Static)
        {
            ref var other = ref Simulation.Statics.StaticsBuffer[Simulation.Statics.Indices[b.Slot]];
            shapeB = other.Shape;
            poseB = ref other.Pose;
            mode |= other.Continuity.Mode;
        }
        else
        {
            ref var locationB = ref bodies.Locations[b.Slot];
            ref var setB = ref bodies.SetOf(locationB);
            shapeB = setB.Collidables[locationB.Index].Shape;
            mode |= setB.Collidables[locationB.Index].Continuity.Mode;
            margin += setB.Collidables[locationB.Index].SpeculativeMargin;
            poseB = ref setB.MotionStates[locationB.Index].Pose;
        }
        if (askedMargin >= 0)
            margin = askedMargin;
        else if (!IsAllowed(workerIndex, pair, ref margin))
            return;
        if (isSensor)
            margin = 0;
        var offsetB = poseB.Position - poseA.Position;
        var task = CollisionTaskRegistry.GetTask(collidableA.Shape.Type, shapeB.Type, out var taskIndex, out var flipped);
        ref var worker = ref workers[workerIndex];
        // Where it will wait: written elsewhere by parts, and then copied as a whole, it would wait for the parts.
        var pairId = worker.TestedPairs.Allocate(worker.Pool);
        ref var tested = ref worker.TestedPairs[pairId];
        tested.Pair = pair;
        tested.CacheIndex = isSensor ? -1 : cacheIndex;
        tested.FirstManifold = PairRecords<ChildManifold>.None;
        tested.Constraint = default;
        tested.ConstraintTypeId = CachedManifold.NoConstraint;
        tested.KeepsHistory = task.KeepsHistories;
        tested.HasHistory = false;
        tested.IsSensor = isSensor;
        tested.TurnsFast = tested.MayCarry = tested.IsCarried = tested.IsExact = tested.IsImpact = false;
        tested.LeastHit = tested.ImpactTime = 0;
        tested.IsAtSeam = b.Mobility != CollidableMobility.Dynamic && setA.Activity[locationA.Index].IsAtSeam;
        tested.SpeculativeMargin = margin;
        if (tested.IsAtSeam)
            AgreedPairs.Prefetch(a);
        Unsafe.SkipInit(out ImpactPoses placed);
        if (mode >= ContinuousDetectionMode.Continuous)
        {
            if (!TryPlaceAtImpact(workerIndex, ref tested, collidableA.Shape, shapeB, poseA, poseB, ref placed, out var isApart) && isApart)
            {
                CompleteApart(workerIndex, tested, offsetB);
                worker.TestedPairs.Free(pairId, worker.Pool);
                return;
            }
            margin = tested.SpeculativeMargin;
        }
        else if (collidableA.Shape.Type == Sphere.Id && shapeB.Type == Sphere.Id && margin > 0)
            PlaceWhereBallsMeet(ref tested, collidableA.Shape, shapeB, poseA, poseB, worker.Batcher.Dt, ref placed);
        if (tested.IsImpact)
        {
            poseA = ref placed.A;
            poseB = ref placed.B;
            offsetB = poseB.Position;
        }
        tested.MayHaveRims = MayHaveRims(ref worker.Rims, tested, collidableA.Shape, shapeB);
        tested.MayPivot = MayPivot(tested, collidableA.Shape);
        tested.MayRoll = task.Expands && MayRoll(tested, collidableA.Shape);
        if (task.Expands)
        {
            tested.FirstManifold = FindFirstManifold(tested);
            tested.ConstraintTypeId = ConstraintTypeOfChildren(tested);
            if (!TCallbacks.DecidesOnChildren && !tested.IsImpact && TryCarry(workerIndex, tested, collidableA.Shape, shapeB, poseA, poseB))
                worker.TestedPairs.Free(pairId, worker.Pool);
            else
                TestParent(workerIndex, task, taskIndex, flipped, pairId, collidableA.Shape, shapeB, poseA, poseB, margin);
            return;
        }
        var history = PairInput.NoHistory;
        if (tested.CacheIndex >= 0)
        {
            ref var cached = ref Pairs.Pairs.Values[tested.CacheIndex];
            tested.Constraint = cached.Single.Constraint;
            tested.ConstraintTypeId = cached.Single.ConstraintTypeId;
            // That of a pair whose shapes had children is another kind of history.
            tested.HasHistory = cached.Single.History >= 0 && !cached.IsOfChildren;
            if (task.KeepsHistories && tested.HasHistory)
                history = cached.Single.History;
        }
        if (history >= 0)
        {
            Unsafe.SkipInit(out ConvexContactManifold manifold);
            if (Reuse(history, collidableA.Shape, shapeB, offsetB, poseA.Orientation, poseB.Orientation, margin, ref manifold))
            {
                Complete(workerIndex, tested, ref manifold);
                worker.TestedPairs.Free(pairId, worker.Pool);
                return;
            }
            Pairs.Histories.PrefetchRest(history);
            history = Pairs.Histories.Memory[history].GetReference(history);
        }
        worker.Batcher.Add(task, taskIndex, flipped, collidableA.Shape.Index, shapeB.Index, offsetB, poseA.Orientation, poseB.Orientation,
            margin, pairId, history);
    }

    /// <summary>Finds the contacts of a pair that has hardly moved since its last test, and otherwise prepares its history for the next.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Reuse(int historyIndex, TypedIndex shapeA, TypedIndex shapeB, in Vector3 offsetB, in Quaternion orientationA,
        in Quaternion orientationB, float margin, ref ConvexContactManifold manifold)
    {
        ref var history = ref Pairs.Histories.Memory[historyIndex];
        history.Identify(Simulation.Shapes.Identify(shapeA), Simulation.Shapes.Identify(shapeB));
        return history.TryReuse(offsetB, orientationA, orientationB, margin, ref manifold);
    }

    void OnPairCompleted<TManifold>(int workerIndex, int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        ref var worker = ref workers[workerIndex];
        worker.TestedPairs.Take(pairId, worker.Pool, out var tested);
        Complete(workerIndex, tested, ref manifold);
    }

    void Complete<TManifold>(int workerIndex, in TestedPair tested, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        if (tested.IsSensor)
        {
            NoteSensed(workerIndex, tested.Pair, ref manifold);
            return;
        }
        if (tested.IsImpact)
            MoveBack(tested, ref manifold);
        // What has no contacts has nothing to wait with.
        if (manifold.Count > 0 && Waits(tested))
        {
            CompleteLater(workerIndex, tested, ref manifold);
            return;
        }
        if (!Callbacks.ConfigureContactManifold(workerIndex, tested.Pair, ref manifold, out var material) || manifold.Count == 0)
        {
            if (tested.KeepsHistory)
                CompleteWithoutContacts(workerIndex, tested);
            return;
        }
        if (typeof(TManifold) != typeof(ConvexContactManifold))
            throw new NotSupportedException($"Manifolds of type {typeof(TManifold).Name} have no constraint.");
        ref var worker = ref workers[workerIndex];
        ref var convex = ref Unsafe.As<TManifold, ConvexContactManifold>(ref manifold);
        NoteSurface(workerIndex, tested, ref manifold);
        CallbackChecks.Contacts(tested.Pair, convex, material);
        LetGoOfMoved(tested.Pair, convex.Normal, ref material);
        Complete(ref worker, tested, convex, PatchLever.Write(material, FaceLever.OfOneFace), StaticPairs.Nothing, default);
    }

    // What is inherited, and a centre of friction, is of pairs that have waited.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void Complete(ref Worker worker, in TestedPair tested, in ConvexContactManifold convex, in PairMaterialProperties material, int inherited,
        in Vector3 frictionCenter)
    {
        Unsafe.SkipInit(out ConvexContactManifold moved);
        ref readonly var contacts = ref tested.MayHaveRims ? ref AtRims(tested.Pair, convex, ref moved) : ref convex;
        if (tested.MayPivot && IsPivoting(convex))
            contacts = ref AtPivots(tested.Pair, convex, contacts, ref moved);
        var typeId = ConstraintType(tested.Pair, convex.Count);
        if (tested.CacheIndex >= 0)
        {
            Pairs.MarkSeen(tested.CacheIndex);
            if (inherited == StaticPairs.Nothing && tested.KeepsConstraint(typeId))
            {
                worker.Contacts.Add(Simulation.Solver, &Pairs.Pairs.Values.Memory[tested.CacheIndex].Single.Features, tested.Constraint, contacts,
                    material, frictionCenter);
                return;
            }
        }
        var pending = new PendingManifold(tested.Pair, ChildIds.None, tested.KeepsHistory)
        {
            Manifold = contacts,
            Material = material,
            Inherited = inherited,
            FrictionCenter = frictionCenter,
        };
        if (readsEarly && tested.ConstraintTypeId >= 0)
            Read(ref worker, ref pending, Pairs.Pairs.Values[tested.CacheIndex].Single);
        Note(ref worker.Pending, pending, worker.Pool, worker.Room);
    }

    // As what does not wait, but for what becomes of the contacts.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void CompleteLater<TManifold>(int workerIndex, in TestedPair tested, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        // Not in the list, whose memory is not there yet: to compare with it would wait for that.
        var shown = manifold;
        if (!Callbacks.ConfigureContactManifold(workerIndex, tested.Pair, ref manifold, out var material) || manifold.Count == 0)
        {
            if (tested.KeepsHistory)
                CompleteWithoutContacts(workerIndex, tested);
            return;
        }
        ref var worker = ref workers[workerIndex];
        ref var convex = ref Unsafe.As<TManifold, ConvexContactManifold>(ref manifold);
        NoteSurface(workerIndex, tested, ref manifold);
        CallbackChecks.Contacts(tested.Pair, convex, material);
        LetGoOfMoved(tested.Pair, convex.Normal, ref material);
        var isOfGame = !BytesOf.AreEqual(shown, manifold);
        var index = worker.Statics.Add(tested, convex, material, isOfGame, worker.Pool);
        if (isOfGame)
            AgreedPairs.NoteChange(tested.Pair.A);
        else
            NoteFoundAgain(workerIndex, tested.Pair, convex, index);
    }

    void NoteFoundAgain(int workerIndex, in CollidablePair pair, in ConvexContactManifold manifold, int index)
    {
        ref var location = ref Simulation.Bodies.Locations[pair.A.Slot];
        AgreedPairs.Note(pair, manifold, Simulation.Bodies.SetOf(location).MotionStates[location.Index].Pose.Orientation, workerIndex, index);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void NoteSurface<TManifold>(int workerIndex, in TestedPair tested, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold> =>
        NoteSurface(workerIndex, tested.Pair, tested.IsExact, tested.LeastHit, ref manifold);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void NoteSurface<TManifold>(int workerIndex, in CollidablePair pair, bool isExact, float leastHit, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        var surface = TCallbacks.SurfaceOf(ref Callbacks, workerIndex, pair, ref manifold);
        if (surface.Restitution == 0 && !surface.ExactImpacts && !isExact)
            return;
        CallbackChecks.Restitution(pair, surface.Restitution);
        ref var worker = ref workers[workerIndex];
        var coefficient = surface.ExactImpacts ? MathHelper.Max(surface.Restitution, Restitution.LeastCoefficient) : surface.Restitution;
        Note(ref worker.Bouncing, new() { Pair = pair, Coefficient = coefficient, LeastHit = coefficient > 0 ? 0 : leastHit }, worker.Pool);
    }

    // A pair that is apart keeps its history, so that it costs little to see that it still is.
    void CompleteWithoutContacts(int workerIndex, in TestedPair tested)
    {
        ref var worker = ref workers[workerIndex];
        CompleteWithoutContacts(ref worker, tested);
        worker.Statics.NoteGone(tested, worker.Pool);
    }

    void CompleteWithoutContacts(ref Worker worker, in TestedPair tested)
    {
        if (tested.CacheIndex >= 0)
        {
            Pairs.MarkSeen(tested.CacheIndex);
            if (tested.ConstraintTypeId == CachedManifold.NoConstraint)
                return;
        }
        Note(ref worker.Pending, new(tested.Pair, ChildIds.None, keepsHistory: true), worker.Pool, worker.Room);
    }

    void Release(ref Worker worker)
    {
        if (worker.Pool is null)
            return;
        if (worker.Pool != Pool)
            worker.Pool.RemoveUser(this);
        worker.Batcher.Dispose();
        worker.TestedPairs.Dispose(worker.Pool);
        worker.Pending.DisposeIfTaken(worker.Pool);
        worker.Old.DisposeIfTaken(worker.Pool);
        worker.Bouncing.DisposeIfTaken(worker.Pool);
        worker.Bends.DisposeIfTaken(worker.Pool);
        worker.Gone.DisposeIfTaken(worker.Pool);
        worker.Fast.DisposeIfTaken(worker.Pool);
        worker.Sensed.DisposeIfTaken(worker.Pool);
        worker.Statics.Release(worker.Pool);
        worker.Pool = null!;
    }

    void ReleaseWorkers()
    {
        for (int i = 0; i < workers.Length; ++i)
            Release(ref workers[i]);
    }
}
