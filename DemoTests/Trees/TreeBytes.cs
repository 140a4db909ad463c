using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using BepuPhysics.Trees;
using Xunit;

namespace DemoTests.Trees;

static unsafe class TreeBytes
{
    /// <summary>All that a tree consists of, to the bit.</summary>
    public static byte[] Of(in Tree tree) =>
    [
        .. MemoryMarshal.AsBytes(new ReadOnlySpan<Node>(tree.Nodes.Memory, tree.NodeCount)),
        .. MemoryMarshal.AsBytes(new ReadOnlySpan<Metanode>(tree.Metanodes.Memory, tree.NodeCount)),
        .. MemoryMarshal.AsBytes(new ReadOnlySpan<Leaf>(tree.Leaves.Memory, tree.LeafCount))
    ];

    /// <summary>Requires the same trees, step by step.</summary>
    // Lists of arrays are compared byte for byte as objects by the library for tests, which takes longer than all that makes them.
    public static void AssertSame(List<byte[]> expected, List<byte[]> actual)
    {
        Assert.Equal(expected.Count, actual.Count);
        for (int i = 0; i < expected.Count; ++i)
            Assert.True(expected[i].AsSpan().SequenceEqual(actual[i]), $"The trees differ after step {i}.");
    }
}
