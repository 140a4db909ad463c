using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

/// <summary>The nodes of a tree on their way into depth-first order, from where they are to fresh memory.</summary>
/// <remarks>How many leaves are below a node says where all that is below it goes, so subtrees are placed independently of each other.</remarks>
unsafe struct NodeSort
{
    readonly Buffer<Leaf> leaves;
    Buffer<Node> nodes;
    Buffer<Metanode> metanodes;
    readonly Buffer<Node> sortedNodes;
    readonly Buffer<Metanode> sortedMetanodes;

    /// <summary>Takes memory for as many nodes as a tree has room for. The root may be placed.</summary>
    public NodeSort(in Tree tree, BufferPool pool)
    {
        leaves = tree.Leaves;
        nodes = tree.Nodes;
        metanodes = tree.Metanodes;
        pool.TakeAtLeast(nodes.Length, out sortedNodes);
        pool.TakeAtLeast(metanodes.Length, out sortedMetanodes);
        // The place of a node that is still to come holds, in its first index, which node goes there.
        ((NodeChild*)sortedNodes.Memory)->Index = 0;
        sortedMetanodes[0].ParentSlot = -1;
    }

    /// <summary>Whether there is anything to be placed.</summary>
    public readonly bool IsNeeded => nodes.Allocated;

    /// <summary>Places the nodes of a range that is a subtree, of which the first may be placed.</summary>
    public readonly void Place(int start, int end)
    {
        for (var node = start; node < end; ++node)
            Place(node);
    }

    /// <summary>Places a node whose parent has been placed.</summary>
    public readonly void Place(int node)
    {
        var target = (NodeChild*)sortedNodes.Memory;
        var source = target[2 * node].Index;
        sortedNodes[node] = nodes[source];
        sortedMetanodes[node].Height = metanodes[source].Height;
        var next = node + 1;
        for (var slot = 2 * node; slot < 2 * node + 2; ++slot)
        {
            var index = target[slot].Index;
            if (index < 0)
            {
                if (target[slot].LeafCount > 0)
                    leaves[~index].Slot = slot;
                continue;
            }
            target[slot].Index = next;
            target[2 * next].Index = index;
            sortedMetanodes[next].ParentSlot = slot;
            next += target[slot].LeafCount - 1;
        }
    }

    /// <summary>Gives a tree the memory that its nodes go to. What they come from stays until <see cref="End"/>.</summary>
    public readonly void HandOver(ref Tree tree)
    {
        tree.Nodes = sortedNodes;
        tree.Metanodes = sortedMetanodes;
    }

    /// <summary>Gives back the memory that the nodes come from, if there were any.</summary>
    public void End(BufferPool pool)
    {
        if (!IsNeeded)
            return;
        pool.Return(ref nodes);
        pool.Return(ref metanodes);
    }
}
