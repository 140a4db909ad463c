using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Finds which children of two containers may touch, by going down both at once, in the frame of the first.</summary>
/// <remarks>
/// Of two nodes that overlap the one with more children below is opened. So all children of one are never tried against the other, unless
/// one of the two is a list. A node is opened anew for each it meets, and each two children meet once.
/// </remarks>
unsafe ref struct ContainerDescent<TContainerA, TContainerB>
    where TContainerA : unmanaged, IContainer where TContainerB : unmanaged, IContainer
{
    /// <summary>Two nodes that overlap and are not both children; that of B where it is in the frame of A.</summary>
    struct NodePair(in NodeChild a, in NodeChild b)
    {
        public NodeChild A = a, B = b;
    }

    const int InitialCapacity = 64;

    QuickList<NodePair> stack;
    Buffer<NodeChild> belowA, belowB;
    BufferPool pool;
    int parent;
    bool flipped;

    public static void Find(in TContainerA a, in TContainerB b, in NodePlacement placement, int parent, bool flipped, Shapes shapes,
        ref QuickList<FoundChild> found, BufferPool pool)
    {
        var descent = new ContainerDescent<TContainerA, TContainerB> { pool = pool, parent = parent, flipped = flipped };
        descent.stack = new(InitialCapacity, pool);
        descent.Descend(a, b, placement, shapes, ref found);
        descent.stack.Dispose(pool);
        pool.Return(ref descent.belowA);
        pool.Return(ref descent.belowB);
    }

    void Descend(in TContainerA a, in TContainerB b, in NodePlacement placement, Shapes shapes, ref QuickList<FoundChild> found)
    {
        var countA = ContainerPlaces.Open(a, 0, shapes, ref belowA, pool);
        var countB = OpenB(b, 0, placement, shapes);
        for (int i = 0; i < countA; ++i)
        {
            for (int j = 0; j < countB; ++j)
                Test(belowA[i], belowB[j], ref found);
        }
        while (stack.Count > 0)
        {
            var pair = stack.Pop();
            if (pair.B.Index < 0 || (pair.A.Index >= 0 && pair.A.LeafCount >= pair.B.LeafCount))
            {
                countA = ContainerPlaces.Open(a, pair.A.Index, shapes, ref belowA, pool);
                for (int i = 0; i < countA; ++i)
                    Test(belowA[i], pair.B, ref found);
            }
            else
            {
                countB = OpenB(b, pair.B.Index, placement, shapes);
                for (int i = 0; i < countB; ++i)
                    Test(pair.A, belowB[i], ref found);
            }
        }
    }

    int OpenB(in TContainerB b, int node, in NodePlacement placement, Shapes shapes)
    {
        var count = ContainerPlaces.Open(b, node, shapes, ref belowB, pool);
        for (int i = 0; i < count; ++i)
            belowB[i] = placement.Place(belowB[i]);
        return count;
    }

    void Test(in NodeChild a, in NodeChild b, ref QuickList<FoundChild> found)
    {
        if (!BoundingBox.IntersectsUnsafe(a.Min, a.Max, b.Min, b.Max))
            return;
        if (a.Index < 0 && b.Index < 0)
            found.Add(new(parent, flipped ? new(~b.Index, ~a.Index) : new(~a.Index, ~b.Index)), pool);
        else
            stack.Add(new(a, b), pool);
    }
}
