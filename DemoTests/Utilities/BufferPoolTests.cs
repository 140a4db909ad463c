using System;
using System.Collections.Generic;
using System.Numerics;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

public unsafe class BufferPoolTests
{
    [Fact]
    public void BlocksAreAlignedAndAsLongAsAsked()
    {
        using var pool = new BufferPool();
        for (int count = 0; count < 3000; count = count * 5 / 4 + 1)
        {
            pool.Take(count, out Buffer<int> exact);
            pool.TakeAtLeast(count, out Buffer<Vector3> roomy);
            Assert.Equal(count, exact.Length);
            Assert.Equal(BufferPool.GetCapacityForCount<Vector3>(count), roomy.Length);
            Assert.True(roomy.Length >= count);
            Assert.Equal(0u, (nuint)exact.Memory % 64);
            Assert.Equal(0u, (nuint)roomy.Memory % 64);
            pool.Return(ref exact);
            pool.Return(ref roomy);
            Assert.False(exact.Allocated);
        }
        for (int power = 0; power <= 20; ++power)
        {
            pool.TakeForPower(power, out var buffer);
            Assert.Equal(1 << power, buffer.Length);
            Assert.Equal(0u, (nuint)buffer.Memory % 64);
            pool.ReturnUnsafely(buffer.Id);
        }
        pool.AssertEmpty();
    }

    /// <summary>Each live buffer is filled with its own number: whenever two overlap, or a resize loses data, a fill is found damaged.</summary>
    [Fact]
    public void LentBuffersNeverOverlap() => OperationSequences.Check(4, 700, operations =>
    {
        using var pool = new BufferPool(1024, 1);
        List<Buffer<int>> live = [];
        List<int> fills = [];
        var nextFill = 0;
        foreach (var operation in operations)
        {
            var picked = live.Count == 0 ? -1 : operation.Value % live.Count;
            if (operation.Kind <= 1 || picked < 0)
            {
                pool.Take(operation.Value, out Buffer<int> taken);
                taken.AsSpan().Fill(++nextFill);
                live.Add(taken);
                fills.Add(nextFill);
                continue;
            }
            var buffer = live[picked];
            Assert.Equal(-1, buffer.AsSpan().IndexOfAnyExcept(fills[picked]));
            if (operation.Kind == 2)
            {
                pool.Return(ref buffer);
                live.RemoveAt(picked);
                fills.RemoveAt(picked);
            }
            else
            {
                var kept = Math.Min(buffer.Length, operation.Value);
                pool.Resize(ref buffer, operation.Value, kept);
                Assert.Equal(operation.Value, buffer.Length);
                Assert.Equal(-1, buffer.AsSpan()[..kept].IndexOfAnyExcept(fills[picked]));
                buffer.AsSpan().Fill(fills[picked]);
                live[picked] = buffer;
            }
        }
        for (int i = 0; i < live.Count; ++i)
        {
            var buffer = live[i];
            Assert.Equal(-1, buffer.AsSpan().IndexOfAnyExcept(fills[i]));
            buffer.Dispose(pool);
        }
        pool.AssertEmpty();
    });

    [Fact]
    public void ReturnedMemoryIsLentAgain()
    {
        using var pool = new BufferPool(4096);
        Assert.Equal(0ul, pool.GetTotalAllocatedByteCount());
        pool.Take(1000, out Buffer<byte> first);
        Assert.Equal(4096ul, pool.GetTotalAllocatedByteCount());
        var memory = first.Memory;
        pool.Return(ref first);
        for (int i = 0; i < 100; ++i)
        {
            pool.Take(1024 - i, out Buffer<byte> again);
            Assert.True(again.Memory == memory);
            pool.Return(ref again);
        }
        Assert.Equal(4096ul, pool.GetTotalAllocatedByteCount());
    }

    /// <summary>Of three large blocks two lie idle between two calls: these go back, and what is taken later is as good as new.</summary>
    [Fact]
    public void TrimmingGivesBackWhatNobodyBorrowed()
    {
        const ulong size = 65536;
        using var pool = new BufferPool(4096);
        var buffers = new Buffer<byte>[3];
        pool.Take(100, out Buffer<byte> small);
        foreach (ref var buffer in buffers.AsSpan())
            pool.Take((int)size, out buffer);
        Assert.Equal(4096 + 3 * size, pool.GetTotalAllocatedByteCount());
        Assert.Equal(128 + 3 * size, pool.GetTotalTakenByteCount());
        pool.Return(ref buffers[1]);
        pool.Return(ref buffers[2]);
        pool.Trim();
        // They were lent a moment ago.
        Assert.Equal(4096 + 3 * size, pool.GetTotalAllocatedByteCount());
        pool.Take((int)size, out buffers[1]);
        buffers[0].AsSpan().Fill(0x55);
        pool.Return(ref buffers[1]);
        pool.Trim();
        Assert.Equal(4096 + 2 * size, pool.GetTotalAllocatedByteCount());
        pool.Trim();
        Assert.Equal(4096 + size, pool.GetTotalAllocatedByteCount());
        Assert.Equal(128 + size, pool.GetTotalTakenByteCount());
        Assert.Equal(-1, buffers[0].AsSpan().IndexOfAnyExcept((byte)0x55));
        pool.Return(ref buffers[0]);
        pool.Return(ref small);
        pool.AssertEmpty();
        pool.Trim();
        pool.Trim();
        // Small blocks share an allocation, which stays.
        Assert.Equal(4096ul, pool.GetTotalAllocatedByteCount());
    }

    [Fact]
    public void WhatIsNeededAgainIsKeptForTwiceAsLong()
    {
        const int size = 65536;
        using var pool = new BufferPool(4096);
        var patience = 1;
        for (int need = 0; need < 5; ++need)
        {
            pool.Take(size, out Buffer<byte> buffer);
            buffer.AsSpan().Fill((byte)need);
            pool.Return(ref buffer);
            // The trims until it counts as lent no more, and as many again.
            var trims = 0;
            while (pool.GetTotalAllocatedByteCount() > 0)
            {
                pool.Trim();
                ++trims;
            }
            Assert.InRange(trims, patience + 1, 2 * patience);
            patience *= 2;
        }
    }

    [Fact]
    public void WhatWasAskedForIsNotTrimmed()
    {
        const int size = 65536;
        using var pool = new BufferPool(4096);
        pool.Take(size, out Buffer<byte> first);
        pool.Take(size, out Buffer<byte> second);
        pool.Return(ref first);
        pool.Return(ref second);
        pool.Trim();
        pool.Trim();
        Assert.Equal(0ul, pool.GetTotalAllocatedByteCount());
        pool.EnsureCapacityForPower(size + 1, 16);
        Assert.Equal(2 * size, pool.GetCapacityForPower(16));
        pool.Take(size, out first);
        pool.Take(size, out second);
        pool.Take(size, out Buffer<byte> third);
        foreach (var buffer in new[] { first, second, third })
            buffer.AsSpan().Fill(1);
        pool.Return(ref first);
        pool.Return(ref second);
        pool.Return(ref third);
        for (int i = 0; i < 3; ++i)
            pool.Trim();
        Assert.Equal(2 * (ulong)size, pool.GetTotalAllocatedByteCount());
        pool.Clear();
        Assert.Equal(0ul, pool.GetTotalAllocatedByteCount());
    }

    [Fact]
    public void AllocatedBytesAreExact()
    {
        using var pool = new BufferPool(4096);
        var buffers = new Buffer<byte>[9];
        for (int i = 0; i < buffers.Length; ++i)
        {
            pool.Take(1024, out buffers[i]);
            Assert.Equal((ulong)(4096 * (i / 4 + 1)), pool.GetTotalAllocatedByteCount());
        }
        // Larger than what is asked of the system at a time: a piece of its own.
        pool.Take(10_000, out Buffer<byte> large);
        Assert.Equal(3 * 4096ul + 16384, pool.GetTotalAllocatedByteCount());
        Assert.Equal(3 * 4096, pool.GetCapacityForPower(10));
        pool.EnsureCapacityForPower(3 * 4096 + 1, 10);
        Assert.Equal(4 * 4096, pool.GetCapacityForPower(10));
        pool.Return(ref large);
        foreach (ref var buffer in buffers.AsSpan())
            pool.Return(ref buffer);
        Assert.Equal(4 * 4096ul + 16384, pool.GetTotalAllocatedByteCount());
        pool.Clear();
        Assert.Equal(0ul, pool.GetTotalAllocatedByteCount());
        pool.Take(1, out Buffer<byte> after);
        pool.Return(ref after);
    }

    [Fact]
    public void ReturningTwiceIsRefusedByName()
    {
        using var pool = new BufferPool();
        pool.Take(100, out Buffer<float> buffer);
        pool.Take(100, out Buffer<float> other);
        var copy = buffer;
        pool.Return(ref buffer);
        var exception = Assert.Throws<InvalidOperationException>(() => pool.Return(ref copy));
        Assert.Contains($"id {copy.Id} ", exception.Message, StringComparison.Ordinal);
        Assert.True(copy.Allocated);
        Assert.Throws<InvalidOperationException>(() => pool.ReturnUnsafely(copy.Id));
        pool.Return(ref other);
        pool.AssertEmpty();
    }

    [Fact]
    public void ForeignBuffersAreRefused()
    {
        using var pool = new BufferPool();
        using var otherPool = new BufferPool();
        pool.Take(100, out Buffer<float> own);
        otherPool.Take(100, out Buffer<float> foreign);
        Assert.Equal(own.Id, foreign.Id);
        Assert.Throws<InvalidOperationException>(() => pool.Return(ref foreign));
        var local = 0;
        var unowned = new Buffer<int>(&local, 1);
        Assert.Throws<InvalidOperationException>(() => pool.Return(ref unowned));
        Assert.Throws<InvalidOperationException>(() => pool.Resize(ref unowned, 100, 1));
        Assert.True(unowned.Memory == &local);
        Buffer<int> none = default;
        Assert.Throws<InvalidOperationException>(() => pool.Return(ref none));
        Assert.Throws<InvalidOperationException>(() => pool.ReturnUnsafely(int.MaxValue));
        pool.Return(ref own);
        otherPool.Return(ref foreign);
        pool.AssertEmpty();
    }

    [Fact]
    public void BuffersFromBeforeClearAreRefused()
    {
        using var pool = new BufferPool();
        pool.Take(100, out Buffer<float> buffer);
        pool.Clear();
        pool.AssertEmpty();
        Assert.Throws<InvalidOperationException>(() => pool.Return(ref buffer));
    }

    [Fact]
    public void SlicesReturnTheWhole()
    {
        using var pool = new BufferPool();
        pool.Take(100, out Buffer<float> buffer);
        var slice = buffer.Slice(10, 20);
        pool.Return(ref slice);
        pool.AssertEmpty();
    }

    [Fact]
    public void AssertEmptySaysWhatIsLeft()
    {
        using var pool = new BufferPool();
        pool.Take(1000, out Buffer<byte> small);
        pool.Take(5000, out Buffer<byte> large);
        var message = Assert.Throws<InvalidOperationException>(pool.AssertEmpty).Message;
        // Builds with checks name the type of the elements behind the number.
        Assert.Matches($@"1 of 1024 bytes \(ids {small.Id}\b", message);
        Assert.Matches($@"1 of 8192 bytes \(ids {large.Id}\b", message);
    }

    [Fact]
    public void BadArgumentsAreRefused()
    {
        using var pool = new BufferPool();
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.Take(-1, out Buffer<int> _));
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.TakeAtLeast(int.MinValue, out Buffer<int> _));
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.TakeForPower(-1, out _));
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.TakeForPower(31, out _));
        Assert.Throws<ArgumentOutOfRangeException>(() => new BufferPool(0));
        pool.Take(10, out Buffer<int> buffer);
        var before = buffer;
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.Resize(ref buffer, -1, 0));
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.Resize(ref buffer, 20, 11));
        Assert.Throws<ArgumentOutOfRangeException>(() => pool.Resize(ref buffer, 5, 6));
        Assert.True(before.Memory == buffer.Memory && before.Length == buffer.Length && before.Id == buffer.Id);
        pool.Return(ref buffer);
        Assert.Equal(131072ul, pool.GetTotalAllocatedByteCount());
    }

    [Fact]
    public void NothingManagedIsAllocatedAfterWarmUp()
    {
        using var pool = new BufferPool(4096);
        // The first round makes the bookkeeping, and the methods.
        TakeAndReturn(pool);
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 10; ++i)
            TakeAndReturn(pool);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
    }

    [Fact]
    public void NothingManagedIsAllocatedAsAPoolGrows()
    {
        using (var compiled = new BufferPool(4096, 1))
            Grow(compiled);
        using var pool = new BufferPool(4096, 1);
        var before = GC.GetAllocatedBytesForCurrentThread();
        Grow(pool);
        var allocated = GC.GetAllocatedBytesForCurrentThread() - before;
        // Builds with checks note the types of what is lent.
        Assert.True(Check.IsEnabled || allocated == 0, $"{allocated} bytes");
        Assert.True(pool.GetTotalAllocatedByteCount() > 2000 * 64 + (1 << 23));

        // Two thousand blocks of one size, and one of each of the others.
        static void Grow(BufferPool pool)
        {
            for (int i = 0; i < 2000; ++i)
                pool.Take<byte>(64, out _);
            for (int power = 7; power <= 23; ++power)
                pool.Take<byte>(1 << power, out _);
        }
    }

    static void TakeAndReturn(BufferPool pool)
    {
        var buffers = stackalloc Buffer<int>[200];
        for (int i = 0; i < 200; ++i)
            pool.Take(i * 10, out buffers[i]);
        for (int i = 0; i < 200; ++i)
            pool.Resize(ref buffers[i], (200 - i) * 10, 0);
        for (int i = 0; i < 200; ++i)
            pool.Return(ref buffers[i]);
    }

    [Fact]
    public void EachWorkerHasItsOwnPool()
    {
        using var pools = new WorkerBufferPools(2, 4096);
        pools[0].Take(10, out Buffer<int> a);
        pools[1].Take(10, out Buffer<int> b);
        Assert.NotSame(pools[0], pools[1]);
        Assert.Equal(8192ul, pools.GetTotalAllocatedByteCount());
        Assert.Throws<InvalidOperationException>(pools.AssertEmpty);
        Assert.Throws<InvalidOperationException>(() => pools[0].Return(ref b));
        pools[0].Return(ref a);
        pools[1].Return(ref b);
        pools.AssertEmpty();
        pools.Resize(1);
        Assert.Equal(1, pools.WorkerCount);
        Assert.Equal(4096ul, pools.GetTotalAllocatedByteCount());
        pools.Clear();
        Assert.Equal(0ul, pools.GetTotalAllocatedByteCount());
        Assert.Throws<ArgumentOutOfRangeException>(() => new WorkerBufferPools(-1));
    }
}
