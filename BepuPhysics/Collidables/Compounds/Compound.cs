using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A shape made of a few shapes in a list. For more than about ten <see cref="BigCompound"/> is faster.</summary>
/// <remarks>
/// <para>Any shapes but half-spaces may be children, the same one in several places too: convex ones, meshes, height fields (then the compound is for
/// statics, as they are), and compounds whose own children are convex. A body turns around the origin of the
/// compound, which must be its centre of mass: <see cref="CompoundBuilder"/> sees to that. While the compound is among the
/// <see cref="Shapes"/>, the shapes that its children had when it was added cannot be removed.</para>
/// <para>What touches, and what a ray hits, is a convex piece. A convex child is one, and its number is that of the child. A child that is a mesh, a
/// height field or a compound consists of many, whose numbers follow those of all children: <see cref="FindPiece"/> says which child a
/// piece belongs to, and which triangle or child of that it is. Callbacks and ray handlers are given numbers of pieces.</para>
/// </remarks>
public unsafe struct Compound : ICompoundShape, IContainer
{
    /// <summary>Type id of compounds.</summary>
    public const int Id = 6;

    /// <summary>The children. This memory is that which the compound was made with; <see cref="Dispose"/> returns it.</summary>
    public Buffer<CompoundChild> Children;

    /// <summary>Makes a compound of children.</summary>
    /// <param name="children">Memory with the children, and no more; the compound keeps it. They are checked when the compound is added.</param>
    public Compound(Buffer<CompoundChild> children) => Children = children;

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new CompoundShapeBatch<Compound>(pool, initialCapacity, shapes);

    /// <inheritdoc/>
    public readonly int ChildCount => Children.Length;

    /// <inheritdoc/>
    /// <exception cref="ArgumentOutOfRangeException">There is no such child.</exception>
    public readonly ref CompoundChild GetChild(int compoundChildIndex) => ref CompoundChildren.Get(Children, compoundChildIndex);

    /// <summary>Which child a piece belongs to. Pieces are what callbacks and ray handlers are told of.</summary>
    /// <param name="pieceIndex">Number of the piece; below <see cref="ChildCount"/> that of a convex child.</param>
    /// <param name="childIndex">Number of the child.</param>
    /// <param name="innerIndex">
    /// Number of the piece in that child: of a triangle of a mesh or height field, or of a child of a compound. Zero for a convex child.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">No piece has this number.</exception>
    public readonly void FindPiece(int pieceIndex, out int childIndex, out int innerIndex) =>
        CompoundChildren.FindPiece(Children, pieceIndex, out childIndex, out innerIndex);

    /// <summary>Number of a piece, as callbacks and ray handlers are told it. It changes when children are added or removed.</summary>
    /// <param name="childIndex">Number of the child.</param>
    /// <param name="innerIndex">Number of the triangle or child in that child, which is not looked up; zero for a convex child.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such child, or it has no such piece.</exception>
    public readonly int GetPieceIndex(int childIndex, int innerIndex = 0) => CompoundChildren.GetPieceIndex(Children, childIndex, innerIndex);

    /// <inheritdoc/>
    public readonly void Validate() => CompoundChildren.Validate(Children);

    /// <summary>Adds a child at the end. The centre of mass of a body may then be another one.</summary>
    /// <param name="child">The child; its shape is not checked to exist.</param>
    /// <param name="pool">Pool that the children's memory was taken from.</param>
    /// <exception cref="ArgumentException">The child's pose or shape type is not valid.</exception>
    public void Add(CompoundChild child, BufferPool pool)
    {
        CompoundChildren.Validate(child, Children.Length);
        CompoundChildren.Add(ref Children, child, pool);
    }

    /// <summary>Removes a child; the last one gets its number.</summary>
    /// <param name="childIndex">Number of the child.</param>
    /// <param name="pool">Pool that the children's memory was taken from.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such child.</exception>
    /// <exception cref="InvalidOperationException">It is the only child.</exception>
    public void RemoveAt(int childIndex, BufferPool pool) => CompoundChildren.RemoveAt(ref Children, childIndex, pool);

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, Shapes shapeBatches, out Vector3 min, out Vector3 max)
    {
        var extent = CompoundChildren.Measure(Children, orientation, shapeBatches);
        min = extent.Min;
        max = extent.Max;
    }

    /// <summary>Where a child is if its compound is at the origin and turned.</summary>
    /// <param name="localPose">Pose of the child in the compound.</param>
    /// <param name="orientation">Orientation of the compound; unit length.</param>
    /// <param name="rotatedChildPose">Pose of the child relative to the origin of the compound, along the axes of the world.</param>
    public static void GetRotatedChildPose(in RigidPose localPose, Quaternion orientation, out RigidPose rotatedChildPose) =>
        RigidPose.MultiplyWithoutOverlap(localPose, orientation, out rotatedChildPose);

    /// <summary>Where a child is if its compound is at the origin and turned.</summary>
    /// <param name="localPosition">Position of the child in the compound, m.</param>
    /// <param name="localOrientation">Orientation of the child in the compound; unit length.</param>
    /// <param name="orientation">Orientation of the compound; unit length.</param>
    /// <param name="rotatedChildPose">Pose of the child relative to the origin of the compound, along the axes of the world.</param>
    public static void GetRotatedChildPose(Vector3 localPosition, Quaternion localOrientation, Quaternion orientation, out RigidPose rotatedChildPose) =>
        GetRotatedChildPose(new RigidPose(localPosition, localOrientation), orientation, out rotatedChildPose);

    /// <summary>Where a child is in the world.</summary>
    /// <param name="localPose">Pose of the child in the compound.</param>
    /// <param name="transform">Pose of the compound.</param>
    /// <param name="worldPose">Pose of the child.</param>
    public static void GetWorldPose(in RigidPose localPose, in RigidPose transform, out RigidPose worldPose) =>
        RigidPose.MultiplyWithoutOverlap(localPose, transform, out worldPose);

    /// <inheritdoc cref="CompoundBuilder.ComputeInertia(Span{CompoundChild}, Span{float}, Shapes)"/>
    public readonly BodyInertia ComputeInertia(Span<float> childMasses, Shapes shapes) =>
        CompoundBuilder.ComputeInertia(CompoundChildren.Span(Children), childMasses, shapes);

    /// <inheritdoc cref="CompoundBuilder.ComputeInertia(Span{CompoundChild}, Span{float}, Shapes, out Vector3)"/>
    public readonly BodyInertia ComputeInertia(Span<float> childMasses, Shapes shapes, out Vector3 centerOfMass) =>
        CompoundBuilder.ComputeInertia(CompoundChildren.Span(Children), childMasses, shapes, out centerOfMass);

    /// <inheritdoc/>
    public readonly void RayTest<TRayHitHandler>(in RigidPose pose, in RayData ray, ref float maximumT, Shapes shapeBatches, BufferPool pool,
        ref TRayHitHandler hitHandler) where TRayHitHandler : struct, IShapeRayHitHandler
    {
        var handler = hitHandler;
        var tester = new ChildRayTester(Children, pose, ray, shapeBatches, PieceHits.For(ref handler));
        for (int i = 0; i < Children.Length; ++i)
            tester.Test(i, ref maximumT, pool);
        hitHandler = handler;
    }

    /// <inheritdoc/>
    public void Dispose(BufferPool pool) => CompoundChildren.Dispose(ref Children, pool);

    const int OwnNodeCount = 1;

    readonly int IContainer.FanOut(int node, Shapes shapes) =>
        node < OwnNodeCount ? Children.Length : ContainerChildren.FanOut(Children, OwnNodeCount, node, shapes);

    readonly int IContainer.Open(int node, Shapes shapes, NodeChild* below)
    {
        if (node >= OwnNodeCount)
            return ContainerChildren.Open(Children, OwnNodeCount, node, shapes, below);
        CompoundChildren.WriteBoxes(Children, shapes, below);
        for (int i = 0; i < Children.Length; ++i)
            ContainerChildren.Mark(Children, OwnNodeCount, shapes, ref below[i]);
        return Children.Length;
    }

    static bool IContainer.IsList => true;

    readonly void IContainer.FindOverlaps(
        Vector3 min, Vector3 max, in ShapeOutline outline, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool)
    {
        for (int i = 0; i < Children.Length; ++i)
        {
            if (!BoundingBox.IntersectsUnsafe(min, max, list[i].Min, list[i].Max))
                continue;
            if (list[i].Index < 0)
                found.Add(i, pool);
            else
                ContainerChildren.FindOverlaps(Children, i, min, max, shapes, ref found, pool);
        }
    }

    readonly void IContainer.GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child) =>
        ContainerChildren.Get(Children, index, shapes, scratch, out child);
}
