using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A shape of a game's own as the library knows shapes made of children. It is the shape, and nothing else: a pointer to one is a pointer to
/// the other.</summary>
/// <remarks>It has no nodes, as the game is not asked for any: how it finds its children is its own business.</remarks>
unsafe struct HomogeneousContainer<TShape, TChildShape, TChildShapeWide> : IContainer
    where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
    where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
{
    /// <summary>The shape.</summary>
    public TShape Shape;

    public static int TypeId => TShape.TypeId;

    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        TShape.CreateShapeBatch(pool, initialCapacity, shapes);

    public readonly void Validate() => Shape.Validate();

    public static bool IsList => false;

    public static bool HasNodes => false;

    public readonly int ChildCount => Math.Max(0, Shape.ChildCount);

    public readonly int FanOut(int node, Shapes shapes) => 1;

    public readonly int Open(int node, Shapes shapes, NodeChild* below)
    {
        var childCount = ChildCount;
        if (childCount == 0)
            return 0;
        *below = new() { LeafCount = childCount };
        Shape.ComputeBounds(Quaternion.Identity, out below->Min, out below->Max);
        OwnShapeChecks.Bounds(typeof(TShape), below->Min, below->Max);
        return 1;
    }

    public readonly void FindOverlaps(
        Vector3 min, Vector3 max, in ShapeOutline outline, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool)
    {
        var first = found.Count;
        Shape.FindLocalOverlaps(min, max, ref found, pool);
        // Before a number that is none leads to memory that is none.
        var childCount = ChildCount;
        if (found.Count < first)
            OwnShapeChecks.ThrowTaken(typeof(TShape));
        var isAscending = true;
        for (int i = first, last = -1; i < found.Count; ++i)
        {
            var child = found[i];
            if ((uint)child >= (uint)childCount)
                OwnShapeChecks.ThrowNoChild(typeof(TShape), child, childCount);
            isAscending &= child > last;
            last = child;
        }
        if (!isAscending)
            HomogeneousCompound.PutInOrder(ref found, first);
    }

    // A box of the child's own is exact to a few roundings; what it touches is to be found all the same.
    public static void ComputeChildBounds(in ContainerChild child, out Vector3 min, out Vector3 max)
    {
        const float Rounding = 2e-6f;
        ((TChildShape*)child.Shape)->ComputeBounds(child.Pose.Orientation, out min, out max);
        var rounding = (Exact.Max(Vector3.Abs(min), Vector3.Abs(max)) + Vector3.Abs(child.Pose.Position)) * Rounding;
        min -= rounding;
        max += rounding;
    }

    public readonly void GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child)
    {
        child.TypeId = TChildShape.TypeId;
        child.Shape = scratch;
        child.Name = default;
        child.Cone = default;
        Shape.GetPosedLocalChild(index, out Unsafe.AsRef<TChildShape>(scratch), out child.Pose);
    }
}
