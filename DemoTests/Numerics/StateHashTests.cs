using System;
using System.Collections.Generic;
using System.Linq;
using BepuUtilities.Diagnostics;
using Xunit;

namespace DemoTests.Numerics;

public class StateHashTests
{
    static ulong Hash(params ReadOnlySpan<byte> bytes)
    {
        var hash = new StateHash();
        hash.Add(bytes);
        return hash.Value;
    }

    [Fact]
    public void PiecesDoNotMatter()
    {
        var random = new Random(1);
        var bytes = new byte[300];
        random.NextBytes(bytes);
        for (int i = 0; i < 200; ++i)
        {
            var hash = new StateHash();
            for (int start = 0; start < bytes.Length;)
            {
                var count = Math.Min(random.Next(20), bytes.Length - start);
                hash.Add(bytes.AsSpan(start, count));
                start += count;
            }
            Assert.Equal(Hash(bytes), hash.Value);
        }
    }

    [Fact]
    public void EveryBitOrderAndLengthMatters()
    {
        var seen = new HashSet<ulong> { Hash() };
        for (int length = 1; length <= 40; ++length)
        {
            var bytes = new byte[length];
            Assert.True(seen.Add(Hash(bytes)));
            for (int bit = 0; bit < length * 8; ++bit)
            {
                bytes[bit / 8] ^= (byte)(1 << (bit % 8));
                Assert.True(seen.Add(Hash(bytes)));
                bytes[bit / 8] ^= (byte)(1 << (bit % 8));
            }
        }
        Assert.NotEqual(Hash(1, 2), Hash(2, 1));
        Assert.NotEqual(
            Hash([.. Enumerable.Repeat((byte)1, 8), .. Enumerable.Repeat((byte)2, 8)]),
            Hash([.. Enumerable.Repeat((byte)2, 8), .. Enumerable.Repeat((byte)1, 8)]));
    }

    [Fact]
    public void OneBitChangesHalfOfTheHash()
    {
        var random = new Random(2);
        var bytes = new byte[64];
        double flipped = 0;
        for (int i = 0; i < 2000; ++i)
        {
            random.NextBytes(bytes);
            var before = Hash(bytes);
            bytes[random.Next(64)] ^= (byte)(1 << random.Next(8));
            flipped += System.Numerics.BitOperations.PopCount(before ^ Hash(bytes));
        }
        Assert.InRange(flipped / 2000, 30, 34);
    }
}
