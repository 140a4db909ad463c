using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;

namespace BepuPhysics.CollisionDetection;

// Pairs of which one shape at least is made of children. What these touch at is joined to patches, which have a constraint each; children have
// histories. The pair's list of both and what a step finds are in one order, so that the two are gone through side by side.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // A manifold whose children do not touch any more, and have no history.
    struct GoneManifold : INote
    {
        public CollidablePair Pair { get; init; }
        public ChildIds Children;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void TestParent(int workerIndex, CollisionTask task, int taskIndex, bool flipped, int pairId, TypedIndex shapeA, TypedIndex shapeB,
        in RigidPose poseA, in RigidPose poseB, float margin)
    {
        ref var worker = ref workers[workerIndex];
        ref var tested = ref worker.TestedPairs[pairId];
        var bodies = Simulation.Bodies;
        ref var locationA = ref bodies.Locations[tested.Pair.A.Slot];
        ref var setA = ref bodies.SetOf(locationA);
        var expansion = MaximumExpansion(setA.Collidables[locationA.Index]);
        ref readonly var velocityA = ref setA.MotionStates[locationA.Index].Velocity;
        var still = default(BodyVelocity);
        ref readonly var velocityB = ref still;
        if (tested.Pair.B.Mobility != CollidableMobility.Static)
        {
            ref var locationB = ref bodies.Locations[tested.Pair.B.Slot];
            ref var setB = ref bodies.SetOf(locationB);
            velocityB = ref setB.MotionStates[locationB.Index].Velocity;
            expansion = Math.Max(expansion, MaximumExpansion(setB.Collidables[locationB.Index]));
        }
        tested.TurnsFast = TurnsFast(velocityA, velocityB, worker.Batcher.Dt);
        // Where they will touch, nothing is ahead.
        if (tested.IsImpact)
            expansion = margin;
        worker.Batcher.AddParent(task, taskIndex, flipped, shapeA.Index, shapeB.Index, poseB.Position - poseA.Position, poseA.Orientation,
            poseB.Orientation, margin, pairId, velocityA, velocityB, expansion);
    }

    static float MaximumExpansion(in Collidable collidable) =>
        collidable.Continuity.AllowExpansionBeyondSpeculativeMargin ? float.MaxValue : collidable.SpeculativeMargin;

    int FindFirstManifold(in TestedPair tested)
    {
        if (tested.CacheIndex < 0)
            return PairRecords<ChildManifold>.None;
        ref var cached = ref Pairs.Pairs.Values[tested.CacheIndex];
        return cached.IsOfChildren ? cached.FirstManifold : PairRecords<ChildManifold>.None;
    }

    // Of several constraints that there are some is all that is asked for.
    int ConstraintTypeOfChildren(in TestedPair tested)
    {
        if (tested.CacheIndex < 0)
            return CachedManifold.NoConstraint;
        ref var cached = ref Pairs.Pairs.Values[tested.CacheIndex];
        return cached.IsOfChildren && cached.ChildConstraintCount > 0 ? 0 : CachedManifold.NoConstraint;
    }

    void BeginChildren(int workerIndex, int pairId)
    {
        ref var worker = ref workers[workerIndex];
        worker.NextManifold = worker.TestedPairs[pairId].FirstManifold;
    }

    // All lists at once: each leads from place to place, and one alone would wait at each.
    void PrefetchChildren(int workerIndex, ReadOnlySpan<int> pairIds, bool areTested)
    {
        // Where all is at hand, to look for it takes longer.
        if (areTested && isNearby)
            return;
        Span<int> places = stackalloc int[pairIds.Length];
        for (int i = 0; i < pairIds.Length; ++i)
        {
            places[i] = workers[workerIndex].TestedPairs[pairIds[i]].FirstManifold;
            // The queue of pairs has asked for it before they were tested.
            if (areTested)
                Pairs.Manifolds.Prefetch(places[i]);
        }
        for (var goesOn = true; goesOn;)
        {
            goesOn = false;
            foreach (ref var place in places)
            {
                if (place == PairRecords<ChildManifold>.None)
                    continue;
                ref var manifold = ref Pairs.Manifolds.Memory[place];
                if (manifold.Manifold.History >= 0 && !areTested)
                    Pairs.Histories.Prefetch(manifold.Manifold.History);
                place = manifold.Next;
                Pairs.Manifolds.Prefetch(place);
                goesOn |= place != PairRecords<ChildManifold>.None;
            }
        }
    }

    /// <summary>Finds the contacts of two children that have hardly moved, or the history of a test.</summary>
    bool Recall(int workerIndex, ChildIds ids, in ChildShapes children, float margin, out int history, ref ConvexContactManifold manifold)
    {
        history = PairInput.NoHistory;
        ref var next = ref workers[workerIndex].NextManifold;
        while (next != PairRecords<ChildManifold>.None && Pairs.Manifolds.Memory[next].Children.Order < ids.Order)
            next = Pairs.Manifolds.Memory[next].Next;
        if (next == PairRecords<ChildManifold>.None || Pairs.Manifolds.Memory[next].Children != ids)
            return false;
        var index = Pairs.Manifolds.Memory[next].Manifold.History;
        if (index < 0)
            return false;
        if (Reuse(index, children.NameA, children.NameB, children.OffsetB - children.OffsetA, children.OrientationA, children.OrientationB,
            margin, ref manifold))
            return true;
        history = Pairs.Histories.Memory[index].GetReference(index);
        return false;
    }

    /// <summary>Finds the patches that a pair had in the last step.</summary>
    void RecallPatches(int workerIndex, int pairId, out KnownPatches known)
    {
        ref var tested = ref workers[workerIndex].TestedPairs[pairId];
        RecallPatches(tested, out known);
        known.KeepsChildren = Waits(tested);
    }

    void RecallPatches(in TestedPair tested, out KnownPatches known)
    {
        known = default;
        for (int i = tested.FirstManifold; i != PairRecords<ChildManifold>.None; i = Pairs.Manifolds.Memory[i].Next)
        {
            ref var manifold = ref Pairs.Manifolds.Memory[i];
            if (!manifold.Children.IsPatch)
                return;
            known.Add(manifold.Children.B, manifold.Patch);
        }
    }

    /// <summary>Finds what the last step has done to a pair: how deep its patches came to be, and how its bodies moved.</summary>
    void RecallMotion(int workerIndex, int pairId, out LastMotion motion)
    {
        motion = default;
        var patch = 0;
        for (int i = workers[workerIndex].TestedPairs[pairId].FirstManifold; i != PairRecords<ChildManifold>.None; i = Pairs.Manifolds.Memory[i].Next)
        {
            if (!Pairs.Manifolds.Memory[i].Children.IsPatch)
                return;
            ref var manifold = ref Pairs.Manifolds.Memory[i].Manifold;
            if (manifold.HasConstraint)
            {
                var count = ConstraintTypeIds.ContactCount(manifold.ConstraintTypeId);
                var rows = new ContactRows(Simulation.Solver, Simulation.Bodies, manifold.Constraint, count);
                (motion.OfA, motion.OfB) = (rows.MotionOfA, rows.MotionOfB);
                for (int j = 0; j < count; ++j)
                    motion.NoteDepth(patch, -rows.Gap(j, rows.NormalRow(j)));
            }
            ++patch;
        }
    }

    bool AllowsChildren(int workerIndex, int pairId, int childA, int childB) =>
        Callbacks.AllowContactGeneration(workerIndex, workers[workerIndex].TestedPairs[pairId].Pair, childA, childB);

    void ConfigureChildren(int workerIndex, int pairId, int childA, int childB, ref ConvexContactManifold manifold)
    {
        ref var tested = ref workers[workerIndex].TestedPairs[pairId];
        if (!tested.IsSensor && !Callbacks.ConfigureContactManifold(workerIndex, tested.Pair, childA, childB, ref manifold))
            manifold.Count = 0;
    }

    void CompleteChildren(int workerIndex, int pairId, Vector3 offsetB, Span<ChildResult> results)
    {
        ref var worker = ref workers[workerIndex];
        worker.TestedPairs.Take(pairId, worker.Pool, out var tested);
        if (tested.IsSensor)
        {
            NoteSensed(workerIndex, tested.Pair, results);
            return;
        }
        tested.MayCarry = !TCallbacks.DecidesOnChildren && worker.Batcher.MayCarry && !tested.IsImpact;
        if (worker.Batcher.HitsThin || HitsCorner(tested.Pair, results))
        {
            tested.IsExact = true;
            tested.LeastHit = 0;
        }
        if (tested.IsImpact)
            MoveBack(tested, results);
        if (HasParentHistory(tested))
            Record(tested, worker.Batcher.Dt, offsetB, results);
        CompleteChildren(workerIndex, tested, offsetB, results);
    }

    void CompleteChildren(int workerIndex, in TestedPair tested, Vector3 offsetB, Span<ChildResult> results)
    {
        ref var worker = ref workers[workerIndex];
        var waits = Waits(tested);
        if (waits)
            worker.Statics.Show(results);
        var isTouching = Configure(workerIndex, tested, offsetB, results, out var material);
        if (!isTouching)
        {
            foreach (ref var result in results)
                result.Manifold.Count = 0;
            // What is near a body may be touched in the next step.
            waits = tested.Pair.B.Mobility != CollidableMobility.Dynamic;
        }
        if (!waits)
        {
            CompleteChildren(ref worker, tested, results, material);
            return;
        }
        worker.Statics.Add(tested, results, worker.Batcher.KeptChildren, material, worker.Pool);
        if (isTouching)
            AgreedPairs.NoteChange(tested.Pair.A);
        else
            NoteFoundAgain(workerIndex, tested.Pair, default, worker.Statics.Pairs.Count - 1);
    }

    // What is carried along are patches alone: the children keep their histories.
    void CompleteChildren(ref Worker worker, in TestedPair tested, Span<ChildResult> results, in PairMaterialProperties material)
    {
        // A pair of which nothing is left is not seen, and goes as a whole.
        int i = SkipForgotten(results, 0);
        if (i == results.Length)
            return;
        if (tested.CacheIndex >= 0)
            Pairs.MarkSeen(tested.CacheIndex);
        var known = tested.FirstManifold;
        Unsafe.SkipInit(out ConvexContactManifold moved);
        for (; i < results.Length; i = SkipForgotten(results, i + 1))
        {
            ref var result = ref results[i];
            var pivots = tested.MayPivot && IsPivoting(result.Manifold);
            if (pivots || (tested.MayHaveRims && rimTime > 0))
            {
                // Mostly they stay where they are: copied onto themselves, they would wait for their parts.
                ref readonly var ahead = ref tested.MayHaveRims ? ref AtRims(tested.Pair, result.Manifold, ref moved) : ref result.Manifold;
                if (pivots)
                    ahead = ref AtPivots(tested.Pair, result.Manifold, ahead, ref moved);
                if (!Unsafe.AreSame(in ahead, in result.Manifold))
                    result.Manifold = ahead;
            }
            SkipGone(ref worker, tested.Pair, ref known, result.Children.Order);
            var inherited = worker.Statics.FindInheritance(tested.Pair, result.Children);
            var frictionCenter = worker.Statics.FindFrictionCenter(tested.Pair, result.Children);
            var surface = PatchLever.Write(material, result.Lever);
            var old = PairRecords<ChildManifold>.None;
            if (known != PairRecords<ChildManifold>.None && Pairs.Manifolds.Memory[known].Children == result.Children)
            {
                old = known;
                var record = Pairs.Manifolds.Memory + known;
                known = record->Next;
                if (inherited == StaticPairs.Nothing)
                {
                    ref readonly var contacts = ref tested.MayRoll && result.Children.IsPatch && result.Manifold.Count > 0
                        ? ref LeadAlong(ref worker, tested.Pair, record->Patch, result.Manifold, ref moved)
                        : ref result.Manifold;
                    if (TryKeep(ref worker, tested.Pair, ref record->Manifold, contacts, result.KeepsHistory, surface, frictionCenter))
                    {
                        if (result.Children.IsPatch)
                            record->Patch.Write(result.Manifold);
                        continue;
                    }
                }
            }
            NotePending(ref worker, tested, result, surface, inherited, frictionCenter, old);
        }
        SkipGone(ref worker, tested.Pair, ref known, tested.IsCarried ? ChildIds.EndOfPatches : ulong.MaxValue);
    }

    // Apart from the loop, as most manifolds are kept as they are.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void NotePending(ref Worker worker, in TestedPair tested, in ChildResult result, in PairMaterialProperties material, int inherited,
        in Vector3 frictionCenter, int old)
    {
        var pending = new PendingManifold(tested.Pair, result.Children, result.KeepsHistory)
        {
            KeepsParentHistory = tested.MayCarry && result.Children.IsPatch,
            Manifold = result.Manifold,
            Material = material,
            Inherited = inherited,
            FrictionCenter = frictionCenter,
        };
        if (readsEarly && old != PairRecords<ChildManifold>.None && Pairs.Manifolds.Memory[old].Manifold.HasConstraint && result.Manifold.Count > 0)
            Read(ref worker, ref pending, Pairs.Manifolds.Memory[old].Manifold);
        Note(ref worker.Pending, pending, worker.Pool, worker.Room);
    }

    // Children without contacts are remembered for their history.
    static int SkipForgotten(Span<ChildResult> results, int i)
    {
        while (i < results.Length && results[i].Manifold.Count == 0 && !results[i].KeepsHistory)
            ++i;
        return i;
    }

    void SkipGone(ref Worker worker, in CollidablePair pair, ref int known, ulong order)
    {
        for (; known != PairRecords<ChildManifold>.None && Pairs.Manifolds.Memory[known].Children.Order < order; known = Pairs.Manifolds.Memory[known].Next)
            Note(ref worker.Gone, new GoneManifold { Pair = pair, Children = Pairs.Manifolds.Memory[known].Children }, worker.Pool);
    }

    // What keeps its number of contacts is written in place.
    bool TryKeep(ref Worker worker, in CollidablePair pair, ref CachedManifold manifold, in ConvexContactManifold contacts, bool keepsHistory,
        in PairMaterialProperties material, in Vector3 frictionCenter)
    {
        var count = contacts.Count;
        if (manifold.ConstraintTypeId != (count == 0 ? CachedManifold.NoConstraint : ConstraintType(pair, count)) ||
            (keepsHistory && manifold.History < 0))
            return false;
        if (count > 0)
            worker.Contacts.Add(Simulation.Solver, (FeatureIds*)Unsafe.AsPointer(ref manifold.Features), manifold.Constraint, contacts,
                material, frictionCenter);
        return true;
    }

    /// <summary>Asks the callbacks about a pair as a whole.</summary>
    /// <returns>Whether its contacts push.</returns>
    bool Configure(int workerIndex, in TestedPair tested, Vector3 offsetB, Span<ChildResult> results, out PairMaterialProperties material)
    {
        var only = ContactView.FindOnly(results);
        if (only == ContactView.Several)
            return ConfigureSeveral(workerIndex, tested, offsetB, results, out material);
        Unsafe.SkipInit(out ConvexContactManifold none);
        ref var manifold = ref none;
        if (only == ContactView.Nothing)
            none = new() { OffsetB = offsetB };
        else
            manifold = ref results[only].Manifold;
        if (!Callbacks.ConfigureContactManifold(workerIndex, tested.Pair, ref manifold, out material) || manifold.Count == 0)
            return false;
        NoteSurface(workerIndex, tested, ref manifold);
        CallbackChecks.Contacts(tested.Pair, manifold, material);
        LetGoOfMoved(tested.Pair, manifold.Normal, ref material);
        return true;
    }

    // With memory for the contacts of all, which those of one do not need.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool ConfigureSeveral(int workerIndex, in TestedPair tested, Vector3 offsetB, Span<ChildResult> results, out PairMaterialProperties material)
    {
        var view = new ContactView(results, offsetB);
        if (!Callbacks.ConfigureContactManifold(workerIndex, tested.Pair, ref view.Nonconvex, out material) || view.Nonconvex.Count == 0)
            return false;
        CallbackChecks.Count(tested.Pair, view.Nonconvex.Count, NonconvexContactManifold.MaximumContactCount);
        NoteSurface(workerIndex, tested, ref view.Nonconvex);
        view.TakeOver();
        foreach (ref var result in results)
        {
            if (result.Manifold.Count != 0)
                CallbackChecks.Contacts(tested.Pair, result.Manifold, material);
        }
        foreach (ref var result in results)
        {
            if (result.Manifold.Count != 0)
                LetGoOfMoved(tested.Pair, result.Manifold.Normal, ref material);
        }
        return true;
    }

    void RemoveGoneManifolds()
    {
        order.Count = 0;
        for (int i = 0; i < workers.Length; ++i)
            Gather(ref workers[i].Gone, i);
        SortByKey();
        for (int i = 0; i < order.Count; ++i)
        {
            ref var gone = ref workers[order[i].Worker].Gone[order[i].Index];
            var index = Pairs.Pairs.IndexOf(gone.Pair);
            ref var cached = ref Pairs.Pairs.Values[index];
            ref var manifold = ref Pairs.FindOrAdd(ref cached, gone.Children, Pool).Manifold;
            if (manifold.HasConstraint)
                RemoveConstraint(gone.Pair, ref cached, ref manifold);
            Pairs.Remove(index, gone.Children, Pool);
        }
    }
}
