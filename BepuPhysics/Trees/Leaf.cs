namespace BepuPhysics.Trees;

/// <summary>Where a leaf hangs. A leaf is known by its place in <see cref="Tree.Leaves"/>.</summary>
public struct Leaf
{
    /// <summary>Twice the index of the node that holds the leaf plus the side (0 for A, 1 for B).</summary>
    public int Slot;

    /// <summary>Index of the node that holds the leaf.</summary>
    public readonly int NodeIndex => Slot >> 1;
    /// <summary>Side of the node on which the leaf hangs: 0 for A, 1 for B.</summary>
    public readonly int ChildIndex => Slot & 1;
}
