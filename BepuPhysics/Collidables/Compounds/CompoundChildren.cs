using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>What compounds with and without a tree have in common: a list of children.</summary>
static unsafe class CompoundChildren
{
    public static Span<CompoundChild> Span(Buffer<CompoundChild> children) => new(children.Memory, children.Length);

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

    /// <summary>Refuses children whose shapes do not exist, or are not convex.</summary>
    public static void CheckShapes(Buffer<CompoundChild> children, Shapes shapes)
    {
        for (int i = 0; i < children.Length; ++i)
            CheckShape(children[i], i, shapes);
    }

    /// <inheritdoc cref="CheckShapes(Buffer{CompoundChild}, Shapes)"/>
    public static void CheckShapes(ICompoundShape compound, Shapes shapes)
    {
        for (int i = 0; i < compound.ChildCount; ++i)
            CheckShape(compound.GetChild(i), i, shapes);
    }

    public static void CheckShape(in CompoundChild child, int index, Shapes shapes)
    {
        if (!shapes.Exists(child.ShapeIndex))
            throw new ArgumentException($"Child {index} is {child.ShapeIndex}, which does not exist.", nameof(child));
        if (shapes.GetBatch(child.ShapeIndex.Type) is not IConvexShapeBatch)
        {
            throw new ArgumentException(
                $"Child {index} is {child.ShapeIndex}, which is itself made of children: a child must be convex. Add its children instead.", nameof(child));
        }
        if (shapes.GetBatch(child.ShapeIndex.Type).IsForStaticsOnly)
            throw new ArgumentException($"Child {index} is {child.ShapeIndex}, which is for statics: a child must have an end.", nameof(child));
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
        if (children.Allocated)
            pool.Return(ref children);
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
