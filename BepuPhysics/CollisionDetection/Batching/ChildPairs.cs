using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the test of two children has found.</summary>
struct ChildResult
{
    public ChildIds Children;
    /// <summary>Whether the test of the two shapes keeps a history.</summary>
    public bool KeepsHistory;
    /// <summary>Whether it has no contacts because what touches it there is a neighbour's.</summary>
    public bool IsLeftToNeighbours;
    /// <summary>What friction against turning has for a lever; see <see cref="FaceLever"/>.</summary>
    public byte Lever;
    /// <summary>Centre of A's child less that of A.</summary>
    public Vector3 OffsetA;
    /// <summary>The contacts: as the test found them until they are complete, then in the frame of A.</summary>
    public ConvexContactManifold Manifold;

    /// <summary>Brings contacts of the two children, as a test has found them, to the frame of A.</summary>
    public void MoveToParent(Vector3 offsetB)
    {
        // Adding nothing would change the sign of zero.
        for (int i = 0; i < Manifold.Count && OffsetA != default; ++i)
            ConvexContactManifold.GetConvexContactReference(ref Manifold, i).Offset += OffsetA;
        Manifold.OffsetB = offsetB;
    }

    /// <summary>Takes the contacts along another normal.</summary>
    public void Replace(in DirectedPair pair)
    {
        var offsetB = Manifold.OffsetB;
        Manifold = pair.Manifold;
        Manifold.Normal = pair.Normal;
        MoveToParent(offsetB);
    }
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
    public QuickList<int> Tested;
    /// <summary>What parents are joined with.</summary>
    public SeamMemory Seams;
    /// <summary>The children that the parent which was completed last was joined of, if these were asked for.</summary>
    public QuickList<SeamChild> Kept;
    /// <summary>
    /// Whether the patches of the parent that was completed last may be carried along while it hardly moves. What has round children and may roll is not:
    /// a contact that is carried along goes up behind it and pushes it on. Only where a round child lies with an end flat, it has three or more.
    /// </summary>
    public bool MayCarry;
    /// <summary>Whether what the parent that was completed last hits is so thin that it must not give way.</summary>
    public bool HitsThin;
    WaitingList<WaitingChild> waiting = new(InitialCapacity);
    WaitingList<OpenParent> parents = new(InitialCapacity);
    WaitingList<LoneChild> lone = new(InitialCapacity);

    const int InitialCapacity = 64;

    /// <summary>Where the result of a child goes.</summary>
    public readonly record struct WaitingChild(int Parent, int Slot);

    struct OpenParent
    {
        // Room for patches, then the children.
        public Buffer<ChildResult> Slots;
        // Where the children are; only of parents that are joined.
        public Buffer<PlacedChildren> Placed;
        public Vector3 OffsetB;
        public PairMotion Motion;
        public float Dt;
        public float SpeculativeMargin;
        public bool MoverIsB;
        public bool HasRound;
        public bool LeavesToNeighbours;
        // Whether a child of either shape is a triangle: nothing else is pressed through.
        public bool HasTriangle;
        public int PairId;
        public int SlotCount;
        public int WaitCount;
    }

    /// <summary>Opens a parent with room for a number of children. It stays open until <see cref="Release"/> has said that it is complete.</summary>
    public int Open(in ParentPair pair, int capacity, bool joins, float dt, BufferPool pool)
    {
        var parent = new OpenParent
        {
            OffsetB = pair.OffsetB,
            Motion = pair.Motion,
            Dt = dt,
            SpeculativeMargin = pair.SpeculativeMargin,
            // A convex shape before a container. Of two containers it is the caller's A, the body where B is a static, whatever that is wrapped in.
            MoverIsB = pair.Flipped && (ShapeCopy.Fits(pair.NameA.Type) || ShapeCopy.Fits(pair.NameB.Type)),
            HasRound = PlacedChildren.IsRound(pair.NameA.Type) || PlacedChildren.IsRound(pair.NameB.Type),
            PairId = pair.PairId,
            WaitCount = 1,
        };
        pool.TakeAtLeast(PatchSet.Capacity + capacity, out parent.Slots);
        if (joins)
            pool.TakeAtLeast(Math.Max(1, capacity), out parent.Placed);
        return parents.Add(parent, pool);
    }

    /// <summary>Notes that triangles of a parent were left out that are near only where a neighbour is.</summary>
    public readonly void LeaveToNeighbours(int parent) => parents[parent].LeavesToNeighbours = true;

    /// <summary>Gives a child the next slot of its parent.</summary>
    public readonly WaitingChild TakeSlot(int parent, ChildIds ids, bool keepsHistory, in ChildShapes shapes)
    {
        ref var target = ref parents[parent];
        // The manifold is the test's to write.
        ref var result = ref target.Slots[PatchSet.Capacity + target.SlotCount];
        result.Children = ids;
        result.KeepsHistory = keepsHistory;
        result.IsLeftToNeighbours = false;
        result.Lever = FaceLever.OfOneFace;
        result.OffsetA = shapes.OffsetA;
        if (target.Placed.Allocated)
        {
            target.HasTriangle |= shapes.TypeA == Triangle.Id || shapes.TypeB == Triangle.Id;
            ref var placed = ref target.Placed[target.SlotCount];
            placed.Motion.Write(target.Motion.A, target.Motion.B, shapes.OffsetA, target.OffsetB, target.Dt);
            placed.Write(shapes, target.MoverIsB, target.SpeculativeMargin);
        }
        ++target.WaitCount;
        return new(parent, target.SlotCount++);
    }

    /// <summary>Lets a child wait for its test.</summary>
    /// <returns>The id that it is to be tested with.</returns>
    public int Wait(WaitingChild child, BufferPool pool) => waiting.Add(child, pool);

    /// <summary>Takes a child that was tested.</summary>
    public WaitingChild Take(int id, BufferPool pool)
    {
        waiting.Take(id, pool, out var child);
        return child;
    }

    /// <summary>The slot of a child that waits.</summary>
    public readonly ref ChildResult Slot(int id) => ref id < 0 ? ref Lone(id).Child : ref Slot(waiting[id]);

    /// <summary>Lets a child wait that is alone.</summary>
    /// <returns>The id that it is to be tested with: a negative one.</returns>
    public int OpenLone(in ParentPair pair, ChildIds ids, bool keepsHistory, in ChildShapes shapes, BufferPool pool)
    {
        var id = lone.Allocate(pool);
        lone[id].Begin(pair, ids, keepsHistory, shapes);
        return ~id;
    }

    /// <summary>A child that is alone, by its id.</summary>
    public readonly ref LoneChild Lone(int id) => ref lone[~id];

    /// <summary>Closes a parent with a child that is alone.</summary>
    public void CloseLone(int id, BufferPool pool) => lone.Free(~id, pool);

    /// <summary>The slot of a child.</summary>
    public readonly ref ChildResult Slot(WaitingChild child) => ref parents[child.Parent].Slots[PatchSet.Capacity + child.Slot];

    /// <summary>The results of a parent: its patches, if children are joined, then the children in their order.</summary>
    public readonly Span<ChildResult> Results(int parent, int patchCount) =>
        new(parents[parent].Slots.Memory + PatchSet.Capacity - patchCount, patchCount + parents[parent].SlotCount);

    /// <summary>Whether children of a parent become patches.</summary>
    public readonly bool Joins(int parent) => parents[parent].Placed.Allocated;

    /// <summary>Forgets what became of the parent that was completed last: the next has nothing of it.</summary>
    public void ForgetOutcome()
    {
        Kept.Count = 0;
        MayCarry = HitsThin = false;
    }

    /// <summary>Lets a parent wait for others to be joined with, as nothing more is waited for.</summary>
    /// <returns>Whether there is room for no more.</returns>
    public bool WaitToJoin(int parent, BufferPool pool)
    {
        ref var open = ref parents[parent];
        Seams.Add(open.Slots.Memory + PatchSet.Capacity, open.Placed.Memory, open.SlotCount, parent, open.LeavesToNeighbours, pool);
        return Seams.Sets.Count == SeamMemory.SetCapacity;
    }

    /// <summary>Whether a parent may have children that it was pressed through.</summary>
    public readonly bool MayHaveSunk(in SeamSet set, in KnownPatches known) =>
        set.Count < parents[set.Owner].SlotCount && parents[set.Owner].HasTriangle &&
        SunkChildren.MayHave(set, parents[set.Owner].SlotCount, Seams.TouchingOf(set), known);

    /// <summary>Keeps a parent in front of these.</summary>
    public void HoldSunk(ref SeamSet set, in KnownPatches known, in LastMotion motion, BufferPool pool) =>
        SunkChildren.Hold(ref Seams, ref set, parents[set.Owner].SlotCount, known, motion, pool);

    /// <summary>Begins to make patches of what was found for the children of a parent, which have agreed.</summary>
    /// <param name="set">The parent's set; receives what is known of its patches.</param>
    /// <param name="known">Patches of the last step.</param>
    /// <param name="pool">Source of memory.</param>
    public void BeginPatches(ref SeamSet set, in KnownPatches known, BufferPool pool)
    {
        ref var open = ref parents[set.Owner];
        set.FirstReduced = Seams.Reduced.Count;
        set.KeepsChildren = known.KeepsChildren;
        set.PatchCount = set.Count == 0 ? 0 : PatchSet.Begin(
            ref Seams, Seams.TouchingOf(set), set.First, set.Results, set.Placed, known, new Span<ChildResult>(open.Slots.Memory, PatchSet.Capacity), pool);
        set.ReducedCount = Seams.Reduced.Count - set.FirstReduced;
    }

    /// <summary>Makes patches of a parent whose contacts are chosen.</summary>
    /// <param name="set">The parent's set.</param>
    /// <param name="pool">Source of memory.</param>
    public void FinishPatches(in SeamSet set, BufferPool pool)
    {
        ref var open = ref parents[set.Owner];
        ForgetOutcome();
        if (set.Count == 0)
            return;
        var touching = Seams.TouchingOf(set);
        var results = Results(set.Owner, 0);
        var placed = new Span<PlacedChildren>(open.Placed.Memory, open.SlotCount);
        if (set.KeepsChildren)
            Keep(touching, results, placed, pool);
        MayCarry = open.HasRound || AreAllCarried(touching, results, placed);
        var count = set.PatchCount;
        if (count == 0)
            return;
        PatchSet.Finish(touching, Seams.Reduced.AsSpan().Slice(set.FirstReduced, set.ReducedCount), set.Results,
            new Span<ChildResult>(open.Slots.Memory, PatchSet.Capacity));
        var patches = Results(set.Owner, count)[..count];
        if (ThinImpacts.MayHave(patches[0].Manifold, open.Motion, open.Dt))
            HitsThin = ThinImpacts.Has(patches, open.Motion, open.Dt, placed, touching);
    }

    static bool AreAllCarried(Span<RankedChild> touching, Span<ChildResult> results, Span<PlacedChildren> placed)
    {
        foreach (ref var child in touching)
        {
            var count = results[child.Slot].Manifold.Count;
            if (count != 0 && count < placed[child.Slot].LeastCarriedContactCount)
                return false;
        }
        return true;
    }

    void Keep(Span<RankedChild> touching, Span<ChildResult> results, Span<PlacedChildren> placed, BufferPool pool)
    {
        if (!Kept.Span.Allocated)
            Kept = new(InitialCapacity, pool);
        foreach (ref var child in touching)
        {
            if (results[child.Slot].Manifold.Count > 0)
                Kept.Add(new() { Class = child.Class, Result = results[child.Slot], Placed = placed[child.Slot] }, pool);
        }
    }

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
        Return(ref parents[parent], pool);
        parents.Free(parent, pool);
    }

    static void Return(ref OpenParent parent, BufferPool pool)
    {
        pool.Return(ref parent.Slots);
        pool.ReturnIfTaken(ref parent.Placed);
    }

    public void Dispose(BufferPool pool)
    {
        // Where a callback has thrown, some are still open.
        for (int i = 0; i < parents.Span; ++i)
        {
            if (parents[i].Slots.Allocated)
                Return(ref parents[i], pool);
        }
        parents.Dispose(pool);
        waiting.Dispose(pool);
        lone.Dispose(pool);
        Tested.DisposeIfTaken(pool);
        Found.Dispose(pool);
        Seams.Dispose(pool);
        Kept.DisposeIfTaken(pool);
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
