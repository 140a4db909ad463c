using System;
using System.IO;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Pages of blocks that nobody needs are the system's again, while the pool keeps the block. Linux tells which pages a process has.</summary>
public unsafe class EmptiedBlockTests
{
    const int Size = 4 << 20;

    // In builds with checks what nobody may read is written to.
    static bool CanTell => File.Exists("/proc/self/pagemap") && !Check.IsEnabled;

    static long ResidentPages(byte* memory, long byteCount)
    {
        var pageSize = Environment.SystemPageSize;
        using var map = File.OpenRead("/proc/self/pagemap");
        var entries = new byte[byteCount / pageSize * sizeof(ulong)];
        map.Position = ((long)memory + pageSize - 1) / pageSize * sizeof(ulong);
        map.ReadExactly(entries);
        long count = 0;
        // The last page is the block's only where it begins with one.
        for (int i = 0; i + 1 < entries.Length / sizeof(ulong); ++i)
            count += entries[i * sizeof(ulong) + 7] >> 7;
        return count;
    }

    static void Fill(Buffer<byte> buffer, byte value)
    {
        buffer.AsSpan().Fill(value);
        Assert.True(!CanTell || ResidentPages(buffer.Memory, buffer.Length) >= buffer.Length / Environment.SystemPageSize - 1);
    }

    [Fact]
    public void WhatIsBorrowedAgainAndAgainKeepsNoPagesAtCallsThatGetSeldom()
    {
        using var pool = new BufferPool();
        pool.Take(Size, out Buffer<byte> lent);
        Fill(lent, 7);
        for (int call = 1; call <= 16; ++call)
        {
            pool.Take(Size, out Buffer<byte> buffer);
            Fill(buffer, (byte)call);
            var memory = buffer.Memory;
            pool.Return(ref buffer);
            pool.Trim();
            Assert.Equal(2ul * Size, pool.GetTotalAllocatedByteCount());
            if (CanTell)
                Assert.Equal((call & call - 1) == 0, ResidentPages(memory, Size) == 0);
        }
        Assert.Equal(-1, lent.AsSpan().IndexOfAnyExcept((byte)7));
        pool.Return(ref lent);
    }

    [Fact]
    public void OnlyAPoolThatHasGrownIsEmptied()
    {
        const int size = SystemMemory.LeastBlockSize;
        using var pool = new BufferPool();
        pool.Take(size, out Buffer<byte> lent);
        for (int i = 0; i < 3; ++i)
        {
            pool.Take(size, out Buffer<byte> buffer);
            Fill(buffer, 1);
            var memory = buffer.Memory;
            pool.Return(ref buffer);
            pool.EmptyIfGrown();
            if (CanTell)
                Assert.Equal(i == 0, ResidentPages(memory, size) == 0);
        }
        Fill(lent, 9);
        pool.Take(2 * size, out Buffer<byte> larger);
        pool.EmptyIfGrown();
        Assert.Equal(-1, lent.AsSpan().IndexOfAnyExcept((byte)9));
        pool.Return(ref larger);
        pool.Return(ref lent);
        pool.AssertEmpty();
    }

    /// <summary>A C library keeps what lies between other blocks, and maps no more by itself what was given back once.</summary>
    [Fact]
    public void WhatGoesBackIsNotResidentWhereverItLies()
    {
        const int count = 32, size = 1 << 19;
        using var pool = new BufferPool();
        var buffers = new Buffer<byte>[count];
        for (int round = 0; round < 2; ++round)
        {
            foreach (ref var buffer in buffers.AsSpan())
            {
                pool.Take(size, out buffer);
                Fill(buffer, 3);
            }
            if (round == 0)
                pool.Clear();
        }
        var gone = new nint[count / 2];
        for (int i = 0; i < gone.Length; ++i)
        {
            gone[i] = (nint)buffers[2 * i].Memory;
            pool.Return(ref buffers[2 * i]);
        }
        pool.Trim();
        pool.Trim();
        Assert.Equal((ulong)size * count / 2, pool.GetTotalAllocatedByteCount());
        // What other tests ask the library for may lie there by now.
        long resident = 0;
        foreach (var memory in gone)
            resident += CanTell ? ResidentPages((byte*)memory, size) : 0;
        Assert.InRange(resident, 0, (long)gone.Length * size / Environment.SystemPageSize / 4);
        for (int i = 1; i < count; i += 2)
        {
            Assert.Equal(-1, buffers[i].AsSpan().IndexOfAnyExcept((byte)3));
            pool.Return(ref buffers[i]);
        }
    }
}
