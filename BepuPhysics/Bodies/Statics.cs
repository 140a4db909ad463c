using System;
using System.Diagnostics.CodeAnalysis;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>All statics of a simulation: collidables that never move by themselves.</summary>
public sealed unsafe partial class Statics
{
    readonly WorldLock world;
    readonly BufferPool pool;
    readonly BroadPhase broadPhase;
    readonly Shapes shapes;
    Bodies bodies = null!;
    IslandAwakener awakener = null!;
    CollidableTraits traits = null!;

    /// <summary>Greatest number of statics.</summary>
    public const int MaximumCount = 1 << HandleLayout.SlotBits;

    /// <summary>Index of each static by slot; -1 where there is none.</summary>
    internal Buffer<int> Indices;
    HandleOwners owners;

    /// <summary>Index of each static by handle value or slot; -1 where there is none.</summary>
    public HandleTable<int> HandleToIndex => new(Indices, StaticHandle.SlotMask);
    /// <summary>Handle of each static.</summary>
    public Buffer<StaticHandle> IndexToHandle;
    /// <summary>The statics.</summary>
    public Buffer<Static> StaticsBuffer;
    /// <summary>Hands out the slots of static handles.</summary>
    public IdPool HandlePool;
    /// <summary>Number of statics.</summary>
    public int Count { get; private set; }

    internal Statics(BufferPool pool, BroadPhase broadPhase, Shapes shapes, int initialCapacity, WorldLock world)
    {
        this.world = world;
        this.pool = pool;
        this.broadPhase = broadPhase;
        this.shapes = shapes;
        initialCapacity = Math.Max(16, initialCapacity);
        HandlePool = new IdPool(initialCapacity, pool);
        pool.Take(initialCapacity, out IndexToHandle);
        pool.Take(initialCapacity, out StaticsBuffer);
        owners = new HandleOwners(HandleLayout.SlotBits, HandleLayout.ValueBits, initialCapacity, pool);
        EnsureSlots(initialCapacity);
    }

    internal void Connect(Bodies bodies, IslandAwakener awakener, CollidableTraits traits)
    {
        this.bodies = bodies;
        this.awakener = awakener;
        this.traits = traits;
    }

    /// <summary>A static by its handle.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public StaticReference this[StaticHandle handle] => GetStaticReference(handle);

    /// <summary>A static by its index.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such static.</exception>
    public ref Static this[int index]
    {
        get
        {
            CheckIndex(index);
            return ref StaticsBuffer[index];
        }
    }

    /// <summary>Whether a handle names a static.</summary>
    public bool StaticExists(StaticHandle handle) => owners.Has(handle.Value, handle.Slot);

    /// <summary>Finds the static that has a slot now, as when walking through an array by slots.</summary>
    /// <param name="slot">Any number.</param>
    /// <param name="handle">Handle of the static.</param>
    /// <returns>Whether there is one.</returns>
    public bool TryGetHandle(int slot, out StaticHandle handle)
    {
        var exists = owners.IsTaken(slot);
        handle = new(exists ? owners.ValueAt(slot) : -1);
        return exists;
    }

    /// <summary>Whether a handle is that of a static that was removed.</summary>
    internal bool IsStale(StaticHandle handle) => owners.IsStale(handle.Value, handle.Slot);

    /// <summary>A static by its handle.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public StaticReference GetStaticReference(StaticHandle handle)
    {
        CheckHandle(handle);
        return new(handle, this);
    }

    /// <summary>A static by its handle, to read or write in place.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public ref Static GetDirectReference(StaticHandle handle)
    {
        CheckHandle(handle);
        return ref StaticsBuffer[Indices[handle.Slot]];
    }

    /// <summary>Adds a static and wakes the dynamic bodies that it may touch.</summary>
    /// <exception cref="ArgumentException">A value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">There are <see cref="MaximumCount"/> statics already.</exception>
    public StaticHandle Add(in StaticDescription description)
    {
        var filter = default(StaticsShouldntAwakenKinematics);
        return Add(description, ref filter);
    }

    /// <summary>Adds a static and wakes nobody.</summary>
    /// <exception cref="ArgumentException">A value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">There are <see cref="MaximumCount"/> statics already.</exception>
    public StaticHandle AddWithoutAwakeningBodies(in StaticDescription description)
    {
        var filter = default(StaticsShouldntAwakenBodies);
        return Add(description, ref filter);
    }

    /// <summary>Adds a static and wakes the bodies that a filter chooses.</summary>
    /// <exception cref="ArgumentException">A value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">There are <see cref="MaximumCount"/> statics already.</exception>
    public StaticHandle Add<TAwakeningFilter>(in StaticDescription description, ref TAwakeningFilter filter)
        where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        using var change = world.Change("Statics.Add");
        Validate(description);
        MakeRoom();
        var pose = BodyChecks.Straighten(description.Pose);
        var bounds = BoundsOf(pose, description.Shape);
        awakener.BeginRequests();
        awakener.Request(bounds, ref filter);
        // All memory has been taken: from here on nothing fails.
        var handle = new StaticHandle(owners.Claim(HandlePool.Take()));
        var index = Count++;
        Indices[handle.Slot] = index;
        IndexToHandle[index] = handle;
        StaticsBuffer[index] = new() { Pose = pose, Shape = description.Shape, Continuity = description.Continuity, BroadPhaseIndex = -1 };
        shapes.BeginUse(description.Shape);
        AddToBroadPhase(index, bounds);
        awakener.WakeRequested();
        return handle;
    }

    /// <summary>Removes a static and wakes the dynamic bodies that may have touched it.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public void Remove(StaticHandle handle)
    {
        var filter = default(StaticsShouldntAwakenKinematics);
        Remove(handle, ref filter);
    }

    /// <summary>Removes a static and wakes the bodies that a filter chooses.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public void Remove<TAwakeningFilter>(StaticHandle handle, ref TAwakeningFilter filter) where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        using var change = world.Change("Statics.Remove");
        CheckHandle(handle);
        RemoveStaticAt(Indices[handle.Slot], ref filter);
    }

    /// <summary>Removes a static by its index, where the last one takes its place, and wakes the dynamic bodies that may have touched it.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such static.</exception>
    public void RemoveAt(int index)
    {
        var filter = default(StaticsShouldntAwakenKinematics);
        RemoveAt(index, ref filter);
    }

    /// <summary>Removes a static by its index, where the last one takes its place, and wakes the bodies that a filter chooses.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such static.</exception>
    public void RemoveAt<TAwakeningFilter>(int index, ref TAwakeningFilter filter) where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        using var change = world.Change("Statics.RemoveAt");
        CheckIndex(index);
        RemoveStaticAt(index, ref filter);
    }

    void RemoveStaticAt<TAwakeningFilter>(int index, ref TAwakeningFilter filter) where TAwakeningFilter : struct, IStaticChangeAwakeningFilter
    {
        awakener.BeginRequests();
        awakener.Request(BoundsAt(index), ref filter);
        RemoveFromBroadPhase(index);
        shapes.EndUse(StaticsBuffer[index].Shape);
        var handle = IndexToHandle[index];
        var last = --Count;
        if (index != last)
        {
            StaticsBuffer[index] = StaticsBuffer[last];
            IndexToHandle[index] = IndexToHandle[last];
            Indices[IndexToHandle[index].Slot] = index;
        }
        Indices[handle.Slot] = -1;
        traits.Forget(new(handle));
        owners.Release(handle.Slot);
        HandlePool.Return(handle.Slot, pool);
        awakener.WakeRequested();
    }

    /// <summary>Describes a static as it is now.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public void GetDescription(StaticHandle handle, out StaticDescription description)
    {
        ref var target = ref GetDirectReference(handle);
        description = new(target.Pose, target.Shape, target.Continuity);
    }

    /// <summary>Describes a static as it is now.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public StaticDescription GetDescription(StaticHandle handle)
    {
        GetDescription(handle, out var description);
        return description;
    }

    // A pool may lend more than was asked for, and not to both alike.
    int Capacity => Math.Min(StaticsBuffer.Length, IndexToHandle.Length);

    /// <summary>Makes room for statics.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative or more than <see cref="MaximumCount"/>; nothing was changed.</exception>
    public void EnsureCapacity(int capacity)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(capacity);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(capacity, MaximumCount);
        using var change = world.Change("Statics.EnsureCapacity");
        MakeRoomFor(capacity);
    }

    internal void MakeRoomFor(int capacity)
    {
        if (capacity <= Capacity)
            return;
        pool.ResizeToAtLeast(ref StaticsBuffer, capacity, Count);
        pool.ResizeToAtLeast(ref IndexToHandle, capacity, Count);
    }

    internal void GetBoundsPointers(StaticHandle handle, out System.Numerics.Vector3* min, out System.Numerics.Vector3* max) =>
        broadPhase.GetStaticBoundsPointers(StaticsBuffer[GetIndex(handle)].BroadPhaseIndex, out min, out max);

    void Validate(in StaticDescription description)
    {
        BodyChecks.Pose(description.Pose);
        description.Continuity.Validate(nameof(description.Continuity));
        shapes.CheckExists(description.Shape, nameof(description.Shape));
    }

    /// <summary>Index of a static.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    internal int GetIndex(StaticHandle handle)
    {
        CheckHandle(handle);
        return Indices[handle.Slot];
    }

    /// <summary>Refuses a handle that is no static's.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    internal void CheckHandle(StaticHandle handle)
    {
        if (!StaticExists(handle))
            ThrowMissing(handle);
    }

    [DoesNotReturn]
    void ThrowMissing(StaticHandle handle)
    {
        world.CheckAlive();
        throw owners.Missing(handle, handle.Value, handle.Slot);
    }

    void CheckIndex(int index)
    {
        if ((uint)index >= (uint)Count)
            ThrowMissing(index);
    }

    [DoesNotReturn]
    void ThrowMissing(int index)
    {
        world.CheckAlive();
        throw new ArgumentOutOfRangeException(nameof(index), index, $"There are {Count} statics.");
    }

    void MakeRoom()
    {
        if (HandleOwners.NeedsSlot(HandlePool, MaximumCount, "statics", out var slotCount))
            EnsureSlots(slotCount);
        if (Count == Capacity)
            MakeRoomFor(Count * 2);
        broadPhase.MakeRoomFor(0, broadPhase.StaticTree.LeafCount + 1);
    }

    /// <summary>As <see cref="HandleOwners.IsPlain"/>.</summary>
    internal bool HasPlainHandles
    {
        get => owners.IsPlain;
        set => owners.IsPlain = value;
    }

    void EnsureSlots(int count) => owners.EnsureSlots(count, -1, ref Indices, ref HandlePool, pool);

    BoundingBox BoundsOf(in RigidPose pose, TypedIndex shape)
    {
        shapes.UpdateBounds(pose, shape, out var bounds);
        return bounds;
    }

    void AddToBroadPhase(int index, BoundingBox bounds) =>
        StaticsBuffer[index].BroadPhaseIndex = broadPhase.AddStaticLeaf(new CollidableReference(IndexToHandle[index]), bounds);

    void RemoveFromBroadPhase(int index)
    {
        var leaf = StaticsBuffer[index].BroadPhaseIndex;
        if (broadPhase.RemoveStaticLeafAt(leaf, out var moved))
            bodies.FollowStaticLeaf(moved, leaf);
    }

    internal void Clear()
    {
        for (int i = 0; i < Count; ++i)
        {
            Indices[IndexToHandle[i].Slot] = -1;
            shapes.EndUse(StaticsBuffer[i].Shape);
        }
        owners.ReleaseAll();
        ForgetMoved();
        Count = 0;
        HandlePool.Clear();
    }

    internal void Dispose()
    {
        EndUses();
        pool.Return(ref Indices);
        owners.Dispose(pool);
        pool.Return(ref IndexToHandle);
        pool.Return(ref StaticsBuffer);
        HandlePool.Dispose(pool);
        DisposeMoved();
    }

    /// <summary>Forgets all memory, which the pool has given back to the system.</summary>
    internal void Abandon()
    {
        EndUses();
        Indices = default;
        IndexToHandle = default;
        StaticsBuffer = default;
        moved = default;
        movedPlaces = default;
        owners = default;
        HandlePool = default;
    }

    void EndUses()
    {
        var end = new UsesEnd(shapes);
        VisitShapes(ref end);
        Count = 0;
    }

    /// <summary>Visits the shape of each static.</summary>
    internal void VisitShapes<TVisitor>(ref TVisitor visitor) where TVisitor : struct, IForEach<TypedIndex>
    {
        for (int i = 0; i < Count; ++i)
            visitor.LoopBody(StaticsBuffer[i].Shape);
    }
}
