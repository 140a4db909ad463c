using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A shape made of many shapes, with a tree over them.</summary>
/// <remarks>
/// <inheritdoc cref="Compound" path="/remarks/para"/>
/// <para>Leaves of the tree have the numbers of the children; whoever changes a child's shape or pose
/// gives its leaf new bounds.</para>
/// </remarks>
public unsafe struct BigCompound : ICompoundShape, IContainer
{
    /// <summary>Type id of big compounds.</summary>
    public const int Id = 7;

    /// <summary>Boxes of the children in the frame of the compound.</summary>
    public Tree Tree;
    /// <inheritdoc cref="Compound.Children"/>
    public Buffer<CompoundChild> Children;

    /// <summary>Makes a compound of children.</summary>
    /// <param name="children">Memory with the children, and no more; the compound keeps it.</param>
    /// <param name="shapes">Shapes that the children refer to.</param>
    /// <param name="pool">Source of the tree's memory.</param>
    /// <param name="dispatcher">Threads to build the tree with; null for the calling one. The compound is the same.</param>
    /// <exception cref="ArgumentException">A child's shape does not exist or cannot be a child, or a pose is not valid.</exception>
    public BigCompound(Buffer<CompoundChild> children, Shapes shapes, BufferPool pool, IThreadDispatcher? dispatcher = null)
    {
        ArgumentNullException.ThrowIfNull(shapes);
        ArgumentNullException.ThrowIfNull(pool);
        CompoundChildren.Validate(children);
        CompoundChildren.CheckShapes(children, shapes);
        Children = children;
        pool.TakeAtLeast(children.Length, out Buffer<NodeChild> nodes);
        pool.TakeAtLeast(children.Length, out Buffer<BoundingBox> boxes);
        CompoundChildren.WriteBoxes(children, shapes, nodes.Memory);
        for (int i = 0; i < children.Length; ++i)
            boxes[i] = new(nodes[i].Min, nodes[i].Max);
        Tree = new Tree(pool, children.Length);
        Tree.BinnedBuild(new ReadOnlySpan<BoundingBox>(boxes.Memory, children.Length), pool, dispatcher);
        pool.Return(ref boxes);
        pool.Return(ref nodes);
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new CompoundShapeBatch<BigCompound>(pool, initialCapacity, shapes);

    /// <inheritdoc/>
    public readonly int ChildCount => Children.Length;

    /// <inheritdoc/>
    /// <exception cref="ArgumentOutOfRangeException">There is no such child.</exception>
    public readonly ref CompoundChild GetChild(int compoundChildIndex) => ref CompoundChildren.Get(Children, compoundChildIndex);

    /// <inheritdoc cref="Compound.FindPiece"/>
    public readonly void FindPiece(int pieceIndex, out int childIndex, out int innerIndex) =>
        CompoundChildren.FindPiece(Children, pieceIndex, out childIndex, out innerIndex);

    /// <inheritdoc cref="Compound.GetPieceIndex"/>
    public readonly int GetPieceIndex(int childIndex, int innerIndex = 0) => CompoundChildren.GetPieceIndex(Children, childIndex, innerIndex);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        CompoundChildren.Validate(Children);
        if (Tree.LeafCount != Children.Length)
            throw new ArgumentException($"The tree of a compound of {Children.Length} children has {Tree.LeafCount} leaves.", nameof(Tree));
    }

    /// <summary>Adds a child at the end. The centre of mass of a body may then be another one.</summary>
    /// <param name="child">The child.</param>
    /// <param name="pool">Pool that the compound's memory was taken from.</param>
    /// <param name="shapes">Shapes that the children refer to.</param>
    /// <exception cref="ArgumentException">The child's shape does not exist or cannot be a child, or its pose is not valid.</exception>
    public void Add(CompoundChild child, BufferPool pool, Shapes shapes)
    {
        ArgumentNullException.ThrowIfNull(shapes);
        CompoundChildren.Validate(child, Children.Length);
        CompoundChildren.CheckShape(child, Children.Length, shapes, Children.Length + 1);
        CompoundChildren.Add(ref Children, child, pool);
        shapes.UpdateBounds(child.AsPose(), child.ShapeIndex, out var bounds);
        Tree.Add(bounds, pool);
    }

    /// <inheritdoc cref="Compound.RemoveAt"/>
    public void RemoveAt(int childIndex, BufferPool pool)
    {
        CompoundChildren.RemoveAt(ref Children, childIndex, pool);
        Tree.RemoveAt(childIndex);
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, Shapes shapeBatches, out Vector3 min, out Vector3 max)
    {
        var extent = CompoundChildren.Measure(Children, orientation, shapeBatches);
        min = extent.Min;
        max = extent.Max;
    }

    /// <inheritdoc cref="CompoundBuilder.ComputeInertia(Span{CompoundChild}, Span{float}, Shapes)"/>
    public readonly BodyInertia ComputeInertia(Span<float> childMasses, Shapes shapes) =>
        CompoundBuilder.ComputeInertia(CompoundChildren.Span(Children), childMasses, shapes);

    /// <inheritdoc cref="CompoundBuilder.ComputeInertia(Span{CompoundChild}, Span{float}, Shapes, out Vector3)"/>
    public readonly BodyInertia ComputeInertia(Span<float> childMasses, Shapes shapes, out Vector3 centerOfMass)
    {
        var inertia = CompoundBuilder.ComputeInertia(CompoundChildren.Span(Children), childMasses, shapes, out centerOfMass);
        for (int i = 0; i < Children.Length; ++i)
        {
            shapes.UpdateBounds(Children[i].AsPose(), Children[i].ShapeIndex, out var bounds);
            Tree.UpdateBounds(i, bounds);
        }
        return inertia;
    }

    /// <inheritdoc/>
    public readonly void RayTest<TRayHitHandler>(in RigidPose pose, in RayData ray, ref float maximumT, Shapes shapeBatches, BufferPool pool,
        ref TRayHitHandler hitHandler) where TRayHitHandler : struct, IShapeRayHitHandler
    {
        var handler = hitHandler;
        var tester = new ChildRayTester(Children, pose, ray, shapeBatches, PieceHits.For(ref handler));
        RigidPose.TransformByInverse(ray.Origin, pose, out var origin);
        Tree.RayCast(origin, Exact.RotateByInverse(ray.Direction, pose.Orientation), ref maximumT, pool, ref tester);
        hitHandler = handler;
    }

    /// <inheritdoc/>
    public void Dispose(BufferPool pool)
    {
        CompoundChildren.Dispose(ref Children, pool);
        Tree.Dispose(pool);
    }

    readonly int IContainer.FanOut(int node, Shapes shapes) =>
        node < Tree.NodeCount ? 2 : ContainerChildren.FanOut(Children, Tree.NodeCount, node, shapes);

    readonly int IContainer.Open(int node, Shapes shapes, NodeChild* below)
    {
        if (node >= Tree.NodeCount)
            return ContainerChildren.Open(Children, Tree.NodeCount, node, shapes, below);
        // The second side of a tree with a single leaf is nothing.
        var count = Math.Min(2, Tree.LeafCount);
        for (int i = 0; i < count; ++i)
        {
            below[i] = Tree.Children[2 * node + i];
            if (below[i].Index < 0)
                ContainerChildren.Mark(Children, Tree.NodeCount, shapes, ref below[i]);
        }
        return count;
    }

    static bool IContainer.IsList => false;

    readonly void IContainer.FindOverlaps(
        Vector3 min, Vector3 max, in ShapeOutline outline, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool)
    {
        int first = found.Count;
        Tree.GetOverlaps(min, max, ref found, pool);
        // From the last on, so that what is added behind is not looked at.
        for (int i = found.Count - 1; i >= first; --i)
        {
            var child = found[i];
            if (!ContainerChildren.IsContainer(Children[child]))
                continue;
            found[i] = found[found.Count - 1];
            --found.Count;
            ContainerChildren.FindOverlaps(Children, child, min, max, shapes, ref found, pool);
        }
    }

    readonly void IContainer.GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child) =>
        ContainerChildren.Get(Children, index, shapes, scratch, out child);
}
