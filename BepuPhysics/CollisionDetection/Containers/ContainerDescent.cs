using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Finds which children of two containers may touch, by going down both at once, in the frame of the first.</summary>
/// <remarks>
/// Of two nodes that overlap the one with more children below is opened. So all children of one are never tried against the other, unless
/// one of the two is a list. A node is opened anew for each it meets, and each two children meet once. Of a first container without nodes those children
/// are a list that are in the box of the other; where one of two has none it is the first.
/// The children of a list ask the tree of the other, each with a box in the tree's own frame: a tree is searched by a box in a tenth of the
/// time that it takes to bring the nodes on the way into the frame of the list.
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
    const int QuestionCapacity = 8;

    /// <summary>Whether children of A ask B.</summary>
    public static bool IsAsked => (TContainerA.IsList || !TContainerA.HasNodes) && !TContainerB.IsList;

    QuickList<NodePair> stack;
    Buffer<NodeChild> belowA, belowB;
    BufferPool pool;
    int parent;
    bool flipped;

    /// <summary>Finds the children of a pair.</summary>
    /// <param name="a">First container.</param>
    /// <param name="b">Second container.</param>
    /// <param name="placementB">Puts nodes of B into the frame of A.</param>
    /// <param name="placementA">Puts nodes of A into the frame of B; used where <see cref="IsAsked"/>.</param>
    /// <param name="parent">Index of the pair.</param>
    /// <param name="flipped">Whether the caller's A is <paramref name="b"/>.</param>
    /// <param name="shapes">Shapes that children may be.</param>
    /// <param name="found">Receives the children.</param>
    /// <param name="pool">Source of memory.</param>
    public static void Find(in TContainerA a, in TContainerB b, in NodePlacement placementB, in NodePlacement placementA, int parent, bool flipped,
        Shapes shapes, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var descent = new ContainerDescent<TContainerA, TContainerB> { pool = pool, parent = parent, flipped = flipped };
        var countA = TContainerA.HasNodes
            ? ContainerPlaces.Open(a, 0, shapes, ref descent.belowA, pool)
            : descent.ListNear(a, b, placementB, shapes);
        if (IsAsked)
            countA = descent.Ask(b, placementA, countA, shapes, ref found);
        if (countA > 0)
        {
            descent.stack = new(InitialCapacity, pool);
            descent.Descend(a, b, placementB, countA, shapes, ref found);
            descent.stack.Dispose(pool);
            pool.Return(ref descent.belowB);
        }
        pool.ReturnIfTaken(ref descent.belowA);
    }

    // Of a container without nodes, the children that are near the other one: they are a list.
    int ListNear(in TContainerA a, in TContainerB b, in NodePlacement placement, Shapes shapes)
    {
        Vector3 min = new(float.MaxValue), max = new(-float.MaxValue);
        for (int i = OpenB(b, 0, placement, shapes) - 1; i >= 0; --i)
        {
            min = Exact.Min(min, belowB[i].Min);
            max = Exact.Max(max, belowB[i].Max);
        }
        var count = min.X <= max.X ? ContainerReach.ListOverlaps(a, min, max, shapes, ref belowA, pool) : 0;
        pool.ReturnIfTaken(ref belowB);
        return count;
    }

    // What is made of children itself is left at the front of the list.
    int Ask(in TContainerB b, in NodePlacement placement, int countA, Shapes shapes, ref QuickList<FoundChild> found)
    {
        var near = new QuickList<int>(InitialCapacity, pool);
        var (left, count) = (0, 0);
        Span<ContainerQuestion> questions = stackalloc ContainerQuestion[TContainerB.AsksTogether ? QuestionCapacity : 0];
        Span<int> asking = stackalloc int[questions.Length];
        // It lies in a batch.
        var container = Unsafe.AsPointer(ref Unsafe.AsRef(in b));
        for (int i = 0; i < countA; ++i)
        {
            ref var child = ref belowA[i];
            if (child.Index >= 0)
            {
                belowA[left++] = child;
                continue;
            }
            var box = placement.Place(child);
            var outline = TContainerB.TakesOutlines ? placement.Outline(child) : default;
            if (TContainerB.AsksTogether)
            {
                asking[count] = ~child.Index;
                questions[count++] = new() { Container = container, Min = box.Min, Max = box.Max, Outline = outline };
                if (count == QuestionCapacity)
                    AskTogether(questions, asking, ref count, ref near, ref found);
                continue;
            }
            near.Count = 0;
            b.FindOverlaps(box.Min, box.Max, outline, shapes, null, ref near, pool);
            foreach (int other in near.AsSpan())
                Add(~child.Index, other, ref found);
        }
        AskTogether(questions[..count], asking, ref count, ref near, ref found);
        near.Dispose(pool);
        return left;
    }

    readonly void AskTogether(
        Span<ContainerQuestion> questions, Span<int> asking, ref int count, ref QuickList<int> near, ref QuickList<FoundChild> found)
    {
        if (count == 0)
            return;
        near.Count = 0;
        TContainerB.FindTogether(questions, ref near, pool);
        for (int i = 0, next = 0; i < count; ++i)
        {
            for (; next < questions[i].End; ++next)
                Add(asking[i], near[next], ref found);
        }
        count = 0;
    }

    readonly void Add(int childA, int childB, ref QuickList<FoundChild> found) =>
        found.Allocate(pool).Write(parent, flipped ? new(childB, childA) : new(childA, childB));

    void Descend(in TContainerA a, in TContainerB b, in NodePlacement placement, int countA, Shapes shapes, ref QuickList<FoundChild> found)
    {
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
            Add(~a.Index, ~b.Index, ref found);
        else
            stack.Add(new(a, b), pool);
    }
}
