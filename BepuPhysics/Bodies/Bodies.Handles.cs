using System;
using System.Diagnostics.CodeAnalysis;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Which handle is whose, and where the body is.
public sealed partial class Bodies
{
    /// <summary>Greatest number of bodies.</summary>
    public const int MaximumCount = 1 << HandleLayout.SlotBits;

    /// <summary>Where each body is, by slot.</summary>
    internal Buffer<BodyMemoryLocation> Locations;
    HandleOwners owners;

    /// <summary>Where each body is, by handle value or slot.</summary>
    public HandleTable<BodyMemoryLocation> HandleToLocation => new(Locations, BodyHandle.SlotMask);
    /// <summary>Hands out the slots of body handles.</summary>
    public IdPool HandlePool;
    /// <summary>A body by its handle.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public BodyReference this[BodyHandle handle] => GetBodyReference(handle);

    /// <summary>A body by its handle.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    public BodyReference GetBodyReference(BodyHandle handle)
    {
        CheckHandle(handle);
        return new(handle, this);
    }

    /// <summary>Whether a handle names a body.</summary>
    public bool BodyExists(BodyHandle bodyHandle) => owners.Has(bodyHandle.Value, bodyHandle.Slot);

    /// <summary>Finds the body that has a slot now, as when walking through an array by slots.</summary>
    /// <param name="slot">Any number.</param>
    /// <param name="handle">Handle of the body.</param>
    /// <returns>Whether there is one.</returns>
    public bool TryGetHandle(int slot, out BodyHandle handle)
    {
        var exists = owners.IsTaken(slot);
        handle = new(exists ? owners.ValueAt(slot) : -1);
        return exists;
    }

    /// <summary>Whether a handle is that of a body that was removed.</summary>
    internal bool IsStale(BodyHandle handle) => owners.IsStale(handle.Value, handle.Slot);

    /// <summary>Where a body is.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    internal ref BodyMemoryLocation GetLocation(BodyHandle handle)
    {
        CheckHandle(handle);
        return ref Locations[handle.Slot];
    }

    /// <summary>Refuses a handle that is no body's.</summary>
    /// <exception cref="ArgumentException">There is no such body.</exception>
    internal void CheckHandle(BodyHandle handle)
    {
        if (!BodyExists(handle))
            ThrowMissing(handle);
    }

    [DoesNotReturn]
    void ThrowMissing(BodyHandle handle)
    {
        world.CheckAlive();
        throw owners.Missing(handle, handle.Value, handle.Slot);
    }

    /// <summary>Refuses a change of values while a step reads or writes them.</summary>
    internal void CheckWritable(string operation) => world.CheckWritable(operation);

    /// <summary>As <see cref="HandleOwners.IsPlain"/>.</summary>
    internal bool HasPlainHandles
    {
        get => owners.IsPlain;
        set => owners.IsPlain = value;
    }

    void EnsureSlots(int count) => owners.EnsureSlots(count, new BodyMemoryLocation { SetIndex = -1 }, ref Locations, ref HandlePool, Pool);
}
