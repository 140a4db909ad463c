using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuUtilities;
using Xunit;

namespace DemoTests.Numerics;

/// <summary>Gathers and scatters against their definition, the lane loop.</summary>
public sealed unsafe class TransposeTests : IDisposable
{
    const int RowCount = 64;
    readonly float* rows = (float*)NativeMemory.AlignedAlloc(RowCount * 16 * sizeof(float), 64);
    readonly float* copy = (float*)NativeMemory.AlignedAlloc(RowCount * 16 * sizeof(float), 64);

    public void Dispose()
    {
        NativeMemory.AlignedFree(rows);
        NativeMemory.AlignedFree(copy);
    }

    static Span<float> AsSpan(float* memory) => new(memory, RowCount * 16);

    void Fill(WideSamples samples)
    {
        // Raw bits, NaN included: nothing may be lost on the way.
        foreach (ref var value in AsSpan(rows))
            value = BitConverter.Int32BitsToSingle(samples.Integer(int.MaxValue));
        AsSpan(rows).CopyTo(AsSpan(copy));
    }

    /// <summary>Distinct rows, with every kind of flag among the lanes.</summary>
    static Vector<int> Indices(WideSamples samples, int rowCount, bool withFlags)
    {
        Span<int> all = stackalloc int[rowCount];
        for (int i = 0; i < rowCount; ++i)
            all[i] = i;
        Span<int> lanes = stackalloc int[Vector<int>.Count];
        for (int lane = 0; lane < lanes.Length; ++lane)
        {
            var pick = lane + samples.Integer(rowCount - lane);
            (all[lane], all[pick]) = (all[pick], all[lane]);
            lanes[lane] = !withFlags ? all[lane] : samples.Integer(6) switch
            {
                0 => -1,
                1 => all[lane] | int.MinValue,
                2 => all[lane] | (1 << 30),
                _ => all[lane],
            };
        }
        return new(lanes);
    }

    static ReadOnlySpan<byte> Bits<T>(in T values) where T : unmanaged => MemoryMarshal.AsBytes(new ReadOnlySpan<T>(in values));

    [Fact]
    public void RowsAreZeroIfNoneOfTheirBitsIsSet()
    {
        var samples = new WideSamples(9);
        for (int sample = 0; sample < 200; ++sample)
        {
            AsSpan(rows).Clear();
            var indices = Indices(samples, RowCount, withFlags: true);
            Assert.True(Transpose.AreZero(rows, new RowOffsets(indices)));
            // One bit anywhere, the sign of a zero too.
            AsSpan(rows)[samples.Integer(RowCount * 8)] = BitConverter.Int32BitsToSingle(1 << samples.Integer(32));
            var gathered = Transpose.Gather(rows, 8, indices);
            Assert.Equal(Bits(gathered).IndexOfAnyExcept((byte)0) < 0, Transpose.AreZero(rows, new RowOffsets(indices)));
        }
    }

    [Theory]
    [InlineData(8), InlineData(16)]
    public void GatherIsTheLaneLoop(int stride)
    {
        var samples = new WideSamples(1);
        for (int i = 0; i < 2000; ++i)
        {
            Fill(samples);
            var indices = Indices(samples, RowCount * 16 / stride, withFlags: true);
            var fast = Transpose.Gather(rows, stride, indices);
            var loop = Transpose.GatherByLanes(rows, stride, indices);
            Assert.True(Bits(fast).SequenceEqual(Bits(loop)));
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                var row = indices[lane] < 0 ? 0 : indices[lane] & ~(1 << 30);
                for (int k = 0; k < Rows8.Count; ++k)
                    Assert.Equal(BitConverter.SingleToInt32Bits(rows[row * stride + k]), BitConverter.SingleToInt32Bits(fast[k][lane]));
            }
        }
    }

    [Theory]
    [InlineData(8), InlineData(16)]
    public void ScatterIsTheLaneLoop(int stride)
    {
        var samples = new WideSamples(2);
        for (int i = 0; i < 2000; ++i)
        {
            Fill(samples);
            var indices = Indices(samples, RowCount * 16 / stride, withFlags: i % 2 == 0);
            Unsafe.SkipInit(out Rows8 values);
            for (int k = 0; k < Rows8.Count; ++k)
                values[k] = samples.Numbers();
            Transpose.Scatter(values, rows, stride, indices);
            Transpose.ScatterByLanes(values, copy, stride, indices);
            Assert.True(MemoryMarshal.AsBytes(AsSpan(rows)).SequenceEqual(MemoryMarshal.AsBytes(AsSpan(copy))));
        }
    }

    [Fact]
    public void ManyRowsMoveByTheSameOffsets()
    {
        var samples = new WideSamples(5);
        for (int i = 0; i < 2000; ++i)
        {
            Fill(samples);
            var offsets = new RowOffsets(Indices(samples, RowCount / 2, withFlags: i % 2 == 0));
            var first = Transpose.Gather(rows + Rows8.Count, 16, offsets);
            var second = Transpose.Gather(rows + RowCount * 8, 8, offsets);
            Assert.True(Bits(first).SequenceEqual(Bits(Transpose.GatherByLanes(rows + Rows8.Count, 16, RowOffsets.Indices(offsets)))));
            Assert.True(Bits(second).SequenceEqual(Bits(Transpose.GatherByLanes(rows + RowCount * 8, 8, RowOffsets.Indices(offsets)))));
            Transpose.Scatter(second, rows + Rows8.Count, 16, offsets);
            Transpose.ScatterByLanes(second, copy + Rows8.Count, 16, RowOffsets.Indices(offsets));
            Assert.True(MemoryMarshal.AsBytes(AsSpan(rows)).SequenceEqual(MemoryMarshal.AsBytes(AsSpan(copy))));
        }
    }

    // Bodies in order: no lane is empty, and none is only read.
    [Theory]
    [InlineData(8), InlineData(16)]
    public void RunsAreTheLaneLoop(int stride)
    {
        var samples = new WideSamples(10);
        for (int i = 0; i < 1000; ++i)
        {
            Fill(samples);
            var first = samples.Integer(RowCount * 16 / stride - Vector<float>.Count + 1);
            var run = new RowRun(first);
            var indices = new Vector<int>(first) + Vector<int>.Indices;
            Assert.Equal(indices, RowRun.Indices(run));
            Assert.Equal(0u, RowRun.Unwritten(run));
            var gathered = Transpose.Gather(rows, stride, run);
            Assert.True(Bits(gathered).SequenceEqual(Bits(Transpose.GatherByLanes(rows, stride, indices))));
            var half = i % 2 * Transpose.FloatsPerHalf;
            Assert.True(Bits(Transpose.GatherHalf(rows + half, stride, run)).SequenceEqual(Bits(Transpose.GatherHalfByLanes(rows + half, stride, indices))));
            (gathered.R0, gathered.R5) = (gathered.R5, samples.Numbers());
            Transpose.Scatter(gathered, rows, stride, run);
            Transpose.ScatterByLanes(gathered, copy, stride, indices);
            Assert.True(MemoryMarshal.AsBytes(AsSpan(rows)).SequenceEqual(MemoryMarshal.AsBytes(AsSpan(copy))));
            if (stride == Rows8.Count)
                Assert.Equal(Transpose.AreZero(rows, new RowOffsets(indices)), Transpose.AreZero(rows, run));
        }
    }

    [Theory]
    [InlineData(8), InlineData(16), InlineData(24)]
    public void FarRowsDoNotOverflow(int stride)
    {
        foreach (var index in new[] { 0, 1, 1 << 26, RowOffsets.MaximumRowCount - 1 })
        {
            var offsets = new RowOffsets(new Vector<int>(index | 1 << 30));
            for (int lane = 0; lane < Vector<int>.Count; ++lane)
                Assert.Equal((long)index * stride * sizeof(float), (byte*)RowOffsets.Row(offsets, rows, stride, lane) - (byte*)rows);
        }
    }

    [Theory]
    [InlineData(8), InlineData(16)]
    public void HalvesAreTheLaneLoop(int stride)
    {
        var samples = new WideSamples(6);
        for (int i = 0; i < 2000; ++i)
        {
            Fill(samples);
            var indices = Indices(samples, RowCount * 16 / stride, withFlags: i % 2 == 0);
            var offsets = new RowOffsets(indices);
            var half = i / 2 % 2 * Transpose.FloatsPerHalf;
            var fast = Transpose.GatherHalf(rows + half, stride, offsets);
            var loop = Transpose.GatherHalfByLanes(rows + half, stride, indices);
            Assert.True(Bits(fast).SequenceEqual(Bits(loop)));
            var whole = Transpose.GatherByLanes(rows, stride, indices);
            Assert.Equal((whole[half], whole[half + 1], whole[half + 2], whole[half + 3]).ToString(), (fast.X, fast.Y, fast.Z, fast.W).ToString());
            Vector4Wide values = new(samples.Numbers(), samples.Numbers(), samples.Numbers(), samples.Numbers());
            Transpose.ScatterHalf(values, rows + half, stride, offsets);
            Transpose.ScatterHalfByLanes(values, copy + half, stride, indices);
            Assert.True(MemoryMarshal.AsBytes(AsSpan(rows)).SequenceEqual(MemoryMarshal.AsBytes(AsSpan(copy))));
        }
    }

    [Fact]
    public void ScatterUndoesGather()
    {
        var samples = new WideSamples(3);
        Fill(samples);
        for (int i = 0; i < 2000; ++i)
        {
            var indices = Indices(samples, RowCount, withFlags: true);
            Transpose.Scatter(Transpose.Gather(rows, 16, indices), rows, 16, indices);
        }
        Assert.True(MemoryMarshal.AsBytes(AsSpan(rows)).SequenceEqual(MemoryMarshal.AsBytes(AsSpan(copy))));
    }

    [Fact]
    public void FlaggedLanesWriteNothing()
    {
        var samples = new WideSamples(4);
        Fill(samples);
        foreach (var flag in new[] { -1, int.MinValue, 1 << 30, (1 << 30) | 5, int.MinValue | 7 })
            Transpose.Scatter(default, rows, 16, new Vector<int>(flag));
        Assert.True(MemoryMarshal.AsBytes(AsSpan(rows)).SequenceEqual(MemoryMarshal.AsBytes(AsSpan(copy))));
    }
}
