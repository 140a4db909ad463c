using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Text;

namespace BepuUtilities.Memory;

/// <summary>
/// Lends blocks of unmanaged memory whose sizes are powers of two, aligned to 64 bytes at least. Memory comes from the system
/// in large pieces, is reused as soon as it is returned, and goes back to the system only by <see cref="Clear"/>.
/// Not thread safe: use a pool per worker, see <see cref="WorkerBufferPools"/>.
/// </summary>
/// <remarks>
/// There is a <see cref="PowerPool"/> for each power of two, which holds nothing until it is first needed. An id holds the power in its five high
/// bits below the sign and the slot within that power's pool in the others, so that an id alone suffices to return a block.
/// A bit per slot tells whether it is lent. That makes giving back twice, or to the wrong pool, an exception in release builds
/// too, instead of two owners of one block, which would only show as wrong physics much later.
/// </remarks>
public sealed unsafe class BufferPool : IUnmanagedMemoryPool, IDisposable
{
    /// <summary>Least alignment in bytes of every block: a cache line, and the widest vector.</summary>
    public const int Alignment = 64;

    // No block is smaller than a cache line: two owners on one line would slow each other down when they run on two threads.
    internal const int MinimumPower = 6;
    const int PowerBits = 5;
    internal const int SlotBits = 31 - PowerBits;
    internal const int MaximumPower = MinimumPower + (1 << PowerBits) - 1;
    // A buffer of bytes is as long as an int allows.
    const int MaximumBytePower = 30;

    readonly PowerPool[] pools = new PowerPool[MaximumPower - MinimumPower + 1];
    readonly List<IBufferPoolUser> users = [];
    uint trimCount;
    bool hasGrown;

    /// <summary>Creates a pool that holds no memory yet.</summary>
    /// <param name="minimumBlockAllocationSize">Least number of bytes to ask the system for at a time, rounded up to a power of two; in [1, 2^30].</param>
    /// <param name="expectedPooledResourceCount">Number of blocks of one size for which bookkeeping is made with the first of them.</param>
    public BufferPool(int minimumBlockAllocationSize = 131072, int expectedPooledResourceCount = 16)
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(minimumBlockAllocationSize);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(minimumBlockAllocationSize, 1 << MaximumBytePower);
        ArgumentOutOfRangeException.ThrowIfNegative(expectedPooledResourceCount);
        var blockPower = GetPower((ulong)minimumBlockAllocationSize);
        for (int i = 0; i < pools.Length; ++i)
            pools[i] = new PowerPool(this, i + MinimumPower, Math.Max(i + MinimumPower, blockPower), expectedPooledResourceCount);
    }

    /// <summary>Length in elements of the buffer that <see cref="TakeAtLeast{T}"/> yields for a least length.</summary>
    public static int GetCapacityForCount<T>(int count) where T : unmanaged =>
        GetCapacity<T>(GetPower(count, sizeof(T)));

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Take<T>(int count, out Buffer<T> buffer) where T : unmanaged
    {
        TakeBlock(GetPower(count, sizeof(T)), out var memory, out var id);
        NoteOwner(id, typeof(T));
        buffer = new Buffer<T>(memory, count, id);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void TakeAtLeast<T>(int count, out Buffer<T> buffer) where T : unmanaged
    {
        var power = GetPower(count, sizeof(T));
        TakeBlock(power, out var memory, out var id);
        NoteOwner(id, typeof(T));
        buffer = new Buffer<T>(memory, GetCapacity<T>(power), id);
    }

    /// <summary>Takes a block of a given power of two; the buffer spans 2^power bytes. Its contents are undefined.</summary>
    /// <param name="power">Exponent of the size in bytes, in [0, 30].</param>
    /// <param name="buffer">Buffer that was taken.</param>
    public void TakeForPower(int power, out Buffer<byte> buffer)
    {
        CheckPower(power);
        TakeBlock(Math.Max(power, MinimumPower), out var memory, out var id);
        NoteOwner(id, typeof(byte));
        buffer = new Buffer<byte>(memory, 1 << power, id);
    }

    /// <inheritdoc/>
    public void Return<T>(ref Buffer<T> buffer) where T : unmanaged
    {
        ReturnBlock(buffer.Id, buffer.Memory);
        buffer = default;
    }

    /// <inheritdoc/>
    public void ReturnUnsafely(int id) => FindOwner(id, out var slot).Return(slot);

    /// <inheritdoc/>
    public void Resize<T>(ref Buffer<T> buffer, int targetSize, int copyCount) where T : unmanaged =>
        Resize(ref buffer, targetSize, copyCount, exact: true);

    /// <inheritdoc/>
    public void ResizeToAtLeast<T>(ref Buffer<T> buffer, int targetSize, int copyCount) where T : unmanaged =>
        Resize(ref buffer, targetSize, copyCount, exact: false);

    int IUnmanagedMemoryPool.GetCapacityForCount<T>(int count) => GetCapacityForCount<T>(count);

    /// <summary>
    /// Asks the system, if need be, for so much memory that blocks of one power of two fill a number of bytes, lent ones included. It is kept until
    /// <see cref="Clear"/>.
    /// </summary>
    /// <param name="byteCount">Number of bytes.</param>
    /// <param name="power">Exponent of the size of a block, in [0, 30].</param>
    public void EnsureCapacityForPower(int byteCount, int power)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(byteCount);
        CheckPower(power);
        GetPool(Math.Max(power, MinimumPower)).EnsureCapacity((ulong)byteCount);
    }

    /// <summary>Bytes held for blocks of one power of two, lent or not; the greatest int when they are more than it can tell.</summary>
    /// <param name="power">Exponent of the size of a block, in [0, 30].</param>
    public int GetCapacityForPower(int power)
    {
        CheckPower(power);
        return (int)Math.Min(GetPool(Math.Max(power, MinimumPower)).AllocatedByteCount, int.MaxValue);
    }

    /// <summary>Bytes that this pool holds from the system, whether lent or not.</summary>
    public ulong GetTotalAllocatedByteCount()
    {
        ulong total = 0;
        foreach (var pool in pools)
            total += pool.AllocatedByteCount;
        return total;
    }

    /// <summary>Bytes of the blocks that are lent.</summary>
    public ulong GetTotalTakenByteCount()
    {
        ulong total = 0;
        foreach (var pool in pools)
            total += (ulong)pool.TakenCount << pool.Power;
        return total;
    }

    /// <summary>Requires that all that was lent has been given back.</summary>
    /// <exception cref="InvalidOperationException">Something is still lent; the message says how much of what size, and the first ids.</exception>
    public void AssertEmpty()
    {
        if (DescribeTaken() is { } message)
            throw new InvalidOperationException(message);
    }

    string? DescribeTaken()
    {
        StringBuilder? message = null;
        foreach (var pool in pools)
        {
            if (pool.TakenCount == 0)
                continue;
            message ??= new StringBuilder("Buffers were not returned to the pool:");
            pool.DescribeTaken(message);
        }
        return message?.ToString();
    }

    /// <summary>
    /// In builds with checks, hears of what was not returned to a pool that is cleared or disposed: how many blocks of what size, and of which
    /// type their elements are. Without subscribers the report goes to the standard error stream. Builds without checks report nothing.
    /// </summary>
    public static event Action<string>? LeakFound;

    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    void ReportLeaks()
    {
        if (DescribeTaken() is not { } message)
            return;
        if (LeakFound is { } report)
            report(message);
        else
            Console.Error.WriteLine(message);
    }

    // Only where leaks are reported: the types cost managed memory.
    [Conditional("DEBUG"), Conditional("PHYSICS_VALIDATE")]
    void NoteOwner(int id, Type elementType) => pools[id >> SlotBits].NoteOwner(id & ((1 << SlotBits) - 1), elementType);

    /// <summary>Tells somebody when the pool is cleared, until <see cref="RemoveUser"/>.</summary>
    public void AddUser(IBufferPoolUser user)
    {
        ArgumentNullException.ThrowIfNull(user);
        users.Add(user);
    }

    /// <summary>No longer tells somebody when the pool is cleared; does nothing if he was not told before.</summary>
    public void RemoveUser(IBufferPoolUser user) => users.Remove(user);

    /// <summary>
    /// Gives all memory back to the system. Buffers still lent must not be used any more; the pool itself may be. A simulation that has its memory
    /// here comes to its end.
    /// </summary>
    /// <exception cref="InvalidOperationException">A simulation that has memory here is busy; nothing was changed.</exception>
    public void Clear()
    {
        CheckNotBusy();
        foreach (var user in users)
            user.ForgetMemory();
        users.Clear();
        ReportLeaks();
        foreach (var pool in pools)
            pool.Clear();
    }

    /// <summary>
    /// Gives memory back to the system that nobody has borrowed since the last call: blocks that are lent stay, and so do those that were lent at
    /// some time in between, small ones, and what <see cref="EnsureCapacityForPower"/> has asked for.
    /// What is needed again after that is kept for twice as many calls from then on. A simulation calls this from time to time.
    /// </summary>
    public void Trim()
    {
        foreach (var pool in pools)
            pool.Trim();
        // What is borrowed again and again need not be written to as far as it once was. What is costs fresh pages, so ever more seldom.
        if (BitOperations.IsPow2(++trimCount))
            Empty(SystemMemory.LeastEmptiedSize);
    }

    /// <summary>Gives pages of large blocks that are not lent back to the system if it was asked for such since the last call, but keeps the blocks.</summary>
    /// <remarks>
    /// What a world that grows needs in one stage of a step lies idle in the next one, which needs as much of other sizes. A world that stays as it is asks
    /// for nothing, so nothing is done.
    /// </remarks>
    public void EmptyIfGrown()
    {
        // In large pages, which are soon fresh again where they are needed after all.
        if (hasGrown)
            Empty(SystemMemory.LeastBlockSize);
        hasGrown = false;
    }

    /// <summary>Takes down that the system was asked for a large block.</summary>
    internal void NoteGrowth() => hasGrown = true;

    void Empty(int leastSize)
    {
        for (int i = BitOperations.Log2((uint)leastSize) - MinimumPower; i < pools.Length; ++i)
            pools[i].Empty();
    }

    internal void CheckNotBusy()
    {
        foreach (var user in users)
            user.CheckNotBusy();
    }

    /// <summary>The same as <see cref="Clear"/>.</summary>
    public void Dispose() => Clear();

    void Resize<T>(ref Buffer<T> buffer, int targetSize, int copyCount, bool exact) where T : unmanaged
    {
        var memory = (byte*)buffer.Memory;
        var id = buffer.Id;
        var power = ResizeBlock(ref memory, ref id, buffer.Allocated ? buffer.Length : -1, targetSize, copyCount, sizeof(T));
        if (id != buffer.Id || memory != buffer.Memory)
            NoteOwner(id, typeof(T));
        buffer = new Buffer<T>(memory, exact ? targetSize : GetCapacity<T>(power), id);
    }

    // What does not depend on the type of the elements is compiled once, for all. The length is negative if nothing is taken yet.
    [MethodImpl(MethodImplOptions.NoInlining)]
    int ResizeBlock(ref byte* memory, ref int id, int length, int targetSize, int copyCount, int elementSize)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(targetSize);
        ArgumentOutOfRangeException.ThrowIfNegative(copyCount);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(copyCount, Math.Clamp(length, 0, targetSize));
        var power = GetPower(targetSize, elementSize);
        if (length < 0)
        {
            TakeBlock(power, out memory, out id);
            return power;
        }
        var owner = FindOwner(id, memory, out var slot);
        if (owner.Power == power && owner.GetBlock(slot) == memory)
            return power;
        TakeBlock(power, out var newMemory, out id);
        var bytes = (long)copyCount * elementSize;
        Buffer.MemoryCopy(memory, newMemory, bytes, bytes);
        owner.Return(slot);
        memory = newMemory;
        return power;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void TakeBlock(int power, out byte* memory, out int id)
    {
        var slot = GetPool(power).Take(out memory);
        id = ((power - MinimumPower) << SlotBits) | slot;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void ReturnBlock(int id, void* memory) => FindOwner(id, memory, out var slot).Return(slot);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    PowerPool GetPool(int power) => pools[power - MinimumPower];

    PowerPool FindOwner(int id, out int slot)
    {
        slot = id & ((1 << SlotBits) - 1);
        var pool = id < 0 ? null : pools[id >> SlotBits];
        if (pool == null || !pool.IsTaken(slot))
            ThrowNotTaken(id);
        return pool;
    }

    PowerPool FindOwner(int id, void* memory, out int slot)
    {
        var pool = FindOwner(id, out slot);
        // The address betrays a buffer of another pool that happens to bear an id that is lent here as well.
        if ((nuint)((byte*)memory - pool.GetBlock(slot)) >= (nuint)1 << pool.Power)
            ThrowForeign(id);
        return pool;
    }

    /// <summary>Exponent of the smallest block for a number of elements.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static int GetPower(int count, int elementSize)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(count);
        var power = GetPower((ulong)count * (ulong)elementSize);
        if (power > MaximumPower)
            ThrowTooLarge(count);
        return power;
    }

    static int GetPower(ulong byteCount) => byteCount <= 1UL << MinimumPower ? MinimumPower : BitOperations.Log2(byteCount - 1) + 1;

    static int GetCapacity<T>(int power) where T : unmanaged => (int)Math.Min((1UL << power) / (ulong)sizeof(T), int.MaxValue);

    static void CheckPower(int power)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(power);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(power, MaximumBytePower);
    }

    [DoesNotReturn]
    static void ThrowNotTaken(int id) => throw new InvalidOperationException(
        id < 0 ? $"A buffer with id {id} was not lent by a pool." : $"The buffer with id {id} is not lent: returned already, or taken from another pool.");

    [DoesNotReturn]
    static void ThrowForeign(int id) => throw new InvalidOperationException(
        $"The buffer with id {id} does not lie in this pool's block of that id: it was taken from another pool.");

    [DoesNotReturn]
    static void ThrowTooLarge(int count) => throw new ArgumentOutOfRangeException(
        nameof(count), count, $"A block holds at most 2^{MaximumPower} bytes.");
}
