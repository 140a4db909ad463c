using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

/// <summary>A tree in depth-first order, cut into subtrees of bounded size, which lie in one piece each, and the nodes above them.</summary>
unsafe struct TreeParts
{
    // Several for each thread, so that an unlucky one can leave work to the others; a smaller one costs less than to be claimed.
    const int PartsPerThread = 8;
    const int LeastLeafLimit = 128;

    /// <summary>Nodes of a subtree: a range.</summary>
    public readonly record struct Part(int Start, int End);

    /// <summary>The subtrees, in the order of their nodes.</summary>
    public QuickList<Part> Parts;

    /// <summary>Nodes that are in none of them, parents before their children.</summary>
    public QuickList<int> Tops;

    /// <summary>Cuts a tree of at least two leaves for a number of threads.</summary>
    public TreeParts(in Tree tree, int threadCount, BufferPool pool) : this(tree, threadCount, default, pool) { }

    /// <summary>Cuts a tree whose nodes are on their way into order, and places those above its parts.</summary>
    public TreeParts(in Tree tree, int threadCount, in NodeSort sort, BufferPool pool)
    {
        var leafLimit = tree.LeafCount / (PartsPerThread * threadCount);
        if (leafLimit < LeastLeafLimit)
            leafLimit = LeastLeafLimit;
        Parts = new QuickList<Part>(4 * PartsPerThread * threadCount, pool);
        Tops = new QuickList<int>(4 * PartsPerThread * threadCount, pool);
        var stack = stackalloc int[Tree.TraversalStackSize];
        var count = 1;
        stack[0] = 0;
        while (count > 0)
        {
            var node = stack[--count];
            Tops.Add(node, pool);
            if (sort.IsNeeded)
                sort.Place(node);
            // B first, so that A is the next to be taken.
            for (var slot = 2 * node + 1; slot >= 2 * node; --slot)
            {
                var child = tree.Children + slot;
                if (child->LeafCount > leafLimit)
                    stack[count++] = child->Index;
                else if (child->Index >= 0)
                    Parts.Add(new Part(child->Index, child->Index + child->LeafCount - 1), pool);
            }
        }
    }

    public void Dispose(BufferPool pool)
    {
        Parts.Dispose(pool);
        Tops.Dispose(pool);
    }
}
