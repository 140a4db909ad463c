using System;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>
/// Blocks from a cache line to eight large pages, two of each. Whether the system lends large pages is its own affair, which no test can ask it everywhere:
/// what is tested is that blocks begin where such pages do on the system that has them, and are memory like any other.
/// </summary>
public unsafe class BlockSizeTests
{
    const int LeastPower = 6, MostPower = 24, AllocationPower = 17;
    const int Count = 2 * (MostPower - LeastPower + 1);

    [Fact]
    public void BlocksOfAllSizesCanBeWrittenToTheLastByte()
    {
        using var pool = new BufferPool(1 << AllocationPower);
        TakeWriteAndReturn(pool, 1);
        pool.Clear();
        Assert.Equal(0ul, pool.GetTotalAllocatedByteCount());
        TakeWriteAndReturn(pool, 100);
        // The first call hears that all was lent a moment ago.
        pool.Trim();
        pool.Trim();
        // A piece for each size below it, which blocks share, and nothing else.
        Assert.Equal((ulong)(AllocationPower - LeastPower) << AllocationPower, pool.GetTotalAllocatedByteCount());
        TakeWriteAndReturn(pool, 200);
    }

    static void TakeWriteAndReturn(BufferPool pool, int firstFill)
    {
        var buffers = new Buffer<byte>[Count];
        ulong takenByteCount = 0;
        for (int i = 0; i < Count; ++i)
        {
            var byteCount = 1 << (LeastPower + i / 2);
            pool.TakeForPower(LeastPower + i / 2, out buffers[i]);
            Assert.Equal(byteCount, buffers[i].Length);
            var alignment = OperatingSystem.IsLinux() && byteCount >= SystemMemory.LeastBlockSize ? SystemMemory.LargePageSize : BufferPool.Alignment;
            Assert.Equal(0u, (nuint)buffers[i].Memory % (nuint)alignment);
            buffers[i].AsSpan().Fill((byte)(firstFill + i));
            takenByteCount += (ulong)byteCount;
        }
        Assert.Equal(takenByteCount, pool.GetTotalTakenByteCount());
        for (int i = 0; i < Count; ++i)
        {
            Assert.Equal(-1, buffers[i].AsSpan().IndexOfAnyExcept((byte)(firstFill + i)));
            pool.Return(ref buffers[i]);
        }
        Assert.Equal(0ul, pool.GetTotalTakenByteCount());
        pool.AssertEmpty();
    }
}
