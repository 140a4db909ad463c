using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>What compounds with and without a tree have in common: a list of children.</summary>
static unsafe class CompoundChildren
{
    public static Span<CompoundChild> Span(Buffer<CompoundChild> children) => new(children.Memory, children.Length);

    /// <summary>Children of a compound, in its memory.</summary>
    public static Buffer<CompoundChild> Of<TCompound>(ref TCompound compound) where TCompound : unmanaged, ICompoundShape =>
        compound.ChildCount == 0 ? default : new(Unsafe.AsPointer(ref compound.GetChild(0)), compound.ChildCount);

    public static ref CompoundChild Get(Buffer<CompoundChild> children, int index)
    {
        if ((uint)index >= (uint)children.Length)
            throw new ArgumentOutOfRangeException(nameof(index), index, $"The compound has {children.Length} children.");
        return ref children[index];
    }

    /// <summary>Refuses children that cannot be simulated, as far as they themselves tell.</summary>
    public static void Validate(Buffer<CompoundChild> children)
    {
        if (!children.Allocated || children.Length == 0)
            throw new ArgumentException("A compound without children is no shape: it was never created, or it was disposed.", nameof(children));
        for (int i = 0; i < children.Length; ++i)
            Validate(children[i], i);
    }

    public static void Validate(in CompoundChild child, int index)
    {
        const float Limit = Limits.MaximumOffset;
        var position = child.LocalPosition;
        if (!(MathF.Abs(position.X) <= Limit && MathF.Abs(position.Y) <= Limit && MathF.Abs(position.Z) <= Limit))
            throw new ArgumentException($"The coordinates of child {index} must be from {-Limit} to {Limit} m, not {position}.", nameof(child));
        if (!UnitTolerance.Holds(Exact.Dot(child.LocalOrientation, child.LocalOrientation), UnitTolerance.Combined))
            throw new ArgumentException($"The orientation of child {index} must be of unit length, not {child.LocalOrientation}.", nameof(child));
    }

    /// <summary>Refuses children whose shapes do not exist, or cannot be children.</summary>
    public static void CheckShapes(Buffer<CompoundChild> children, Shapes shapes)
    {
        for (int i = 0; i < children.Length; ++i)
            CheckShape(children[i], i, shapes, children.Length);
    }

    /// <inheritdoc cref="CheckShapes(Buffer{CompoundChild}, Shapes)"/>
    public static void CheckShapes(ICompoundShape compound, Shapes shapes)
    {
        for (int i = 0; i < compound.ChildCount; ++i)
            CheckShape(compound.GetChild(i), i, shapes, compound.ChildCount);
    }

    /// <summary>Refuses a child whose shape does not exist, or cannot be a child.</summary>
    /// <param name="child">The child.</param>
    /// <param name="index">Its number.</param>
    /// <param name="shapes">Shapes that there are.</param>
    /// <param name="childCount">How many children the compound has: the more, the fewer pieces each of them may have.</param>
    public static void CheckShape(in CompoundChild child, int index, Shapes shapes, int childCount)
    {
        if (!shapes.Exists(child.ShapeIndex))
            throw new ArgumentException($"Child {index} is {child.ShapeIndex}, which does not exist.", nameof(child));
        var batch = shapes.GetBatch(child.ShapeIndex.Type);
        if (batch is IContainerBatch containers)
        {
            if (batch.HasContainer(child.ShapeIndex.Index))
            {
                throw new ArgumentException($"Child {index} is {child.ShapeIndex}, of which a child is itself made of children: children of a child must be " +
                    "convex. Add its children instead.", nameof(child));
            }
            var limit = new PieceNumbers(childCount, childCount).PerChild;
            if (containers.ChildCount(child.ShapeIndex.Index) is var count && count > limit)
            {
                throw new ArgumentException($"Child {index} is {child.ShapeIndex}, which is made of {count}: in a compound of {childCount} children each may " +
                    $"be made of up to {limit}. Make it a shape of its own, or divide it.", nameof(child));
            }
            return;
        }
        if (batch is IHomogeneousBatch)
        {
            throw new ArgumentException($"Child {index} is {child.ShapeIndex}, of a type of the game's own that is made of children itself: children must be " +
                "convex, or meshes, height fields or compounds. Make it a static or body of its own, or add its children instead.", nameof(child));
        }
        if (batch is not IConvexShapeBatch)
            throw new ArgumentException($"Child {index} is {child.ShapeIndex}, which is neither convex nor made of convex children.", nameof(child));
        if (batch.IsForStaticsOnly(child.ShapeIndex.Index))
            throw new ArgumentException($"Child {index} is {child.ShapeIndex}, which has no end: a child must have one.", nameof(child));
    }

    /// <summary>Whether a child is made of children.</summary>
    public static bool HasContainer(Buffer<CompoundChild> children)
    {
        foreach (ref var child in Span(children))
        {
            if (ContainerChildren.IsContainer(child))
                return true;
        }
        return false;
    }

    /// <summary>Whether a child is for statics.</summary>
    public static bool IsForStaticsOnly(Buffer<CompoundChild> children, Shapes shapes)
    {
        foreach (ref var child in Span(children))
        {
            if (shapes.GetBatch(child.ShapeIndex.Type).IsForStaticsOnly(child.ShapeIndex.Index))
                return true;
        }
        return false;
    }

    public static void FindPiece(Buffer<CompoundChild> children, int piece, out int child, out int inner)
    {
        (child, inner) = (piece, 0);
        var isContainer = piece >= children.Length && children.Length > 0;
        if (isContainer)
            (child, inner) = ContainerChildren.Pieces(children).Find(piece);
        if ((uint)child >= (uint)children.Length || ContainerChildren.IsContainer(children[child]) != isContainer)
            throw new ArgumentOutOfRangeException(nameof(piece), piece, $"The compound of {children.Length} children has no such piece.");
    }

    public static int GetPieceIndex(Buffer<CompoundChild> children, int child, int inner)
    {
        if (!ContainerChildren.IsContainer(Get(children, child)))
        {
            return inner == 0
                ? child
                : throw new ArgumentOutOfRangeException(nameof(inner), inner, $"Child {child} is convex: its one piece has the number 0.");
        }
        var pieces = ContainerChildren.Pieces(children);
        if ((uint)inner >= (uint)pieces.PerChild)
            throw new ArgumentOutOfRangeException(nameof(inner), inner, $"A child of this compound has {pieces.PerChild} pieces at most.");
        return pieces.Of(child, inner);
    }

    public static void Add(ref Buffer<CompoundChild> children, in CompoundChild child, BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        var count = children.Length;
        // The length is that of the list.
        if (children.Allocated)
            pool.Resize(ref children, count + 1, count);
        else
            pool.Take(1, out children);
        children[count] = child;
    }

    public static void RemoveAt(ref Buffer<CompoundChild> children, int index, BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        Get(children, index);
        var last = children.Length - 1;
        if (last == 0)
            throw new InvalidOperationException("A compound keeps one child at least.");
        children[index] = children[last];
        pool.Resize(ref children, last, last);
    }

    public static void Dispose(ref Buffer<CompoundChild> children, BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.ReturnIfTaken(ref children);
        children = default;
    }

    public static void Get(Buffer<CompoundChild> children, int index, Shapes shapes, out ContainerChild result)
    {
        ref var child = ref children[index];
        result.TypeId = child.ShapeIndex.Type;
        result.Shape = shapes.GetBatch(child.ShapeIndex.Type).GetPointer(child.ShapeIndex.Index);
        result.Name = child.ShapeIndex;
        result.Pose = new(child.LocalPosition, child.LocalOrientation);
        result.Cone = default;
    }

    /// <summary>Measures all children, their compound at the origin.</summary>
    public static CompoundExtent Measure(Buffer<CompoundChild> children, in Quaternion orientation, Shapes shapes)
    {
        var extent = default(CompoundExtent);
        var boxes = new ChildBoxes(stackalloc int[Vector<float>.Count]);
        for (int start = 0; start < children.Length; start += Vector<float>.Count)
        {
            boxes.Compute(children, start, orientation, shapes);
            for (int i = 0; i < boxes.Count; ++i)
                boxes.AddTo(ref extent, i);
        }
        return extent;
    }

    /// <summary>Writes the boxes of all children in the frame of the compound, as leaves.</summary>
    public static void WriteBoxes(Buffer<CompoundChild> children, Shapes shapes, NodeChild* nodes)
    {
        var boxes = new ChildBoxes(stackalloc int[Vector<float>.Count]);
        for (int start = 0; start < children.Length; start += Vector<float>.Count)
        {
            boxes.Compute(children, start, Quaternion.Identity, shapes);
            for (int i = 0; i < boxes.Count; ++i)
            {
                boxes.Get(i, out var min, out var max);
                nodes[start + i] = new() { Min = min, Max = max, Index = ~(start + i), LeafCount = 1 };
            }
        }
    }
}
