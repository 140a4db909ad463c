using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

public unsafe class BufferTests
{
    [Fact]
    public void SlicesLookAtTheSameMemory()
    {
        using var pool = new BufferPool();
        var buffer = Numbered(pool, 10);
        buffer.Slice(3, 4, out var middle);
        Assert.Equal(4, middle.Length);
        Assert.Equal(buffer.Id, middle.Id);
        middle[1] = 44;
        Assert.Equal(44, buffer[4]);
        Assert.Equal(44, buffer[4u]);
        Assert.True(buffer.Slice(5).Memory == buffer.Memory);
        Assert.True(buffer.GetPointer(7) == buffer.Memory + 7);
        buffer.Slice(0, 0, out var empty);
        Assert.Equal(0, empty.Length);
        buffer.Dispose(pool);
    }

    [Fact]
    public void CastsKeepTheBytes()
    {
        using var pool = new BufferPool();
        var buffer = Numbered(pool, 7);
        var wide = buffer.As<long>();
        Assert.Equal(3, wide.Length);
        Assert.Equal(0 | (1L << 32), wide[0]);
        Assert.Equal(28, buffer.As<byte>().Length);
        buffer.Dispose(pool);
    }

    [Fact]
    public void CopiesMayOverlap()
    {
        using var pool = new BufferPool();
        var buffer = Numbered(pool, 10);
        buffer.CopyTo(0, buffer, 2, 8);
        Assert.Equal([0, 1, 0, 1, 2, 3, 4, 5, 6, 7], buffer.AsSpan().ToArray());
        buffer.CopyFrom(buffer, 2, 0, 8);
        Assert.Equal([0, 1, 2, 3, 4, 5, 6, 7, 6, 7], buffer.AsSpan().ToArray());
        var array = new int[4];
        buffer.CopyTo(4, array, 1, 3);
        Assert.Equal([0, 4, 5, 6], array);
        buffer.CopyFrom(array, 1, 0, 2);
        Assert.Equal([4, 5, 2], buffer.AsSpan()[..3].ToArray());
        buffer.Clear(1, 2);
        Assert.Equal([4, 0, 0, 3], buffer.AsSpan()[..4].ToArray());
        buffer.Dispose(pool);
    }

    [Theory]
    [InlineData(-1, 1)]
    [InlineData(0, 11)]
    [InlineData(10, 1)]
    [InlineData(5, -1)]
    [InlineData(int.MaxValue, int.MaxValue)]
    public void RangesOutsideAreRefused(int start, int count)
    {
        using var pool = new BufferPool();
        var buffer = Numbered(pool, 10);
        var target = Numbered(pool, 20);
        Assert.Throws<ArgumentOutOfRangeException>(() => buffer.Clear(start, count));
        Assert.Throws<ArgumentOutOfRangeException>(() => buffer.CopyTo(start, target, 0, count));
        Assert.Throws<ArgumentOutOfRangeException>(() => buffer.CopyFrom(target, 0, start, count));
        Assert.Throws<ArgumentOutOfRangeException>(() => buffer.IndexOf(3, start, count));
        Assert.Equal([0, 1, 2, 3, 4, 5, 6, 7, 8, 9], buffer.AsSpan().ToArray());
        buffer.Dispose(pool);
        target.Dispose(pool);
    }

    [Fact]
    public void SearchesFindTheFirst()
    {
        using var pool = new BufferPool();
        var buffer = Numbered(pool, 10);
        buffer[8] = 3;
        Assert.Equal(3, buffer.IndexOf(3, 0, 10));
        Assert.Equal(8, buffer.IndexOf(3, 4, 6));
        Assert.Equal(-1, buffer.IndexOf(3, 4, 4));
        var above = new Above { Limit = 5 };
        Assert.Equal(6, buffer.IndexOf(ref above, 2, 8));
        Assert.Equal(-1, buffer.IndexOf(ref above, 0, 5));
        buffer.Dispose(pool);
    }

    static Buffer<int> Numbered(BufferPool pool, int count)
    {
        var buffer = new Buffer<int>(count, pool);
        for (int i = 0; i < count; ++i)
            buffer[i] = i;
        return buffer;
    }

    struct Above : IPredicate<int>
    {
        public int Limit;
        public readonly bool Matches(ref int item) => item > Limit;
    }
}
