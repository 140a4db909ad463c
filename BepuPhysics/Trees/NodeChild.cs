using System.Numerics;
using System.Runtime.InteropServices;

namespace BepuPhysics.Trees;

/// <summary>One side of a <see cref="Node"/>: a box around a subtree, or around a single leaf.</summary>
[StructLayout(LayoutKind.Sequential)]
public struct NodeChild
{
    /// <summary>Lower corner of everything below this child.</summary>
    public Vector3 Min;
    /// <summary>Index of the child's node, or the bitwise complement of its leaf index when the child is a leaf.</summary>
    public int Index;
    /// <summary>Upper corner of everything below this child.</summary>
    public Vector3 Max;
    /// <summary>Number of leaves below this child: one for a leaf, zero for the missing side of a tree with a single leaf.</summary>
    public int LeafCount;
}
