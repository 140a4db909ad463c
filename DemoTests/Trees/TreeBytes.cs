using System;
using System.Runtime.InteropServices;
using BepuPhysics.Trees;

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
}
