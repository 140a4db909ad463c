using System;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>All statics of a simulation: collidables that never move by themselves.</summary>
public sealed unsafe partial class Statics
{
    readonly BufferPool pool;
    readonly BroadPhase broadPhase;
    readonly Shapes shapes;

    /// <summary>Index of each static by handle value; -1 where there is none.</summary>
    public Buffer<int> HandleToIndex;
    /// <summary>Handle of each static.</summary>
    public Buffer<StaticHandle> IndexToHandle;
    /// <summary>The statics.</summary>
    public Buffer<Static> StaticsBuffer;
    /// <summary>Hands out the values of static handles.</summary>
    public IdPool HandlePool;
    /// <summary>Number of statics.</summary>
    public int Count { get; private set; }

    internal Statics(BufferPool pool, BroadPhase broadPhase, Shapes shapes, int initialCapacity)
    {
        this.pool = pool;
        this.broadPhase = broadPhase;
        this.shapes = shapes;
        initialCapacity = Math.Max(16, initialCapacity);
        HandlePool = new IdPool(initialCapacity, pool);
        pool.Take(initialCapacity, out IndexToHandle);
        pool.Take(initialCapacity, out StaticsBuffer);
        pool.Take(initialCapacity, out HandleToIndex);
        for (int i = 0; i < initialCapacity; ++i)
            HandleToIndex[i] = -1;
    }

    /// <summary>A static by its handle.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public StaticReference this[StaticHandle handle] => GetStaticReference(handle);

    /// <summary>A static by its index.</summary>
    public ref Static this[int index] => ref StaticsBuffer[index];

    /// <summary>Whether a handle names a static.</summary>
    public bool StaticExists(StaticHandle handle) => (uint)handle.Value < (uint)HandleToIndex.Length && HandleToIndex[handle.Value] >= 0;

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
        return ref StaticsBuffer[HandleToIndex[handle.Value]];
    }

    /// <summary>Adds a static.</summary>
    /// <exception cref="ArgumentException">A value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public StaticHandle Add(in StaticDescription description)
    {
        Validate(description);
        var handle = new StaticHandle(HandlePool.Take());
        if (handle.Value >= HandleToIndex.Length)
        {
            var previous = HandleToIndex.Length;
            pool.ResizeToAtLeast(ref HandleToIndex, handle.Value + 1, previous);
            for (int i = previous; i < HandleToIndex.Length; ++i)
                HandleToIndex[i] = -1;
        }
        if (Count == Capacity)
            EnsureCapacity(Count * 2);
        var index = Count++;
        HandleToIndex[handle.Value] = index;
        IndexToHandle[index] = handle;
        StaticsBuffer[index] = new() { Pose = description.Pose, Shape = description.Shape, Continuity = description.Continuity, BroadPhaseIndex = -1 };
        AddToBroadPhase(index);
        return handle;
    }

    /// <summary>Removes a static.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public void Remove(StaticHandle handle)
    {
        CheckHandle(handle);
        RemoveAt(HandleToIndex[handle.Value]);
    }

    /// <summary>Removes a static by its index; the last one takes its place.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such static.</exception>
    public void RemoveAt(int index)
    {
        if ((uint)index >= (uint)Count)
            throw new ArgumentOutOfRangeException(nameof(index), index, $"There are {Count} statics.");
        RemoveFromBroadPhase(index);
        var handle = IndexToHandle[index];
        var last = --Count;
        if (index != last)
        {
            StaticsBuffer[index] = StaticsBuffer[last];
            IndexToHandle[index] = IndexToHandle[last];
            HandleToIndex[IndexToHandle[index].Value] = index;
        }
        HandleToIndex[handle.Value] = -1;
        HandlePool.Return(handle.Value, pool);
    }

    /// <summary>Gives a static another shape.</summary>
    /// <exception cref="ArgumentException">There is no such static or no such shape; nothing was changed.</exception>
    public void SetShape(StaticHandle handle, TypedIndex shape)
    {
        CheckHandle(handle);
        shapes.CheckExists(shape, nameof(shape));
        var index = HandleToIndex[handle.Value];
        StaticsBuffer[index].Shape = shape;
        UpdateBoundsAt(index);
    }

    /// <summary>Makes a static what a description says.</summary>
    /// <exception cref="ArgumentException">There is no such static, a value cannot be simulated, or the shape does not exist; nothing was changed.</exception>
    public void ApplyDescription(StaticHandle handle, in StaticDescription description)
    {
        CheckHandle(handle);
        Validate(description);
        var index = HandleToIndex[handle.Value];
        ref var target = ref StaticsBuffer[index];
        target.Pose = description.Pose;
        target.Shape = description.Shape;
        target.Continuity = description.Continuity;
        UpdateBoundsAt(index);
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

    /// <summary>Moves the bounds of a static to where its pose says.</summary>
    /// <exception cref="ArgumentException">There is no such static.</exception>
    public void UpdateBounds(StaticHandle handle)
    {
        CheckHandle(handle);
        UpdateBoundsAt(HandleToIndex[handle.Value]);
    }

    // A pool may lend more than was asked for, and not to both alike.
    int Capacity => Math.Min(StaticsBuffer.Length, IndexToHandle.Length);

    /// <summary>Makes room for statics.</summary>
    public void EnsureCapacity(int capacity)
    {
        if (capacity <= Capacity)
            return;
        pool.ResizeToAtLeast(ref StaticsBuffer, capacity, Count);
        pool.ResizeToAtLeast(ref IndexToHandle, capacity, Count);
    }

    internal void GetBoundsPointers(StaticHandle handle, out System.Numerics.Vector3* min, out System.Numerics.Vector3* max) =>
        broadPhase.GetStaticBoundsPointers(StaticsBuffer[HandleToIndex[handle.Value]].BroadPhaseIndex, out min, out max);

    void Validate(in StaticDescription description)
    {
        BodyChecks.Pose(description.Pose);
        description.Continuity.Validate(nameof(description.Continuity));
        shapes.CheckExists(description.Shape, nameof(description.Shape));
    }

    void CheckHandle(StaticHandle handle)
    {
        if (!StaticExists(handle))
            throw new ArgumentException($"There is no {handle}.", nameof(handle));
    }

    void AddToBroadPhase(int index)
    {
        ref var target = ref StaticsBuffer[index];
        shapes.UpdateBounds(target.Pose, target.Shape, out var bounds);
        target.BroadPhaseIndex = broadPhase.AddStatic(new CollidableReference(IndexToHandle[index]), ref bounds);
    }

    void RemoveFromBroadPhase(int index)
    {
        var leaf = StaticsBuffer[index].BroadPhaseIndex;
        if (broadPhase.RemoveStaticAt(leaf, out var moved))
            StaticsBuffer[HandleToIndex[moved.StaticHandle.Value]].BroadPhaseIndex = leaf;
    }

    // Bounds of still things are not refitted every step, so a static that moved is taken out of its tree and put in anew.
    void UpdateBoundsAt(int index)
    {
        RemoveFromBroadPhase(index);
        AddToBroadPhase(index);
    }

    internal void Clear()
    {
        for (int i = 0; i < Count; ++i)
            HandleToIndex[IndexToHandle[i].Value] = -1;
        Count = 0;
        HandlePool.Clear();
    }

    internal void Dispose()
    {
        pool.Return(ref HandleToIndex);
        pool.Return(ref IndexToHandle);
        pool.Return(ref StaticsBuffer);
        HandlePool.Dispose(pool);
    }
}
