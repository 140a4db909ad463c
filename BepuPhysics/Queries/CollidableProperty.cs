using System;
using System.Diagnostics.CodeAnalysis;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A value of a game's own for each body and static, found by handle: friction, team, name of a sound.</summary>
/// <typeparam name="T">Type of the values.</typeparam>
/// <remarks>
/// Two arrays indexed by slot, so that a callback finds a value by one read. They begin with room for as many bodies and statics as the simulation
/// has room for, and grow only when asked to: allocate or ensure capacity when a body or static is added, then read and write from any number of
/// threads. A body in the slot of one that was removed finds the value of its predecessor until it is allocated anew. Handles of what was removed
/// are refused.
/// </remarks>
public sealed class CollidableProperty<T> : IDisposable, IBufferPoolUser where T : unmanaged
{
    BufferPool? pool;
    Simulation? simulation;
    Buffer<T> bodyData;
    Buffer<T> staticData;

    /// <summary>Creates properties for a simulation that does not exist yet; call <see cref="Initialize"/> when it does.</summary>
    /// <param name="pool">Source of the memory; null for the pool of the simulation.</param>
    public CollidableProperty(BufferPool? pool = null) => this.pool = pool;

    /// <summary>Creates properties for a simulation.</summary>
    /// <param name="simulation">The simulation whose handles are used.</param>
    /// <param name="pool">Source of the memory; null for the pool of the simulation.</param>
    public CollidableProperty(Simulation simulation, BufferPool? pool = null) : this(pool) => Initialize(simulation);

    /// <summary>Makes room for all bodies and statics that a simulation has room for. To be called once; the narrow phase callbacks' Initialize is a good
    /// place.</summary>
    /// <exception cref="InvalidOperationException">There is a simulation already.</exception>
    public void Initialize(Simulation simulation)
    {
        ArgumentNullException.ThrowIfNull(simulation);
        if (this.simulation is not null)
            throw new InvalidOperationException("The properties belong to a simulation already.");
        this.simulation = simulation;
        pool ??= simulation.BufferPool;
        // Contact events of games, among others, write to values that they did not allocate.
        EnsureBodyCapacity(simulation.Bodies.HandleToLocation.Length);
        EnsureStaticCapacity(simulation.Statics.HandleToIndex.Length);
    }

    /// <summary>Value of a body.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no room for the handle: nothing was allocated for it.</exception>
    /// <exception cref="ArgumentException">The body was removed.</exception>
    public ref T this[BodyHandle bodyHandle]
    {
        get
        {
            CheckNotStale(bodyHandle);
            if ((uint)bodyHandle.Value > BodyHandle.MaximumValue || (uint)bodyHandle.Slot >= (uint)bodyData.Length)
                ThrowNoValue(nameof(bodyHandle), bodyHandle.Value);
            return ref bodyData[bodyHandle.Slot];
        }
    }

    /// <summary>Value of a static.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no room for the handle: nothing was allocated for it.</exception>
    /// <exception cref="ArgumentException">The static was removed.</exception>
    public ref T this[StaticHandle staticHandle]
    {
        get
        {
            CheckNotStale(staticHandle);
            if ((uint)staticHandle.Value > StaticHandle.MaximumValue || (uint)staticHandle.Slot >= (uint)staticData.Length)
                ThrowNoValue(nameof(staticHandle), staticHandle.Value);
            return ref staticData[staticHandle.Slot];
        }
    }

    /// <summary>Value of a body or static.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no room for the handle: nothing was allocated for it.</exception>
    public ref T this[CollidableReference collidable] =>
        ref collidable.Mobility == CollidableMobility.Static
            ? ref this[new StaticHandle(collidable.RawHandleValue)]
            : ref this[new BodyHandle(collidable.RawHandleValue)];

    /// <summary>Makes room for a body's value, sets it to its default and returns it; valid until room is made again.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The handle's value is none that a body can have.</exception>
    /// <exception cref="ArgumentException">The body was removed.</exception>
    public ref T Allocate(BodyHandle bodyHandle)
    {
        CheckNotStale(bodyHandle);
        return ref Allocate(ref bodyData, bodyHandle.Value, bodyHandle.Slot);
    }

    /// <summary>Makes room for a static's value, sets it to its default and returns it; valid until room is made again.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The handle's value is none that a static can have.</exception>
    /// <exception cref="ArgumentException">The static was removed.</exception>
    public ref T Allocate(StaticHandle handle)
    {
        CheckNotStale(handle);
        return ref Allocate(ref staticData, handle.Value, handle.Slot);
    }

    /// <summary>Makes room for the value of a body or static, sets it to its default and returns it; valid until room is made again.</summary>
    public ref T Allocate(CollidableReference collidableReference) =>
        ref collidableReference.Mobility == CollidableMobility.Static
            ? ref Allocate(new StaticHandle(collidableReference.RawHandleValue))
            : ref Allocate(new BodyHandle(collidableReference.RawHandleValue));

    /// <summary>Makes room for the bodies whose slots are below a number.</summary>
    public void EnsureBodyCapacity(int capacity)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(capacity);
        Resize(ref bodyData, Math.Max(capacity, bodyData.Length));
    }

    /// <summary>Makes room for the statics whose slots are below a number.</summary>
    public void EnsureStaticCapacity(int capacity)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(capacity);
        Resize(ref staticData, Math.Max(capacity, staticData.Length));
    }

    /// <summary>Gives back the room that the bodies of the simulation do not need.</summary>
    public void CompactBodies() => Resize(ref bodyData, CheckedSimulation.Bodies.HandlePool.HighestPossiblyClaimedId + 1);

    /// <summary>Gives back the room that the statics of the simulation do not need.</summary>
    public void CompactStatics() => Resize(ref staticData, CheckedSimulation.Statics.HandlePool.HighestPossiblyClaimedId + 1);

    /// <summary>Returns all memory to the pool. Calling it twice does no harm.</summary>
    public void Dispose()
    {
        pool!.ReturnIfTaken(ref bodyData);
        pool!.ReturnIfTaken(ref staticData);
        pool?.RemoveUser(this);
    }

    void IBufferPoolUser.CheckNotBusy() { }

    void IBufferPoolUser.ForgetMemory()
    {
        bodyData = default;
        staticData = default;
    }

    Simulation CheckedSimulation => simulation ?? throw new InvalidOperationException("Call Initialize first: the properties belong to no simulation yet.");

    ref T Allocate(ref Buffer<T> data, int handle, int slot)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(handle);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(handle, BodyHandle.MaximumValue);
        if (slot >= data.Length)
            Resize(ref data, Math.Max(slot + 1, (int)Math.Min(data.Length * 2L, int.MaxValue)));
        ref var value = ref data[slot];
        value = default;
        return ref value;
    }

    void Resize(ref Buffer<T> data, int capacity)
    {
        if (pool is null)
            throw new InvalidOperationException("Call Initialize first: there is neither a pool nor a simulation.");
        capacity = BufferPool.GetCapacityForCount<T>(Math.Max(1, capacity));
        if (capacity == data.Length)
            return;
        if (!bodyData.Allocated && !staticData.Allocated)
            pool.AddUser(this);
        var kept = Math.Min(data.Length, capacity);
        pool.ResizeToAtLeast(ref data, capacity, kept);
        data.Clear(kept, data.Length - kept);
    }

    void CheckNotStale(BodyHandle handle)
    {
        if (simulation is not null && simulation.Bodies.IsStale(handle))
            simulation.Bodies.CheckHandle(handle);
    }

    void CheckNotStale(StaticHandle handle)
    {
        if (simulation is not null && simulation.Statics.IsStale(handle))
            simulation.Statics.CheckHandle(handle);
    }

    [DoesNotReturn]
    static void ThrowNoValue(string name, int handle) =>
        throw new ArgumentOutOfRangeException(name, handle, "Nothing was allocated for this handle.");
}
