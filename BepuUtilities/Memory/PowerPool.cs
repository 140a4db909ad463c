using System;
using System.Diagnostics;
using System.Globalization;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Text;

namespace BepuUtilities.Memory;

/// <summary>The blocks of one size of a <see cref="BufferPool"/>: memory from the system, cut into slots.</summary>
/// <remarks>
/// Slots [0, usedSlotCount) have been lent at least once; those of them that are free lie on a stack, so that what was returned
/// last, and is in the cache, is lent next. All bookkeeping grows with the memory, and is none of the garbage collector's: lending and returning
/// allocate nothing managed, whatever is lent for the first time.
/// </remarks>
sealed unsafe class PowerPool
{
    readonly BufferPool owner;
    readonly int allocationPower;
    readonly int slotShift;
    readonly int expectedSlotCount;
    // Addresses of the allocations, the stack of free slots, a bit for each slot that is lent; null while the pool holds no memory.
    nint* allocations;
    int* freeSlots;
    ulong* taken;
    int allocationCapacity, slotCapacity;
    // Types of the elements of lent slots, in builds with checks.
    Type?[] owners = [];
    int allocationCount;
    int usedSlotCount;
    int freeSlotCount;
    // Fewest free slots since the last trim: so many, from the bottom of the stack on, have not been lent since.
    int idleSlotCount;
    // Slots, lent before, whose memory went back to the system.
    int hollowSlotCount;
    // Trims that a slot has to be idle for, and those that there were since the last which gave memory back. What is needed again soon after that is kept
    // for twice as long from then on: a scene whose needs come and go takes nothing from the system any more after a while.
    int patience = 1, trimCount;
    const int MaximumPatience = 1 << 20;
    // Bytes that were asked for, and are kept.
    ulong reservedByteCount;

    /// <summary>Creates a pool that holds no memory yet.</summary>
    /// <param name="owner">The pool that it is a part of.</param>
    /// <param name="power">Exponent of the size of a slot in bytes.</param>
    /// <param name="allocationPower">Exponent of the number of bytes to ask the system for at a time; not less than the slot's.</param>
    /// <param name="expectedSlotCount">Number of slots for which bookkeeping is made with the first memory.</param>
    public PowerPool(BufferPool owner, int power, int allocationPower, int expectedSlotCount)
    {
        this.owner = owner;
        Power = power;
        this.allocationPower = allocationPower;
        slotShift = allocationPower - power;
        this.expectedSlotCount = expectedSlotCount;
    }

    /// <summary>Exponent of the size of a slot in bytes.</summary>
    public int Power { get; }

    /// <summary>Bytes held from the system.</summary>
    public ulong AllocatedByteCount => (ulong)(allocationCount - hollowSlotCount) << allocationPower;

    /// <summary>Number of slots that are lent.</summary>
    public int TakenCount => usedSlotCount - freeSlotCount - hollowSlotCount;

    /// <summary>Lends a slot.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public int Take(out byte* memory)
    {
        var slot = freeSlotCount > 0 ? TakeFree() : TakeUnused();
        taken[slot >> 6] |= 1UL << slot;
        memory = GetBlock(slot);
        return slot;
    }

    /// <summary>Whether a slot exists and is lent.</summary>
    public bool IsTaken(int slot) => (uint)slot < (uint)usedSlotCount && (taken[slot >> 6] & (1UL << slot)) != 0;

    /// <summary>Takes a slot back that is lent.</summary>
    public void Return(int slot)
    {
        Poison(GetBlock(slot), (nuint)1 << Power);
        taken[slot >> 6] &= ~(1UL << slot);
        freeSlots[freeSlotCount++] = slot;
    }

    /// <summary>Address of a slot that has been lent before.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public byte* GetBlock(int slot) => (byte*)allocations[slot >> slotShift] + ((nuint)(slot & ((1 << slotShift) - 1)) << Power);

    /// <summary>Asks the system for memory until at least so many bytes are held.</summary>
    public void EnsureCapacity(ulong byteCount)
    {
        reservedByteCount = Math.Max(reservedByteCount, byteCount);
        while (AllocatedByteCount < byteCount)
        {
            if (hollowSlotCount > 0)
                freeSlots[freeSlotCount++] = Refill();
            else
                Allocate();
        }
    }

    /// <summary>
    /// Gives memory back to the system that nobody has borrowed since the last call. Slots that share an allocation stay, and so does what was asked for.
    /// </summary>
    public void Trim()
    {
        if (++trimCount < patience)
            return;
        trimCount = 0;
        var kept = (int)((reservedByteCount + (1ul << allocationPower) - 1) >> allocationPower);
        var goneCount = Math.Min(idleSlotCount, allocationCount - hollowSlotCount - kept);
        if (slotShift == 0 && goneCount > 0)
        {
            for (int i = 0; i < goneCount; ++i)
            {
                ref var allocation = ref allocations[freeSlots[i]];
                SystemMemory.Empty((byte*)allocation, (nuint)1 << allocationPower);
                SystemMemory.Return((byte*)allocation);
                allocation = 0;
            }
            hollowSlotCount += goneCount;
            freeSlotCount -= goneCount;
            new ReadOnlySpan<int>(freeSlots + goneCount, freeSlotCount).CopyTo(new Span<int>(freeSlots, freeSlotCount));
        }
        idleSlotCount = freeSlotCount;
    }

    /// <summary>Gives the pages of slots that are not lent back to the system, but keeps the slots. Not of those that share an allocation.</summary>
    public void Empty()
    {
        if (slotShift != 0)
            return;
        for (int i = 0; i < freeSlotCount; ++i)
        {
            SystemMemory.Empty(GetBlock(freeSlots[i]), (nuint)1 << Power);
            Poison(GetBlock(freeSlots[i]), (nuint)1 << Power);
        }
    }

    /// <summary>Writes how many slots are lent, and the first ids.</summary>
    public void DescribeTaken(StringBuilder message)
    {
        const int listedCount = 8;
        message.Append(CultureInfo.InvariantCulture, $" {TakenCount} of {1UL << Power} bytes (ids");
        var listed = 0;
        for (int slot = 0; slot < usedSlotCount && listed < listedCount; ++slot)
        {
            if (IsTaken(slot))
            {
                message.Append(CultureInfo.InvariantCulture, $" {((Power - BufferPool.MinimumPower) << BufferPool.SlotBits) | slot}");
                if (slot < owners.Length && owners[slot] is { } owner)
                    message.Append(CultureInfo.InvariantCulture, $" of {owner.Name}");
                ++listed;
            }
        }
        message.Append(TakenCount > listed ? " ...);" : ");");
    }

    /// <summary>Notes the type of the elements of a lent slot.</summary>
    public void NoteOwner(int slot, Type elementType)
    {
        if (slot >= owners.Length)
            Array.Resize(ref owners, Math.Max(16, slot * 2));
        owners[slot] = elementType;
    }

    /// <summary>Gives all memory back to the system, lent or not.</summary>
    public void Clear()
    {
        for (int i = 0; i < allocationCount; ++i)
            SystemMemory.Return((byte*)allocations[i]);
        NativeMemory.Free(allocations);
        NativeMemory.Free(freeSlots);
        NativeMemory.Free(taken);
        allocations = null;
        freeSlots = null;
        taken = null;
        allocationCapacity = 0;
        slotCapacity = 0;
        allocationCount = 0;
        usedSlotCount = 0;
        freeSlotCount = 0;
        idleSlotCount = 0;
        hollowSlotCount = 0;
        reservedByteCount = 0;
        patience = 1;
        trimCount = 0;
    }

    int TakeFree()
    {
        if (--freeSlotCount < idleSlotCount)
            idleSlotCount = freeSlotCount;
        return freeSlots[freeSlotCount];
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    int TakeUnused()
    {
        if (hollowSlotCount > 0)
        {
            patience = Math.Min(patience * 2, MaximumPatience);
            return Refill();
        }
        if (usedSlotCount == allocationCount << slotShift)
            Allocate();
        return usedSlotCount++;
    }

    // Asks the system again for the memory of a slot that has none.
    int Refill()
    {
        var slot = new ReadOnlySpan<nint>(allocations, usedSlotCount).IndexOf(0);
        allocations[slot] = AskSystem();
        --hollowSlotCount;
        return slot;
    }

    void Allocate()
    {
        var slotCount = ((long)allocationCount + 1) << slotShift;
        if (slotCount > 1 << BufferPool.SlotBits)
            throw new InsufficientMemoryException($"A pool lends at most 2^{BufferPool.SlotBits} blocks of {1UL << Power} bytes.");
        // Bookkeeping first: should the system refuse the memory, nothing has changed but spare room.
        if (allocationCount == allocationCapacity)
        {
            var capacity = Math.Max(2 * allocationCapacity, Math.Max(1, expectedSlotCount >> slotShift));
            Grow(ref allocations, allocationCapacity, capacity);
            allocationCapacity = capacity;
        }
        if (slotCount > slotCapacity)
        {
            var capacity = (int)BitOperations.RoundUpToPowerOf2((uint)Math.Max(slotCount, expectedSlotCount));
            Grow(ref freeSlots, slotCapacity, capacity);
            Grow(ref taken, WordCount(slotCapacity), WordCount(capacity));
            slotCapacity = capacity;
        }
        allocations[allocationCount] = AskSystem();
        ++allocationCount;
    }

    static int WordCount(int slotCount) => (slotCount + 63) >> 6;

    // What is new is zero.
    static void Grow<T>(ref T* array, int count, int newCount) where T : unmanaged
    {
        array = (T*)NativeMemory.Realloc(array, (nuint)newCount * (nuint)sizeof(T));
        new Span<T>(array + count, newCount - count).Clear();
    }

    nint AskSystem()
    {
        var byteCount = (nuint)1 << allocationPower;
        var memory = SystemMemory.Take(byteCount);
        if (byteCount >= SystemMemory.LeastBlockSize)
            owner.NoteGrowth();
        Poison(memory, byteCount);
        return (nint)memory;
    }

    /// <summary>Fills memory that nobody may read with NaN and -1 in validating builds: who reads it all the same is found out.</summary>
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    static void Poison(byte* memory, nuint byteCount) => NativeMemory.Fill(memory, byteCount, 0xff);
}
