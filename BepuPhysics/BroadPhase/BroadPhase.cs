using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Bounds of all collidables in two trees: one of those that move, one of those that do not.</summary>
/// <remarks>
/// The active tree is fitted anew in each <see cref="Update"/>, since most of its bounds change in each step, and rebuilt a slice at a
/// time. The static tree
/// costs nothing while nothing happens to it: changes fit it at once, and only many of them that made it worse in sum lead to a rebuild. Active leaves are
/// tested against each other and against static ones, static ones never against each other.
/// <para>
/// A collidable has an index in its tree as long as it stays there; a removal gives the index of the last collidable to the one
/// removed, and says so. Queries only read and may run on many threads; everything else needs the broad phase for itself.
/// </para>
/// </remarks>
public sealed unsafe partial class BroadPhase : IDisposable
{
    /// <summary>Tree of dynamic and kinematic bodies that are awake.</summary>
    public Tree ActiveTree;
    /// <summary>Tree of statics and sleeping bodies.</summary>
    public Tree StaticTree;
    /// <summary>Collidable of each leaf of the active tree.</summary>
    public Buffer<CollidableReference> ActiveLeaves;
    /// <summary>Collidable of each leaf of the static tree.</summary>
    public Buffer<CollidableReference> StaticLeaves;

    readonly WorldLock world;
    // Whether the leaves are the bodies and statics of a simulation, which alone may add and remove them.
    readonly bool isOwned;

    ActiveTreeUpkeep activeUpkeep;
    StaticTreeUpkeep upkeep;

    /// <summary>Pool that the memory of the trees comes from.</summary>
    public BufferPool Pool { get; }

    /// <summary>Creates an empty broad phase.</summary>
    /// <param name="pool">Pool that the memory of the trees comes from; it must outlive the broad phase.</param>
    /// <param name="initialActiveLeafCapacity">Active collidables that fit before memory is taken again.</param>
    /// <param name="initialStaticLeafCapacity">Static collidables that fit before memory is taken again.</param>
    public BroadPhase(BufferPool pool, int initialActiveLeafCapacity = 4096, int initialStaticLeafCapacity = 8192)
        : this(pool, initialActiveLeafCapacity, initialStaticLeafCapacity, new WorldLock()) => isOwned = false;

    internal BroadPhase(BufferPool pool, int initialActiveLeafCapacity, int initialStaticLeafCapacity, WorldLock world)
    {
        isOwned = true;
        this.world = world;
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfLessThan(initialActiveLeafCapacity, 1);
        ArgumentOutOfRangeException.ThrowIfLessThan(initialStaticLeafCapacity, 1);
        Pool = pool;
        MakeRoomFor(initialActiveLeafCapacity, initialStaticLeafCapacity);
    }

    /// <summary>Adds a collidable to the active tree and returns its index there.</summary>
    /// <exception cref="InvalidOperationException">The broad phase is a simulation's, whose bodies alone are its leaves.</exception>
    public int AddActive(CollidableReference collidable, ref BoundingBox bounds)
    {
        CheckNotOwned(nameof(AddActive));
        using var change = world.Change("BroadPhase.AddActive");
        return AddActiveLeaf(collidable, bounds);
    }

    internal int AddActiveLeaf(CollidableReference collidable, BoundingBox bounds)
    {
        var index = Add(collidable, bounds, ref ActiveTree, ref ActiveLeaves);
        activeUpkeep.NoteAddition();
        return index;
    }

    /// <summary>Adds a collidable to the static tree and returns its index there.</summary>
    /// <exception cref="InvalidOperationException">The broad phase is a simulation's, whose statics alone are its leaves.</exception>
    public int AddStatic(CollidableReference collidable, ref BoundingBox bounds)
    {
        CheckNotOwned(nameof(AddStatic));
        using var change = world.Change("BroadPhase.AddStatic");
        return AddStaticLeaf(collidable, bounds);
    }

    /// <param name="collidable">A static, or a body that falls asleep.</param>
    /// <param name="bounds">Its bounds.</param>
    /// <param name="scratch">Pool for the time of the call, where there is room for the leaf; null for that of the broad phase.</param>
    internal int AddStaticLeaf(CollidableReference collidable, BoundingBox bounds, BufferPool? scratch = null)
    {
        var index = Add(collidable, bounds, ref StaticTree, ref StaticLeaves, scratch);
        upkeep.Note(collidable);
        return index;
    }

    int Add(CollidableReference collidable, BoundingBox bounds, ref Tree tree, ref Buffer<CollidableReference> leaves, BufferPool? scratch = null)
    {
        // All memory before the first change.
        if (tree.LeafCount == tree.Leaves.Length)
            tree.EnsureCapacity(Math.Max(16, tree.LeafCount * 2), Pool);
        FitLeaves(tree, ref leaves);
        var index = tree.Add(bounds, scratch ?? Pool);
        leaves[index] = collidable;
        return index;
    }

    /// <summary>Removes a collidable from the active tree. Returns whether another one has taken over its index, and which.</summary>
    /// <exception cref="InvalidOperationException">The broad phase is a simulation's.</exception>
    public bool RemoveActiveAt(int index, out CollidableReference movedLeaf)
    {
        CheckNotOwned(nameof(RemoveActiveAt));
        using var change = world.Change("BroadPhase.RemoveActiveAt");
        return RemoveActiveLeafAt(index, out movedLeaf);
    }

    internal bool RemoveActiveLeafAt(int index, out CollidableReference movedLeaf) =>
        RemoveAt(index, ref ActiveTree, ref ActiveLeaves, out movedLeaf);

    /// <summary>Removes a collidable from the static tree. Returns whether another one has taken over its index, and which.</summary>
    /// <exception cref="InvalidOperationException">The broad phase is a simulation's.</exception>
    public bool RemoveStaticAt(int index, out CollidableReference movedLeaf)
    {
        CheckNotOwned(nameof(RemoveStaticAt));
        using var change = world.Change("BroadPhase.RemoveStaticAt");
        return RemoveStaticLeafAt(index, out movedLeaf);
    }

    internal bool RemoveStaticLeafAt(int index, out CollidableReference movedLeaf)
    {
        // An index of no leaf is refused by the tree.
        if ((uint)index < (uint)StaticTree.LeafCount)
            upkeep.Note(StaticLeaves[index]);
        return RemoveAt(index, ref StaticTree, ref StaticLeaves, out movedLeaf);
    }

    static bool RemoveAt(int index, ref Tree tree, ref Buffer<CollidableReference> leaves, out CollidableReference movedLeaf)
    {
        var movedIndex = tree.RemoveAt(index);
        movedLeaf = default;
        if (movedIndex < 0)
            return false;
        movedLeaf = leaves[movedIndex];
        leaves[index] = movedLeaf;
        return true;
    }

    /// <summary>Pointers to the bounds of an active leaf, valid until the tree changes. What is written takes effect in the next
    /// <see cref="Update"/>.</summary>
    public void GetActiveBoundsPointers(int index, out Vector3* minPointer, out Vector3* maxPointer) =>
        ActiveTree.GetBoundsPointers(index, out minPointer, out maxPointer);

    /// <summary>
    /// Pointers to the bounds of a static leaf, valid until the tree changes, for reading: the static tree is not fitted in steps, so
    /// change
    /// bounds with <see cref="UpdateStaticBounds"/>.
    /// </summary>
    public void GetStaticBoundsPointers(int index, out Vector3* minPointer, out Vector3* maxPointer) =>
        StaticTree.GetBoundsPointers(index, out minPointer, out maxPointer);

    /// <summary>Changes the bounds of an active leaf at once.</summary>
    public void UpdateActiveBounds(int broadPhaseIndex, Vector3 min, Vector3 max)
    {
        using var change = world.Change("BroadPhase.UpdateActiveBounds");
        ActiveTree.UpdateBounds(broadPhaseIndex, min, max);
    }

    /// <summary>Changes the bounds of a static leaf at once.</summary>
    public void UpdateStaticBounds(int broadPhaseIndex, Vector3 min, Vector3 max)
    {
        using var change = world.Change("BroadPhase.UpdateStaticBounds");
        UpdateStaticLeaf(broadPhaseIndex, min, max);
    }

    internal void UpdateStaticLeaf(int index, Vector3 min, Vector3 max)
    {
        StaticTree.UpdateBounds(index, min, max);
        upkeep.Note(StaticLeaves[index]);
    }

    /// <summary>Fits the active tree to bounds written since the last call and tidies both trees a little. Once in each step, before
    /// overlaps are looked for.</summary>
    /// <remarks>What the trees look like afterwards does not depend on the dispatcher.</remarks>
    public void Update(IThreadDispatcher? threadDispatcher = null)
    {
        using var change = world.Change("BroadPhase.Update");
        UpdateTrees(threadDispatcher);
        TidyActiveTree(Pool);
    }

    /// <summary>Whether something is left to do where no body is awake.</summary>
    internal bool IsUpdateDue => upkeep.IsDue(StaticTree.LeafCount);

    internal void UpdateTrees(IThreadDispatcher? dispatcher = null)
    {
        activeUpkeep.Fit(ref ActiveTree, Pool, dispatcher);
        upkeep.Update(ref StaticTree, Pool, dispatcher);
    }

    /// <summary>Whether another thread may tidy the active tree with memory of its own, while nobody looks at it.</summary>
    internal bool MayTidyAside => activeUpkeep.TidiesInPlace(ActiveTree);

    /// <summary>Mends a part of the active tree for the steps to come, once after each update. It still fits.</summary>
    internal void TidyActiveTree(BufferPool pool) => activeUpkeep.Tidy(ref ActiveTree, pool);

    /// <summary>Finds all pairs of leaves with overlapping bounds that have an active leaf, on all workers of the dispatcher.</summary>
    /// <param name="handler">Receives the pairs; copied in and copied back, one copy shared by all workers.</param>
    /// <param name="threadDispatcher">Workers to use; null for the calling thread.</param>
    public void FindOverlaps<THandler>(ref THandler handler, IThreadDispatcher? threadDispatcher = null)
        where THandler : struct, IBroadPhaseOverlapHandler
    {
        using var stage = world.Stage(allowsQueries: true, "BroadPhase.FindOverlaps");
        FindOverlapsOfLeaves(ref handler, threadDispatcher);
    }

    internal void FindOverlapsOfLeaves<THandler>(ref THandler handler, IThreadDispatcher? threadDispatcher)
        where THandler : struct, IBroadPhaseOverlapHandler
    {
        // Only after changes that no update followed.
        if (!ActiveTree.IsDepthFirst)
            ActiveTree.Refit(Pool);
        OverlapFinder.Find(ActiveTree, StaticTree, Pool, ref handler, threadDispatcher, world);
    }

    /// <summary>Makes room for numbers of leaves.</summary>
    /// <exception cref="ArgumentOutOfRangeException">A number is negative or more than a tree holds; nothing was changed.</exception>
    public void EnsureCapacity(int activeCapacity, int staticCapacity)
    {
        CheckCapacity(activeCapacity, nameof(activeCapacity));
        CheckCapacity(staticCapacity, nameof(staticCapacity));
        using var change = world.Change("BroadPhase.EnsureCapacity");
        MakeRoomFor(activeCapacity, staticCapacity);
    }

    internal void MakeRoomFor(int activeCapacity, int staticCapacity)
    {
        ActiveTree.EnsureCapacity(activeCapacity, Pool);
        StaticTree.EnsureCapacity(staticCapacity, Pool);
        FitLeaves(ActiveTree, ref ActiveLeaves);
        FitLeaves(StaticTree, ref StaticLeaves);
    }

    void FitLeaves(in Tree tree, ref Buffer<CollidableReference> leaves)
    {
        if (tree.Leaves.Length > leaves.Length)
            Pool.ResizeToAtLeast(ref leaves, tree.Leaves.Length, tree.LeafCount);
    }

    /// <summary>Changes the room for leaves to about these numbers, never below what is in use.</summary>
    /// <exception cref="ArgumentOutOfRangeException">A number is negative or more than a tree holds; nothing was changed.</exception>
    public void Resize(int activeCapacity, int staticCapacity)
    {
        CheckCapacity(activeCapacity, nameof(activeCapacity));
        CheckCapacity(staticCapacity, nameof(staticCapacity));
        using var change = world.Change("BroadPhase.Resize");
        ActiveTree.Resize(Pool, activeCapacity);
        StaticTree.Resize(Pool, staticCapacity);
        Pool.ResizeToAtLeast(ref ActiveLeaves, ActiveTree.Leaves.Length, ActiveTree.LeafCount);
        Pool.ResizeToAtLeast(ref StaticLeaves, StaticTree.Leaves.Length, StaticTree.LeafCount);
    }

    /// <summary>Removes all leaves and keeps the memory.</summary>
    /// <exception cref="InvalidOperationException">The broad phase is a simulation's.</exception>
    public void Clear()
    {
        CheckNotOwned(nameof(Clear));
        using var change = world.Change("BroadPhase.Clear");
        RemoveAllLeaves();
    }

    internal void ShiftOrigin(Vector3 shift)
    {
        ActiveTree.ShiftOrigin(shift);
        StaticTree.ShiftOrigin(shift);
    }

    internal void CopyState(StateCopy copy)
    {
        ActiveTree.CopyState(copy);
        StaticTree.CopyState(copy);
        copy.Rows(ref ActiveLeaves, ActiveTree.LeafCount);
        copy.Rows(ref StaticLeaves, StaticTree.LeafCount);
        copy.Value(ref activeUpkeep);
        copy.Value(ref upkeep);
        if (!copy.Restores)
            return;
        FitLeaves(ActiveTree, ref ActiveLeaves);
        FitLeaves(StaticTree, ref StaticLeaves);
    }

    internal void RemoveAllLeaves()
    {
        ActiveTree.Clear();
        StaticTree.Clear();
        activeUpkeep = default;
        upkeep = default;
    }

    /// <summary>Gives all memory back to the pool. Calling it twice does no harm.</summary>
    /// <exception cref="InvalidOperationException">The broad phase is a simulation's, which disposes it.</exception>
    public void Dispose()
    {
        CheckNotOwned(nameof(Dispose));
        using var change = world.Change("BroadPhase.Dispose");
        ReturnMemory();
    }

    static void CheckCapacity(int capacity, string name)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(capacity, name);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(capacity, Tree.MaximumLeafCount, name);
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        ActiveTree = default;
        StaticTree = default;
        ActiveLeaves = default;
        StaticLeaves = default;
    }

    void CheckNotOwned(string operation)
    {
        world.CheckAlive();
        if (isOwned)
            throw new InvalidOperationException($"{operation}: the leaves of a simulation's broad phase are its bodies and statics; add and remove these.");
    }

    internal void ReturnMemory()
    {
        ActiveTree.Dispose(Pool);
        StaticTree.Dispose(Pool);
        Pool.ReturnIfTaken(ref ActiveLeaves);
        Pool.ReturnIfTaken(ref StaticLeaves);
        activeUpkeep = default;
        upkeep = default;
    }

    /// <summary>Walks the invariants of both trees.</summary>
    /// <param name="tightBounds">Whether the boxes of nodes must fit; false between writing active bounds and <see cref="Update"/>.</param>
    /// <exception cref="BepuUtilities.Diagnostics.PhysicsInvariantException">Something does not hold; the message says what.</exception>
    public void Validate(bool tightBounds = true)
    {
        ActiveTree.Validate(tightBounds);
        StaticTree.Validate();
    }
}
