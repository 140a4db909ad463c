namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>
    /// Removes a leaf; the last leaf takes over its index. Costs the depth of the leaf.
    /// </summary>
    /// <returns>Former index of the leaf that now has the index <paramref name="leafIndex"/>, or -1 when no leaf moved.</returns>
    public int RemoveAt(int leafIndex)
    {
        RequireLeaf(leafIndex);
        var slot = Leaves[leafIndex].Slot;
        var oldNodeCount = NodeCount;
        --LeafCount;
        if (LeafCount > 0)
            Unhook(slot, oldNodeCount - 1);

        // Leaves stay dense.
        if (leafIndex == LeafCount)
            return -1;
        var moved = Leaves[LeafCount].Slot;
        Children[moved].Index = ~leafIndex;
        Leaves[leafIndex].Slot = moved;
        return LeafCount;
    }

    /// <summary>Takes a leaf's node out of the tree: the sibling moves up into its place.</summary>
    void Unhook(int slot, int lastNode)
    {
        var children = Children;
        var node = slot >> 1;
        var sibling = slot ^ 1;
        var parentSlot = Metanodes[node].ParentSlot;
        if (parentSlot < 0)
        {
            if (children[sibling].Index < 0)
            {
                WriteSingleLeaf(children[sibling]);
                isDepthFirst = true;
                return;
            }
            // The root must stay at zero: the sibling's node moves there and leaves its own place free.
            node = children[sibling].Index;
            Nodes[0] = Nodes[node];
            Metanodes[0].Height = Metanodes[node].Height;
            LinkToSlot(0);
            LinkToSlot(1);
        }
        else
        {
            children[parentSlot] = children[sibling];
            LinkToSlot(parentSlot);
            ShrinkAncestors(parentSlot >> 1);
        }
        // Only a pair at the very end can go without a gap in the order, and that is not worth a case of its own.
        isDepthFirst = false;
        MoveNode(lastNode, node);
    }

    /// <summary>Fits boxes, counts and heights from a node up to the root.</summary>
    readonly void ShrinkAncestors(int node)
    {
        while (true)
        {
            Metanodes[node].Height = MeasureHeight(node);
            var slot = Metanodes[node].ParentSlot;
            if (slot < 0)
                return;
            FitSlotToNode(node);
            node = slot >> 1;
        }
    }

    readonly void MoveNode(int from, int to)
    {
        if (from == to)
            return;
        Nodes[to] = Nodes[from];
        Metanodes[to] = Metanodes[from];
        Children[Metanodes[to].ParentSlot].Index = to;
        LinkToSlot(2 * to);
        LinkToSlot(2 * to + 1);
    }
}
