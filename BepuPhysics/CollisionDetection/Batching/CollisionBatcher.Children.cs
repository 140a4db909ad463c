using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

// Pairs that are expanded. Their children are tested in batches of their own by the tasks that test all convex pairs; results go to the
// slots of their parents. No pair of convex shapes comes here.
public unsafe partial struct CollisionBatcher<TCallbacks>
{
    readonly ChildPairs* Children => childPairs.Memory;

    /// <summary>The children of the pair that is being completed, if <see cref="KnownPatches.KeepsChildren"/> was said of it.</summary>
    internal readonly Span<SeamChild> KeptChildren => Children->Kept.AsSpan();

    /// <summary>Whether the patches of the pair that is being completed may be carried along while it hardly moves.</summary>
    internal readonly bool MayCarry => Children->MayCarry;

    /// <summary>Whether what the pair that is being completed hits is so thin that it must not give way.</summary>
    internal readonly bool HitsThin => Children->HitsThin;

    /// <summary>Adds a pair of shapes that exist to a task that expands it, with a pose that is known to be sound.</summary>
    internal void AddParent(CollisionTask task, int taskIndex, bool flipped, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, float speculativeMargin, int pairId, in BodyVelocity velocityA,
        in BodyVelocity velocityB, float maximumExpansion)
    {
        ref var batch = ref Write(task, taskIndex, flipped, shapeIndexA, shapeIndexB, offsetB, orientationA, orientationB, speculativeMargin, pairId,
            PairInput.NoHistory);
        // Part by part, as it comes from several places.
        ref var motion = ref Unsafe.As<ExpandingTask>(task).Parent(batch, batch.Count - 1).Motion;
        motion.A = velocityA;
        motion.B = velocityB;
        motion.MaximumExpansion = maximumExpansion;
        if (batch.Count == PairBatch.Capacity)
            Execute(task, ref batch);
    }

    void Expand(ExpandingTask task, in PairBatch batch)
    {
        if (!childPairs.Allocated)
        {
            Pool.TakeAtLeast(1, out childPairs);
            *Children = new ChildPairs(Pool);
        }
        ref var found = ref Children->Found;
        found.Count = 0;
        PrefetchChildren(task, batch);
        task.FindChildren(batch, Shapes, Dt, ref found, Pool);
        int start = 0;
        for (int i = 0; i < batch.Count; ++i)
        {
            var end = start;
            while (end < found.Count && found[end].Parent == i)
                ++end;
            FoundOrder.Sort(found.AsSpan()[start..end]);
            Expand(task, batch, i, start, TCallbacks.ChangesChildren ? end : LeaveOutOfNeighbours(task.Parent(batch, i).PairId, start, end));
            start = end;
        }
    }

    // What is touched beyond a neighbour only has nothing as long as another is touched, which is if that is to be tested. Returns the end of what is left.
    int LeaveOutOfNeighbours(int pairId, int start, int end)
    {
        var found = Children->Found.Span.Memory;
        var touching = start;
        while (touching < end && !found[touching].Touches)
            ++touching;
        if (touching == end)
            return end;
        var isAllowed = Callbacks.AllowCollisionTesting(pairId, found[touching].Children.A, found[touching].Children.B);
        found[touching].IsAllowed = isAllowed;
        var count = start;
        for (int i = start; i < end; ++i)
        {
            if (isAllowed ? !found[i].IsOfNeighbour : i != touching)
                found[count++] = found[i];
        }
        return count;
    }

    void PrefetchChildren(ExpandingTask task, in PairBatch batch)
    {
        Span<int> pairIds = stackalloc int[PairBatch.Capacity];
        for (int i = 0; i < batch.Count; ++i)
            pairIds[i] = task.Parent(batch, i).PairId;
        TCallbacks.PrefetchChildren(ref Callbacks, pairIds[..batch.Count], areTested: false);
    }

    void Expand(ExpandingTask task, in PairBatch batch, int index, int start, int end)
    {
        ref var pair = ref task.Parent(batch, index);
        if (start == end)
        {
            CompleteWithoutChildren(pair);
            return;
        }
        TCallbacks.BeginChildren(ref Callbacks, pair.PairId);
        if (end - start == 1 && task.JoinsChildren)
        {
            ExpandAlone(task, batch, pair, Children->Found[start]);
            return;
        }
        var parent = Children->Open(pair, end - start, task.JoinsChildren, Dt, Pool);
        Unsafe.SkipInit(out ChildShapes children);
        // Child of A that was asked for last, if it is where it was; none has a negative number.
        var placedA = -1;
        for (int i = start; i < end; ++i)
        {
            ref var found = ref Children->Found[i];
            if (found.LeavesToNeighbours)
                Children->LeaveToNeighbours(parent);
            if (!found.IsAllowed && !Callbacks.AllowCollisionTesting(pair.PairId, found.Children.A, found.Children.B))
                continue;
            task.GetChildren(batch, Shapes, found, found.Children.A == placedA && !found.LeadsOut, ref children);
            placedA = found.LeadsOut ? -1 : found.Children.A;
            AddChild(parent, found.Children, children, pair);
        }
        Release(parent);
    }

    // A child that is alone has nobody to agree with, and becomes a patch as soon as it is tested. But a triangle has neighbours.
    void ExpandAlone(ExpandingTask task, in PairBatch batch, in ParentPair pair, in FoundChild found)
    {
        if (!found.IsAllowed && !Callbacks.AllowCollisionTesting(pair.PairId, found.Children.A, found.Children.B))
        {
            CompleteWithoutChildren(pair);
            return;
        }
        Unsafe.SkipInit(out ChildShapes children);
        task.GetChildren(batch, Shapes, found, hasA: false, ref children);
        if (children.TypeA != Triangle.Id && children.TypeB != Triangle.Id && !TCallbacks.KeepsChildren(ref Callbacks, pair.PairId))
        {
            AddLone(found.Children, children, pair);
            return;
        }
        var parent = Children->Open(pair, 1, joins: true, Dt, Pool);
        if (found.LeavesToNeighbours)
            Children->LeaveToNeighbours(parent);
        AddChild(parent, found.Children, children, pair);
        Release(parent);
    }

    void AddLone(ChildIds ids, in ChildShapes children, in ParentPair pair)
    {
        var task = FindTask(children, out var taskIndex, out var flipped);
        var keepsHistories = task.KeepsHistories && !children.LeadsOut;
        var id = Children->OpenLone(pair, ids, keepsHistories, children, Pool);
        var history = PairInput.NoHistory;
        if (keepsHistories &&
            TCallbacks.Recall(ref Callbacks, pair.PairId, ids, children, pair.SpeculativeMargin, out history, ref Children->Lone(id).Child.Manifold))
        {
            CompleteLone(id);
            return;
        }
        AddToTask(task, taskIndex, flipped, children, pair.SpeculativeMargin, id, history);
    }

    void CompleteWithoutChildren(in ParentPair pair)
    {
        Children->ForgetOutcome();
        TCallbacks.OnChildrenCompleted(ref Callbacks, pair.PairId, pair.OffsetB, default);
    }

    void AddChild(int parent, ChildIds ids, in ChildShapes children, in ParentPair pair)
    {
        var task = FindTask(children, out var taskIndex, out var flipped);
        var keepsHistories = task.KeepsHistories && !children.LeadsOut;
        var slot = Children->TakeSlot(parent, ids, keepsHistories, children);
        var history = PairInput.NoHistory;
        if (keepsHistories &&
            TCallbacks.Recall(ref Callbacks, pair.PairId, ids, children, pair.SpeculativeMargin, out history, ref Children->Slot(slot).Manifold))
        {
            CompleteChild(slot);
            return;
        }
        AddToTask(task, taskIndex, flipped, children, pair.SpeculativeMargin, Children->Wait(slot, Pool), history);
    }

    CollisionTask FindTask(in ChildShapes children, out int taskIndex, out bool flipped)
    {
        var task = registry.GetTask(children.TypeA, children.TypeB, out taskIndex, out flipped);
        if (!task.Expands)
            return task;
        throw new InvalidOperationException(
            $"Pieces of a shape must be convex: {task.Description}. A compound was changed in place to what could not be added.");
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void AddToTask(CollisionTask task, int taskIndex, bool flipped, in ChildShapes children, float margin, int id, int history)
    {
        // Field by field: what is made elsewhere first is copied as a whole, and waits for its parts.
        Unsafe.SkipInit(out PairInput input);
        input.SpeculativeMargin = margin;
        input.PairId = id;
        input.FlipMask = flipped ? -1 : 0;
        input.History = history;
        ref var batches = ref Children->Batches;
        if (!batches.Has(taskIndex))
            batches.Take(task, taskIndex, registry.TaskCount, Pool);
        ref var batch = ref batches[taskIndex];
        var offsetB = children.OffsetB - children.OffsetA;
        if (flipped)
            task.WriteDirectly(ref batch, children.ShapeB, children.ShapeA, offsetB, children.OrientationB, children.OrientationA, input);
        else
            task.WriteDirectly(ref batch, children.ShapeA, children.ShapeB, offsetB, children.OrientationA, children.OrientationB, input);
        if (batch.Count == PairBatch.Capacity)
            TestChildren(task, ref batch);
    }

    void FlushChildren()
    {
        if (!childPairs.Allocated)
            return;
        executing = true;
        try
        {
            for (int i = Children->Batches.First; i < Children->Batches.End; ++i)
            {
                if (Children->Batches[i].Count > 0)
                    TestChildren(registry[i], ref Children->Batches[i]);
            }
            JoinWaiting();
        }
        finally
        {
            executing = false;
        }
    }

    void TestChildren(CollisionTask task, ref PairBatch batch)
    {
        ref var tested = ref Children->Tested;
        tested.Count = 0;
        tested.EnsureCapacity(PairBatch.Capacity, Pool);
        var receiver = new ChildReceiver(Children);
        task.Execute(ref batch, histories, ref receiver);
        for (int i = 0; i < tested.Count; ++i)
        {
            if (tested[i] < 0)
                CompleteLone(tested[i]);
            else
                CompleteChild(Children->Take(tested[i], Pool));
        }
    }

    void CompleteLone(int id)
    {
        ref var lone = ref Children->Lone(id);
        lone.Child.MoveToParent(lone.OffsetB);
        Callbacks.OnChildPairCompleted(lone.PairId, lone.Child.Children.A, lone.Child.Children.B, ref lone.Child.Manifold);
        Children->ForgetOutcome();
        var hasPatch = lone.Child.Manifold.Count > 0;
        if (hasPatch)
        {
            Children->MayCarry = lone.MayCarry;
            TCallbacks.RecallPatches(ref Callbacks, lone.PairId, out var known);
            lone.BuildPatch(known);
        }
        TCallbacks.OnChildrenCompleted(ref Callbacks, lone.PairId, lone.OffsetB, lone.Results(hasPatch));
        Children->CloseLone(id, Pool);
    }

    void CompleteChild(ChildPairs.WaitingChild child)
    {
        ref var result = ref Children->Slot(child);
        result.MoveToParent(Children->OffsetB(child.Parent));
        Callbacks.OnChildPairCompleted(Children->PairId(child.Parent), result.Children.A, result.Children.B, ref result.Manifold);
        Release(child.Parent);
    }

    void Release(int parent)
    {
        if (!Children->Release(parent))
            return;
        if (!Children->Joins(parent))
        {
            Children->ForgetOutcome();
            Complete(parent, 0);
        }
        else if (Children->WaitToJoin(parent, Pool))
            JoinWaiting();
    }

    void JoinWaiting()
    {
        ref var seams = ref Children->Seams;
        SeamRounds.Run(ref seams, registry, Pool);
        var sets = seams.Sets.AsSpan();
        // Where a callback throws, what is left is lost.
        seams.Sets.Count = 0;
        seams.Reduced.Count = 0;
        PrefetchChildren(sets);
        foreach (ref var set in sets)
        {
            TCallbacks.RecallPatches(ref Callbacks, Children->PairId(set.Owner), out var known);
            if (known.Count > 0 && Children->MayHaveSunk(set, known))
                HoldSunk(ref set, known);
            Children->BeginPatches(ref set, known, Pool);
        }
        PatchReduction.Run(ref seams, seams.Touching.Span.Memory, Pool);
        foreach (ref var set in sets)
        {
            Children->FinishPatches(set, Pool);
            Complete(set.Owner, set.PatchCount);
        }
        seams.Begin();
    }

    // What was loaded for the tests is gone from the first cache by now.
    void PrefetchChildren(Span<SeamSet> sets)
    {
        Span<int> pairIds = stackalloc int[sets.Length];
        for (int i = 0; i < sets.Length; ++i)
            pairIds[i] = Children->PairId(sets[i].Owner);
        TCallbacks.PrefetchChildren(ref Callbacks, pairIds, areTested: true);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void HoldSunk(ref SeamSet set, in KnownPatches known)
    {
        TCallbacks.RecallMotion(ref Callbacks, Children->PairId(set.Owner), out var motion);
        Children->HoldSunk(ref set, known, motion, Pool);
    }

    void Complete(int parent, int patchCount)
    {
        TCallbacks.OnChildrenCompleted(ref Callbacks, Children->PairId(parent), Children->OffsetB(parent), Children->Results(parent, patchCount));
        Children->Close(parent, Pool);
    }

    void DisposeChildren()
    {
        if (!childPairs.Allocated)
            return;
        Children->Dispose(Pool);
        Pool.Return(ref childPairs);
        childPairs = default;
    }
}
