namespace BepuPhysics.Trees;

/// <summary>What a node must remember for changes of the tree and queries never read; kept apart so that nodes stay one cache
/// line.</summary>
public struct Metanode
{
    /// <summary>Twice the parent's index plus the side (0 for A, 1 for B) on which this node hangs; -1 for the root.</summary>
    public int ParentSlot;
    /// <summary>Edges on the longest way down to a leaf: one for a node of two leaves. At the root at most
    /// <see cref="Tree.MaximumHeight"/>.</summary>
    public int Height;

    /// <summary>Index of the parent node; negative for the root.</summary>
    public readonly int Parent => ParentSlot >> 1;
    /// <summary>Side of the parent on which this node hangs: 0 for A, 1 for B.</summary>
    public readonly int IndexInParent => ParentSlot & 1;
}
