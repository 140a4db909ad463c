using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>The convex children of a container whose boxes pass a test, those first that are nearest by it.</summary>
static unsafe class ContainerWalk
{
    /// <summary>A node or child that is still to be looked at, and how far away its box is.</summary>
    struct Pending
    {
        public int Index;
        public float T;
    }

    const int InitialCapacity = 64;

    /// <summary>Whether a convex part of A has its middle in a container B that is solid.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool IsInside<TContainer>(in SweepMotion motion, in ImpactBody part, in TContainer container)
        where TContainer : unmanaged, IContainer =>
        TContainer.MayBeSolid && container.IsSolid && !part.Core.IsPlane &&
        container.FindWayOut(motion.OrientationB.TurnBack(part.Arm - motion.OffsetB).ToSingle(), out _);

    /// <summary>Visits the children.</summary>
    /// <param name="container">The container.</param>
    /// <param name="visitor">Receives them.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="pool">Source of temporary memory.</param>
    public static void Visit<TContainer, TTest, TVisitor>(in TContainer container, ref TVisitor visitor, Shapes shapes, BufferPool pool)
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest
        where TVisitor : struct, IChildVisitor<TTest>, allows ref struct
    {
        if (!TContainer.HasNodes)
        {
            VisitByReach<TContainer, TTest, TVisitor>(container, ref visitor, shapes, pool);
            return;
        }
        var stack = new QuickList<Pending>(InitialCapacity, pool);
        var below = default(Buffer<NodeChild>);
        try
        {
            Visit<TContainer, TTest, TVisitor>(container, ref visitor, shapes, ref stack, ref below, pool);
        }
        finally
        {
            stack.Dispose(pool);
            pool.ReturnIfTaken(ref below);
        }
    }

    static void Visit<TContainer, TTest, TVisitor>(in TContainer container, ref TVisitor visitor, Shapes shapes,
        ref QuickList<Pending> stack, ref Buffer<NodeChild> below, BufferPool pool)
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest
        where TVisitor : struct, IChildVisitor<TTest>, allows ref struct
    {
        var count = ContainerPlaces.Open(container, 0, shapes, ref below, pool);
        var test = visitor.CreateTest(below, count);
        var scratch = stackalloc Vector4[IContainer.ScratchByteCount / 16];
        Push(test, below, count, visitor.Maximum, ref stack, pool);
        while (stack.Count > 0 && !visitor.IsDone)
        {
            var pending = stack.Pop();
            if (pending.T > visitor.Maximum)
                continue;
            if (pending.Index >= 0)
            {
                count = ContainerPlaces.Open(container, pending.Index, shapes, ref below, pool);
                Push(test, below, count, visitor.Maximum, ref stack, pool);
                continue;
            }
            VisitChild<TContainer, TTest, TVisitor>(container, ~pending.Index, ref visitor, shapes, scratch);
        }
    }

    // Of a container without nodes.
    static void VisitByReach<TContainer, TTest, TVisitor>(in TContainer container, ref TVisitor visitor, Shapes shapes, BufferPool pool)
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest
        where TVisitor : struct, IChildVisitor<TTest>, allows ref struct
    {
        NodeChild root;
        var count = container.Open(0, shapes, &root);
        var test = visitor.CreateTest(new(&root, 1), count);
        if (count == 0)
            return;
        var scratch = stackalloc Vector4[IContainer.ScratchByteCount / 16];
        var reached = new Reached<TContainer, TTest, TVisitor>(container, visitor, shapes, scratch);
        ContainerReach.Visit(container, test, root, ref reached, shapes, pool);
    }

    // A visitor is a copy of itself: what it finds is elsewhere.
    ref struct Reached<TContainer, TTest, TVisitor>(in TContainer container, in TVisitor visitor, Shapes shapes, void* scratch) : IReachVisitor
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest
        where TVisitor : struct, IChildVisitor<TTest>, allows ref struct
    {
        readonly ref readonly TContainer container = ref container;
        TVisitor visitor = visitor;
        readonly void* scratch = scratch;

        public readonly float Maximum => visitor.Maximum;

        public readonly bool IsDone => visitor.IsDone;

        public void Visit(int index) => VisitChild<TContainer, TTest, TVisitor>(container, index, ref visitor, shapes, scratch);
    }

    static void VisitChild<TContainer, TTest, TVisitor>(in TContainer container, int index, ref TVisitor visitor, Shapes shapes, void* scratch)
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest
        where TVisitor : struct, IChildVisitor<TTest>, allows ref struct
    {
        if (!visitor.Allows(index))
            return;
        container.GetChild(index, shapes, scratch, out var child);
        if (ImpactCore.Exists(child.TypeId, shapes))
            visitor.Visit(index, child);
    }

    // The nearest last, so that it is taken first.
    static void Push<TTest>(
        in TTest test, Buffer<NodeChild> below, int count, float maximum, ref QuickList<Pending> stack, BufferPool pool)
        where TTest : struct, IReachTest
    {
        var first = stack.Count;
        stack.EnsureCapacity(first + count, pool);
        for (int i = 0; i < count; ++i)
        {
            if (!test.Meets(below.Memory + i, maximum, out var t))
                continue;
            var place = stack.Count++;
            for (; place > first && stack[place - 1].T < t; --place)
                stack[place] = stack[place - 1];
            stack[place] = new() { Index = below[i].Index, T = t };
        }
    }
}
