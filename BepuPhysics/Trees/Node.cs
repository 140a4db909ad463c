using System.Runtime.InteropServices;

namespace BepuPhysics.Trees;

/// <summary>An inner node of a <see cref="Tree"/>: two children and their boxes, one cache line.</summary>
[StructLayout(LayoutKind.Sequential)]
public struct Node
{
    /// <summary>First child. In depth-first order its node directly follows this one.</summary>
    public NodeChild A;
    /// <summary>Second child. In depth-first order its node follows the last node below <see cref="A"/>.</summary>
    public NodeChild B;
}
