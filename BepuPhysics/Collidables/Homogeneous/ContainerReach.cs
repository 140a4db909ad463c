using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>What is done with the children of a container without nodes, near ones first.</summary>
interface IReachVisitor
{
    /// <summary>What is farther away is of no interest.</summary>
    float Maximum { get; }

    /// <summary>Whether nothing more is of interest.</summary>
    bool IsDone { get; }

    /// <summary>Receives a child whose box is of interest.</summary>
    void Visit(int index);
}

/// <summary>The children of a container without nodes that are near something.</summary>
/// <remarks>
/// It is asked for what is near, and then for what is farther: a bit of the way is about as long as a few children, or as what asks. So a long way
/// through a large container is no large box.
/// </remarks>
static unsafe class ContainerReach
{
    struct Pending
    {
        public int Index;
        public float T;
    }

    const int InitialCapacity = 64;
    const float LeastGrowth = 1.001f;

    /// <summary>Lists children of a container without nodes.</summary>
    /// <param name="container">The container.</param>
    /// <param name="min">Lower corner of the box that they overlap, in the container's frame.</param>
    /// <param name="max">Its upper corner.</param>
    /// <param name="shapes">Shapes that children may be.</param>
    /// <param name="below">Receives the children and their boxes, as nodes below a root; is taken from the pool, and made larger, as it needs to be.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Number of children.</returns>
    public static int ListOverlaps<TContainer>(in TContainer container, Vector3 min, Vector3 max, Shapes shapes, ref Buffer<NodeChild> below, BufferPool pool)
        where TContainer : unmanaged, IContainer
    {
        var found = new QuickList<int>(InitialCapacity, pool);
        // What the game's own code throws leaves no memory behind.
        try
        {
            container.FindOverlaps(min, max, default, shapes, null, ref found, pool);
            if (below.Length < found.Count)
                pool.ResizeToAtLeast(ref below, found.Count, 0);
            var scratch = stackalloc Vector4[IContainer.ScratchByteCount / 16];
            for (int i = 0; i < found.Count; ++i)
            {
                container.GetChild(found[i], shapes, scratch, out var child);
                TContainer.ComputeChildBounds(child, out var least, out var greatest);
                below[i] = new() { Min = child.Pose.Position + least, Max = child.Pose.Position + greatest, Index = ~found[i], LeafCount = 1 };
            }
            return found.Count;
        }
        finally
        {
            found.Dispose(pool);
        }
    }

    /// <summary>Visits the children whose boxes pass a test.</summary>
    /// <param name="container">The container.</param>
    /// <param name="test">The test.</param>
    /// <param name="root">Box around all children.</param>
    /// <param name="visitor">Receives them.</param>
    /// <param name="shapes">Shapes that children may be.</param>
    /// <param name="pool">Source of temporary memory.</param>
    public static void Visit<TContainer, TTest, TVisitor>(
        in TContainer container, in TTest test, NodeChild root, ref TVisitor visitor, Shapes shapes, BufferPool pool)
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest where TVisitor : struct, IReachVisitor, allows ref struct
    {
        if (!test.Meets(&root, visitor.Maximum, out var t))
            return;
        var below = default(Buffer<NodeChild>);
        var found = new QuickList<Pending>(InitialCapacity, pool);
        try
        {
            Visit(container, test, root, MathHelper.Max(t, 0), ref visitor, shapes, ref found, ref below, pool);
        }
        finally
        {
            found.Dispose(pool);
            pool.ReturnIfTaken(ref below);
        }
    }

    static void Visit<TContainer, TTest, TVisitor>(in TContainer container, in TTest test, in NodeChild root, float to, ref TVisitor visitor, Shapes shapes,
        ref QuickList<Pending> found, ref Buffer<NodeChild> below, BufferPool pool)
        where TContainer : unmanaged, IContainer where TTest : struct, IReachTest where TVisitor : struct, IReachVisitor, allows ref struct
    {
        var step = test.Farther(MathHelper.Max(test.Extent, 2 * ChildExtent(root)));
        // What is met at once may be so at a time before zero.
        for (var from = float.NegativeInfinity; ; from = to)
        {
            // Far away, a bit may be less than what floats tell apart.
            to = MathHelper.Min(MathHelper.Max(to + step, to * LeastGrowth), visitor.Maximum);
            step *= TTest.Growth;
            test.Reach(MathHelper.Max(from, 0), to, out var min, out var max);
            // Nothing is left where the box is around all that there is.
            if (Exact.Min(min, root.Min) == min && Exact.Max(max, root.Max) == max)
                to = visitor.Maximum;
            min = Exact.Max(min, root.Min);
            max = Exact.Min(max, root.Max);
            var isInReach = min == Exact.Min(min, max);
            // The first bit is where the box around all is met: what leaves it does not come back.
            if (!isInReach && from >= 0)
                return;
            var count = isInReach ? ListOverlaps(container, min, max, shapes, ref below, pool) : 0;
            Collect(test, below, count, from, to, ref found, pool);
            for (int i = 0; i < found.Count && !visitor.IsDone && found[i].T <= visitor.Maximum; ++i)
                visitor.Visit(found[i].Index);
            if (visitor.IsDone || !(to < visitor.Maximum))
                return;
        }
    }

    // As long as a child at least, where children fill their box.
    static float ChildExtent(in NodeChild root)
    {
        var extent = root.Max - root.Min;
        return MathHelper.Max(extent.X, MathHelper.Max(extent.Y, extent.Z)) / MathF.Sqrt(MathF.Sqrt(root.LeafCount));
    }

    // Those between two bounds, the nearest first.
    static void Collect<TTest>(in TTest test, Buffer<NodeChild> below, int count, float from, float to, ref QuickList<Pending> found, BufferPool pool)
        where TTest : struct, IReachTest
    {
        found.Count = 0;
        for (int i = 0; i < count; ++i)
        {
            if (test.Meets(below.Memory + i, to, out var t) && t > from)
                found.Add(new() { Index = ~below[i].Index, T = t }, pool);
        }
        var order = default(NearestFirst);
        QuickSort.Sort(found.AsSpan(), ref order);
    }

    struct NearestFirst : IComparerRef<Pending>
    {
        public readonly int Compare(ref Pending a, ref Pending b) => a.T < b.T ? -1 : a.T > b.T ? 1 : a.Index.CompareTo(b.Index);
    }
}
