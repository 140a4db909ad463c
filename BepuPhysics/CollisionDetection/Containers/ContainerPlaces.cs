using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Puts children where their containers are.</summary>
static unsafe class ContainerPlaces
{
    /// <summary>Opens a node of a container.</summary>
    /// <param name="container">The container.</param>
    /// <param name="node">Index of the node.</param>
    /// <param name="shapes">Shapes that children may be.</param>
    /// <param name="below">Receives the nodes below; is taken from the pool, and made larger, as it needs to be.</param>
    /// <param name="pool">Source of memory.</param>
    /// <returns>Number of nodes.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Open<TContainer>(in TContainer container, int node, Shapes shapes, ref Buffer<NodeChild> below, BufferPool pool)
        where TContainer : unmanaged, IContainer
    {
        var fanOut = container.FanOut(node, shapes);
        if (below.Length < fanOut)
            pool.ResizeToAtLeast(ref below, fanOut, 0);
        return container.Open(node, shapes, below.Memory);
    }

    /// <summary>Two shapes without children, which are to be replaced by children.</summary>
    // Written in place, field by field: as a value it would be copied for each child that is found.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void SetParents(in ParentPair pair, out ChildShapes children)
    {
        Unsafe.SkipInit(out children);
        children.OffsetA = default;
        children.OrientationA = pair.OrientationA;
        children.NameA = pair.NameA;
        SetParentB(pair, ref children);
        children.ConeA = default;
        children.ConeB = default;
        children.LeadsOut = false;
    }

    /// <summary>The second of two shapes without children, which is to be replaced by a child; the first stays as it is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void SetParentB(in ParentPair pair, ref ChildShapes children)
    {
        children.OffsetB = pair.OffsetB;
        children.OrientationB = pair.OrientationB;
        children.NameB = pair.NameB;
    }

    /// <summary>A child of a container, and a shape that has none.</summary>
    /// <param name="pair">The container and the shape.</param>
    /// <param name="containerIsA">Whether the container is A.</param>
    /// <param name="container">The container.</param>
    /// <param name="ids">The child.</param>
    /// <param name="typeId">Type of the shape.</param>
    /// <param name="shape">The shape.</param>
    /// <param name="shapes">Shapes that children may be.</param>
    /// <param name="scratch">Room for a child that is made on the way.</param>
    /// <param name="children">Receives the two.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Set<TContainer>(in ParentPair pair, bool containerIsA, in TContainer container, ChildIds ids, int typeId, void* shape, Shapes shapes,
        void* scratch, out ChildShapes children) where TContainer : unmanaged, IContainer
    {
        SetParents(pair, out children);
        if (containerIsA)
        {
            SetA(ref children, container, ids.A, shapes, scratch);
            SetShape(ref children, isA: false, typeId, shape);
        }
        else
        {
            SetB(ref children, container, ids.B, shapes, scratch);
            SetShape(ref children, isA: true, typeId, shape);
        }
    }

    /// <summary>Says what shape one of the two is; where it is stays as it is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void SetShape(ref ChildShapes children, bool isA, int typeId, void* shape)
    {
        if (isA)
        {
            children.TypeA = typeId;
            children.ShapeA = shape;
        }
        else
        {
            children.TypeB = typeId;
            children.ShapeB = shape;
        }
    }

    /// <summary>Replaces A, which is a container, by a child of it.</summary>
    public static void SetA<TContainer>(ref ChildShapes children, in TContainer container, int index, Shapes shapes, void* scratch)
        where TContainer : unmanaged, IContainer
    {
        Find(container, index, shapes, scratch, children.OrientationA, ref children.NameA, out children.TypeA, out children.ShapeA,
            out children.ConeA, out var pose);
        children.OffsetA = pose.Position;
        children.OrientationA = pose.Orientation;
    }

    /// <summary>Replaces B, which is a container, by a child of it.</summary>
    public static void SetB<TContainer>(ref ChildShapes children, in TContainer container, int index, Shapes shapes, void* scratch)
        where TContainer : unmanaged, IContainer
    {
        Find(container, index, shapes, scratch, children.OrientationB, ref children.NameB, out children.TypeB, out children.ShapeB,
            out children.ConeB, out var pose);
        children.OffsetB += pose.Position;
        children.OrientationB = pose.Orientation;
    }

    static void Find<TContainer>(in TContainer container, int index, Shapes shapes, void* scratch, in Quaternion orientation, ref TypedIndex name,
        out int typeId, out void* shape, out TriangleCone cone, out RigidPose pose) where TContainer : unmanaged, IContainer
    {
        container.GetChild(index, shapes, scratch, out var child);
        typeId = child.TypeId;
        shape = child.Shape;
        // Field by field, as it was written a moment ago: a wider load would have to wait for that.
        cone.Cosines = child.Cone.Cosines;
        cone.Sines = child.Cone.Sines;
        cone.FreeMask = child.Cone.FreeMask;
        if (child.Name.Exists)
            name = child.Name;
        pose = new(Exact.Rotate(child.Pose.Position, orientation), Exact.Concatenate(child.Pose.Orientation, orientation));
    }
}
