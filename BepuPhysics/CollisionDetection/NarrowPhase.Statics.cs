using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.CollisionDetection;

// Pairs of one dynamic body with several things that do not give way: statics side by side, and kinematic bodies that move alike. Each pair is tested and
// shown to the game as if it were alone. Where a body touched several in the last step, and where a pair has no contacts yet, its contacts are not written
// but wait until all pairs are tested; then those of each body agree, body by body, and go on as all contacts do.
//
// A body that begins to touch a second thing is the only case in which one pair's contacts are written already: the others agree with these.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Part of the mover's inner radius: a contact that is nearer to one of the last step is that one.
    const float SamePlace = 0.05f;

    // How many of the pairs that wait are of bodies for which all is as it was. They are the first ones.
    int heldCount;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool Waits(in TestedPair tested) =>
        tested.Pair.B.Mobility != CollidableMobility.Dynamic && !tested.IsImpact &&
        (tested.IsAtSeam || tested.ConstraintTypeId == CachedManifold.NoConstraint);

    struct SeamWork : IStagedWork
    {
        public NarrowPhase<TCallbacks> NarrowPhase;
        public int BlockCount;

        public readonly int StageCount => 1;
        public readonly int GetBlockCount(int stage) => BlockCount;
        // What a block makes of its bodies goes to the memory of the worker of its number, whoever does it.
        public readonly void Execute(int stage, int block, int workerIndex)
        {
            NarrowPhase.World.MarkWorker();
            NarrowPhase.AgreeInBlock(block, BlockCount);
        }
    }

    /// <summary>Makes the pairs of each body that wait agree, and hands them on.</summary>
    void AgreeAtSeams(int workerCount, IThreadDispatcher? dispatcher)
    {
        AgreedPairs.KeepHeld();
        heldCount = AgreedPairs.Pairs.Length;
        ListWaiting(workerCount);
        if (order.Count == 0)
            return;
        AgreedPairs.Begin(order.Count - heldCount, Pool);
        var work = new SeamWork { NarrowPhase = this, BlockCount = workerCount };
        StagedWork.Run(ref work, dispatcher);
        RememberAgreed();
        // In the first step of a world these are all pairs with statics, and the flush needs as much for their constraints.
        for (int i = 0; i < workerCount; ++i)
            workers[i].Statics.ReleasePairs(workers[i].Pool);
    }

    // Pairs of bodies for which all is as it was, in the order in which they are remembered; then the others, in the order of pairs.
    void ListWaiting(int workerCount)
    {
        var count = 0;
        for (int i = 0; i < workerCount; ++i)
            count += workers[i].Statics.Pairs.Count;
        order.Count = 0;
        if (count == 0)
            return;
        MakeRoom(ref order, count, Pool);
        foreach (ref var body in AgreedPairs.Bodies)
        {
            foreach (ref var pair in AgreedPairs.Pairs.Slice(body.First, body.Count))
                order.AddUnsafely(new() { Key = Key(new(body.Body, pair.B)), Worker = pair.Worker, Index = pair.Index });
        }
        for (int i = 0; i < workerCount && order.Count < count; ++i)
        {
            var pairs = workers[i].Statics.Pairs.AsSpan();
            for (int j = 0; j < pairs.Length; ++j)
            {
                if (heldCount == 0 || !AgreedPairs.Has(pairs[j].Tested.Pair.A))
                    order.AddUnsafely(new() { Key = Key(pairs[j].Tested.Pair), Worker = i, Index = j });
            }
        }
        SortByKey(heldCount);
    }

    // All pairs of a body are in one block.
    int FirstOfBlock(int block, int blockCount)
    {
        var first = heldCount + (int)((long)(order.Count - heldCount) * block / blockCount);
        while (first > heldCount && first < order.Count && BodyOf(first) == BodyOf(first - 1))
            ++first;
        return first;
    }

    uint BodyOf(int index) => (uint)(order[index].Key >> 32);

    void AgreeInBlock(int block, int blockCount)
    {
        ref var worker = ref workers[block];
        ref var statics = ref worker.Statics;
        statics.PrepareAgreement(worker.Pool);
        var bodyCount = (long)AgreedPairs.Bodies.Length;
        AgreeAsBefore(ref worker, (int)(bodyCount * block / blockCount), (int)(bodyCount * (block + 1) / blockCount));
        var first = FirstOfBlock(block, blockCount);
        var end = FirstOfBlock(block + 1, blockCount);
        while (first < end)
        {
            statics.Bodies.Count = statics.Old.Count = 0;
            statics.Agreement.Begin();
            while (first < end && statics.Bodies.Count < SeamMemory.BodyCapacity)
            {
                var next = first + 1;
                while (next < end && BodyOf(next) == BodyOf(first))
                    ++next;
                Begin(ref statics, first, next, worker.Pool);
                first = next;
            }
            statics.Agreement.Run(CollisionTaskRegistry, worker.Pool);
            foreach (ref var body in statics.Bodies.AsSpan())
                Finish(ref worker, body);
        }
        worker.Contacts.Flush(Simulation.Solver);
    }

    ref StaticPair Waiting(int place) => ref workers[order[place].Worker].Statics.Pairs[order[place].Index];

    ref ChildResult ResultOf(int place, int result) => ref workers[order[place].Worker].Statics.Results[result];

    // What the pairs of a body have to agree on.
    void Begin(ref StaticPairs statics, int first, int end, BufferPool pool)
    {
        ref var location = ref Simulation.Bodies.Locations[Waiting(first).Tested.Pair.A.Slot];
        ref var activity = ref Simulation.Bodies.SetOf(location).Activity[location.Index];
        var body = new AgreeingBody { First = first, End = end, FirstOld = statics.Old.Count, Number = StaticPairs.Nothing };
        ListOldPatches(ref statics, first, end, pool);
        body.OldCount = statics.Old.Count - body.FirstOld;
        for (int i = first; i < end; ++i)
        {
            Waiting(i).IsTouching = HasContacts(i);
            body.TouchCount += Waiting(i).IsTouching ? 1 : 0;
        }
        foreach (ref var old in statics.OldOf(body))
            body.TouchCount += old.IsWritten ? 1 : 0;
        // What is fast is above the next mesh before it touches that.
        activity.IsAtSeam = JoinsStatics && body.TouchCount > 0 && body.TouchCount + CountNear(first, end) > 1;
        RememberNothing(body);
        if (activity.IsAtSeam && body.TouchCount > 1)
        {
            body.MayRemember = MayRemember(statics, body);
            AddToAgreement(ref statics, ref body, pool);
        }
        statics.Bodies.Add(body, pool);
    }

    void Finish(ref Worker worker, in AgreeingBody body)
    {
        ref var statics = ref worker.Statics;
        if (body.Number != StaticPairs.Nothing)
        {
            if (statics.Agreement.Finish(body.Number, worker.Pool))
                TakeAgreement(ref worker, body);
            if (body.MayRemember)
                NoteLeft(statics, body);
            WatchHits(ref worker, body);
        }
        if (JoinsStatics)
            HandOver(ref statics, body, worker.Pool);
        Complete(ref worker, body);
    }

    void Complete(ref Worker worker, in AgreeingBody body)
    {
        ref var statics = ref worker.Statics;
        statics.FrictionCenters.Count = 0;
        if (body.TouchCount > 1 && JoinsStatics)
            JoinFriction(ref statics, body, worker.Pool);
        for (int i = body.First; i < body.End; ++i)
            HandOn(ref worker, i);
    }

    int CountNear(int first, int end)
    {
        var count = 0;
        for (int i = first; i < end; ++i)
            count += Waiting(i).IsOfChildren && !Waiting(i).IsTouching ? 1 : 0;
        return count;
    }

    bool HasContacts(int place)
    {
        ref var pair = ref Waiting(place);
        for (int i = pair.Start; i < pair.End; ++i)
        {
            if (ResultOf(place, i).Manifold.Count > 0)
                return true;
        }
        return false;
    }

    void AddToAgreement(ref StaticPairs statics, ref AgreeingBody body, BufferPool pool)
    {
        var (first, end) = (body.First, body.End);
        ref var agreement = ref statics.Agreement;
        body.Number = agreement.BeginBody(pool);
        if (body.MayRemember)
            NoteFound(body);
        statics.Groups.Count = 0;
        for (int i = first; i < end; ++i)
        {
            ref var pair = ref Waiting(i);
            pair.Slot = StaticPairs.Nothing;
            if (!pair.IsTouching)
                continue;
            pair.Group = GroupOf(ref statics, pair.Tested.Pair.A, pair.Tested.Pair.B, pool);
            pair.IsTurning = pair.Group > 0 && statics.Groups[pair.Group - 1].IsTurning;
            var number = i - first + 1;
            if (pair.IsOfGame)
            {
                for (int j = pair.Start; j < pair.End; ++j)
                {
                    ref var manifold = ref ResultOf(i, j).Manifold;
                    if (manifold.Count > 0)
                        agreement.AddFixed(manifold.Normal, manifold.GreatestDepth, number, pair.Group, pool);
                }
            }
            else if (pair.IsOfChildren)
            {
                for (int j = 0; j < pair.ChildCount; ++j)
                {
                    ref var child = ref workers[order[i].Worker].Statics.Children[pair.FirstChild + j];
                    // The mover is the body, whatever its shape is.
                    child.Placed.MoverIsB = false;
                    agreement.Add(child, number, pair.Group, Remembered(statics.OldOf(body), child), pool);
                }
            }
            else
            {
                Place(pair, ResultOf(i, pair.FirstResult).Manifold, out var child);
                pair.Slot = agreement.Add(child, number, pair.Group, Remembered(statics.OldOf(body), child), pool);
            }
        }
        var patches = statics.OldOf(body);
        for (int i = 0; i < patches.Length; ++i)
        {
            ref var old = ref patches[i];
            if (!old.IsWritten)
                continue;
            var rows = new ContactRows(Simulation.Solver, Simulation.Bodies, old.Constraint, old.ContactCount);
            var depth = rows.Depth(0);
            for (int j = 1; j < old.ContactCount; ++j)
                depth = MathHelper.Max(depth, rows.Depth(j));
            var group = GroupOf(ref statics, Pairs.Pairs.Keys[old.CacheIndex].A, Pairs.Pairs.Keys[old.CacheIndex].B, pool);
            agreement.AddFixed(rows.Normal, depth, end - first + 1 + i, group, pool);
        }
    }

    void TakeAgreement(ref Worker worker, in AgreeingBody body)
    {
        ref var agreement = ref worker.Statics.Agreement;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            var number = i - body.First + 1;
            if (pair.IsOfGame || !agreement.HasChanged(body.Number, number))
                continue;
            if (pair.IsOfChildren)
            {
                RecallPatches(pair.Tested, out var known);
                var room = workers[order[i].Worker].Statics.Results.AsSpan().Slice(pair.FirstResult - PatchSet.Capacity, PatchSet.Capacity);
                pair.PatchCount = agreement.BuildPatches(body.Number, number, known, room, worker.Pool);
            }
            else
            {
                ref var result = ref ResultOf(i, pair.FirstResult);
                ref var agreed = ref agreement.Result(body.Number, pair.Slot);
                result.Manifold = agreed.Manifold;
                result.Lever = agreed.Lever;
            }
        }
    }

    // A bit for each contact that is where one of the last step was, whichever static had that. Features do not say it: the end of a line that a seam cuts
    // off is called what the end of the whole was.
    static int Remembered(Span<OldPatch> patches, in SeamChild child)
    {
        var remembered = 0;
        var distance = SamePlace * child.Placed.InnerRadius();
        for (int i = 0; i < child.Result.Manifold.Count; ++i)
        {
            var place = child.Result.Manifold.Read(i).Offset;
            foreach (ref var old in patches)
            {
                for (int j = 0; j < old.ContactCount; ++j)
                {
                    if (Exact.DistanceSquared(old.Arms[j], place) <= distance * distance)
                        remembered |= 1 << i;
                }
            }
        }
        return remembered;
    }

    // Statics and what rests are the first.
    int GroupOf(ref StaticPairs statics, CollidableReference a, CollidableReference b, BufferPool pool)
    {
        var velocity = VelocityOf(b);
        if (velocity.Linear == default && velocity.Angular == default)
            return 0;
        var motion = new SurfaceMotion(MotionOf(b), MotionOf(a).Pose.Position);
        for (int i = 0; i < statics.Groups.Count; ++i)
        {
            if (motion.IsThatOf(statics.Groups[i], workers[0].Batcher.Dt))
                return i + 1;
        }
        statics.Groups.Add(motion, pool);
        return statics.Groups.Count;
    }

    void Place(in StaticPair pair, in ConvexContactManifold manifold, out SeamChild child)
    {
        Simulation.GetPoseAndShape(pair.Tested.Pair.A, out var poseA, out var shapeA);
        Simulation.GetPoseAndShape(pair.Tested.Pair.B, out var poseB, out var shapeB);
        Unsafe.SkipInit(out child);
        child.Class = 0;
        child.Result = new() { Children = new(0, 0), Manifold = manifold };
        ChildShapes shapes = new()
        {
            TypeA = shapeA.Type,
            TypeB = shapeB.Type,
            ShapeA = Simulation.Shapes.GetBatch(shapeA.Type).GetPointer(shapeA.Index),
            ShapeB = Simulation.Shapes.GetBatch(shapeB.Type).GetPointer(shapeB.Index),
            OffsetB = poseB.Position - poseA.Position,
            OrientationA = poseA.Orientation,
            OrientationB = poseB.Orientation,
        };
        var dt = workers[0].Batcher.Dt;
        child.Placed.Motion.Write(VelocityOf(pair.Tested.Pair.A), VelocityOf(pair.Tested.Pair.B), default, shapes.OffsetB, dt);
        child.Placed.Write(shapes, moverIsB: false, pair.Tested.SpeculativeMargin);
    }

    void HandOn(ref Worker worker, int place)
    {
        ref var pair = ref Waiting(place);
        if (pair.IsOfChildren)
        {
            var results = workers[order[place].Worker].Statics.Results.AsSpan()[pair.Start..pair.End];
            CompleteChildren(ref worker, pair.Tested, results, pair.Material);
        }
        else if (pair.ResultCount > 0)
        {
            ref var result = ref ResultOf(place, pair.FirstResult);
            ref var manifold = ref result.Manifold;
            if (manifold.Count > 0)
            {
                ref var statics = ref worker.Statics;
                Complete(ref worker, pair.Tested, manifold, PatchLever.Write(pair.Material, result.Lever),
                    statics.FindInheritance(pair.Tested.Pair, ChildIds.None), statics.FindFrictionCenter(pair.Tested.Pair, ChildIds.None));
            }
            else if (pair.Tested.KeepsHistory)
                CompleteWithoutContacts(ref worker, pair.Tested);
        }
    }
}
