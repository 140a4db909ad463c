using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

/// <summary>
/// A binary tree of axis-aligned boxes with a number for each leaf: finds which boxes overlap, and which a ray or a moving box meets.
/// </summary>
/// <remarks>
/// A node holds the boxes of its two children, so a tree of n leaves has n - 1 nodes (one, half filled, for a single leaf). Leaves are
/// numbered 0 to n - 1 without holes: a removal moves the last leaf into the hole and says so.
/// <para>
/// Order: after a build, and after <see cref="Refit(BufferPool)"/>, nodes lie in depth-first order. Then the subtree of node i with k
/// leaves is
/// exactly the nodes [i, i + k - 1), parents come before their children (a refit is one sweep from the end), and a part of the tree can be
/// rebuilt in place. Insertions and removals give up the order; nothing but speed depends on it.
/// </para>
/// <para>
/// Height: never above <see cref="MaximumHeight"/>, whatever is inserted in whatever order. Every builder falls back to halving when it
/// would dig deeper, rotations must not, and an insertion that does rebuilds the subtree that is too deep for its size. So traversals
/// need small stacks of fixed size, and no input can overflow them.
/// </para>
/// <para>
/// What a tree looks like depends on the calls that made it alone: not on threads, vector width or processor. Its boxes must be finite.
/// Queries only read and may run on many threads at once; changes need the tree for themselves.
/// </para>
/// The tree owns memory of the pool that it was given: use one pool for it throughout and call <see cref="Dispose"/> with that pool. The
/// tree is a value: a
/// copy shares its memory.
/// </remarks>
public unsafe partial struct Tree
{
    /// <summary>No way from the root to a leaf has more edges than this.</summary>
    public const int MaximumHeight = 64;

    /// <summary>No tree holds more leaves than this: the bound under which every overlong path has a subtree that halving makes
    /// lower.</summary>
    public const int MaximumLeafCount = 1 << 28;

    // A depth-first traversal leaves at most one entry behind at each level.
    internal const int TraversalStackSize = MaximumHeight + 2;

    /// <summary>Nodes of the tree; the first <see cref="NodeCount"/> are in use and number 0 is the root.</summary>
    public Buffer<Node> Nodes;
    /// <summary>Parents and heights of the nodes, in the same order.</summary>
    public Buffer<Metanode> Metanodes;
    /// <summary>Where each leaf hangs; the first <see cref="LeafCount"/> are in use.</summary>
    public Buffer<Leaf> Leaves;
    /// <summary>Number of leaves in the tree.</summary>
    public int LeafCount;

    bool isDepthFirst;

    // Where incremental refinement stands: part of the state, so that the same calls do the same everywhere.
    int refinementCursor;
    int refinementSlice;
    int slicesWithoutGain;
    int callsToSkip;

    /// <summary>Number of nodes in use.</summary>
    public readonly int NodeCount => LeafCount > 1 ? LeafCount - 1 : LeafCount;

    /// <summary>Whether the nodes lie in depth-first order.</summary>
    public readonly bool IsDepthFirst => isDepthFirst || LeafCount == 0;

    /// <summary>Edges on the longest way from the root to a leaf: zero for an empty tree, one for a tree of one or two leaves.</summary>
    public readonly int Height => LeafCount == 0 ? 0 : Metanodes[0].Height;

    internal readonly NodeChild* Children => (NodeChild*)Nodes.Memory;

    /// <summary>Creates an empty tree.</summary>
    /// <param name="pool">Pool that all memory of the tree comes from.</param>
    /// <param name="initialLeafCapacity">Leaves that fit before memory is taken again; at least one.</param>
    public Tree(BufferPool pool, int initialLeafCapacity = 4096) : this()
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (initialLeafCapacity is < 1 or > MaximumLeafCount)
            throw new ArgumentOutOfRangeException(nameof(initialLeafCapacity), initialLeafCapacity, $"Must be in [1, {MaximumLeafCount}].");
        Reallocate(initialLeafCapacity, pool);
    }

    /// <summary>Makes room for at least a number of leaves without changing the tree.</summary>
    public void EnsureCapacity(int leafCapacity, BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (leafCapacity is < 0 or > MaximumLeafCount)
            throw new ArgumentOutOfRangeException(nameof(leafCapacity), leafCapacity, $"Must be in [0, {MaximumLeafCount}].");
        if (leafCapacity > Leaves.Length)
            Reallocate(leafCapacity, pool);
    }

    /// <summary>Changes the room for leaves to about a number, never below what is in use.</summary>
    public void Resize(BufferPool pool, int targetLeafSlotCount)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (targetLeafSlotCount is < 0 or > MaximumLeafCount)
            throw new ArgumentOutOfRangeException(nameof(targetLeafSlotCount), targetLeafSlotCount, $"Must be in [0, {MaximumLeafCount}].");
        var capacity = targetLeafSlotCount > LeafCount ? targetLeafSlotCount : LeafCount;
        if (capacity < 1)
            capacity = 1;
        if (BufferPool.GetCapacityForCount<Leaf>(capacity) != Leaves.Length)
            Reallocate(capacity, pool);
    }

    void Reallocate(int leafCapacity, BufferPool pool)
    {
        leafCapacity = BufferPool.GetCapacityForCount<Leaf>(leafCapacity);
        // Leaves tell the room that there is: they grow last and shrink first, should the system refuse memory in between.
        var shrinks = leafCapacity < Leaves.Length;
        if (shrinks)
            Move(ref Leaves, leafCapacity, LeafCount, pool);
        Move(ref Nodes, leafCapacity, NodeCount, pool);
        Move(ref Metanodes, leafCapacity, NodeCount, pool);
        if (!shrinks)
            Move(ref Leaves, leafCapacity, LeafCount, pool);
    }

    static void Move<T>(ref Buffer<T> buffer, int capacity, int count, BufferPool pool) where T : unmanaged
    {
        pool.TakeAtLeast<T>(capacity, out var larger);
        if (buffer.Allocated)
        {
            buffer.CopyTo(0, larger, 0, count);
            pool.Return(ref buffer);
        }
        buffer = larger;
    }

    /// <summary>Removes all leaves and keeps the memory.</summary>
    public void Clear()
    {
        LeafCount = 0;
        refinementCursor = 0;
        refinementSlice = 0;
        slicesWithoutGain = 0;
        callsToSkip = 0;
    }

    /// <summary>Copies the tree as it is, so that it is refined, and visited, as if nothing had been.</summary>
    internal void CopyState(StateCopy copy)
    {
        var leafCount = copy.Value(LeafCount);
        if (copy.Restores)
        {
            // Nothing of what there is needs to be kept.
            LeafCount = 0;
            EnsureCapacity(leafCount, copy.Pool);
            LeafCount = leafCount;
        }
        copy.Value(ref isDepthFirst);
        copy.Value(ref refinementCursor);
        copy.Value(ref refinementSlice);
        copy.Value(ref slicesWithoutGain);
        copy.Value(ref callsToSkip);
        copy.CopyRows(Nodes, NodeCount);
        copy.CopyRows(Metanodes, NodeCount);
        copy.CopyRows(Leaves, LeafCount);
    }

    /// <summary>Gives the memory back to the pool that it came from and leaves an empty tree behind. Calling it twice does no
    /// harm.</summary>
    public void Dispose(BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (Nodes.Allocated)
        {
            pool.Return(ref Nodes);
            pool.Return(ref Metanodes);
            pool.Return(ref Leaves);
        }
        this = default;
    }

    /// <summary>Pointers to the box of a leaf, valid until the tree changes. After writing through them call a refit before the next
    /// query.</summary>
    public readonly void GetBoundsPointers(int leafIndex, out Vector3* minPointer, out Vector3* maxPointer)
    {
        RequireLeaf(leafIndex);
        var child = Children + Leaves[leafIndex].Slot;
        minPointer = &child->Min;
        maxPointer = &child->Max;
    }

    /// <summary>Box of a leaf.</summary>
    public readonly BoundingBox GetBounds(int leafIndex)
    {
        RequireLeaf(leafIndex);
        var child = Children + Leaves[leafIndex].Slot;
        return new BoundingBox(child->Min, child->Max);
    }

    /// <summary>Gives a leaf another box and fits all nodes above it; costs the depth of the leaf. Does not change the shape of the
    /// tree.</summary>
    public readonly void UpdateBounds(int leafIndex, Vector3 min, Vector3 max)
    {
        RequireLeaf(leafIndex);
        BoxMath.RequireBox(min, max);
        var slot = Leaves[leafIndex].Slot;
        BoxMath.StoreBox(Children + slot, min.AsVector128(), max.AsVector128());
        RefitAncestors(slot >> 1);
    }

    /// <inheritdoc cref="UpdateBounds(int, Vector3, Vector3)"/>
    public readonly void UpdateBounds(int leafIndex, BoundingBox bounds) => UpdateBounds(leafIndex, bounds.Min, bounds.Max);

    /// <summary>Index that a node's child holds for a leaf; its own inverse.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Encode(int index) => ~index;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void RequireLeaf(int leafIndex)
    {
        if ((uint)leafIndex >= (uint)LeafCount)
            ThrowLeaf(leafIndex, LeafCount);
    }

    static void ThrowLeaf(int leafIndex, int leafCount) =>
        throw new ArgumentOutOfRangeException(nameof(leafIndex), leafIndex, $"The tree has {leafCount} leaves.");

    /// <summary>Tells what hangs at a slot where it hangs.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void LinkToSlot(int slot)
    {
        var index = Children[slot].Index;
        if (index < 0)
            Leaves[~index].Slot = slot;
        else
            Metanodes[index].ParentSlot = slot;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly int HeightOf(NodeChild* child) => child->Index < 0 ? 0 : Metanodes[child->Index].Height;

    /// <summary>Height of a node from those of its children.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly int MeasureHeight(int nodeIndex)
    {
        var children = Children + 2 * nodeIndex;
        var a = HeightOf(children);
        var b = HeightOf(children + 1);
        return 1 + (a > b ? a : b);
    }

    /// <summary>Puts a single leaf into an empty tree.</summary>
    readonly void WriteSingleLeaf(NodeChild leaf)
    {
        ref var root = ref Nodes[0];
        root.A = leaf;
        // Inside out, so that no finite box, ray or sweep meets it; box queries, which may be infinite, look at the count first.
        root.B = new NodeChild
        {
            Min = new Vector3(float.MaxValue),
            Max = new Vector3(-float.MaxValue),
            Index = -1,
            LeafCount = 0
        };
        Metanodes[0] = new Metanode { ParentSlot = -1, Height = 1 };
        Leaves[~leaf.Index].Slot = 0;
        Check.That(leaf.Index < 0);
    }
}
