using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

public static unsafe partial class HomogeneousCompound
{
    /// <summary>Inverse mass and inertia of the shape around its centre of mass, each child of the same mass and filled uniformly.</summary>
    /// <remarks>A body turns around the origin of its shape: that is to be moved to the centre of mass first, or the centre is to be where it is.</remarks>
    /// <param name="shape">The shape.</param>
    /// <param name="childMass">Mass of each child that there is, kg.</param>
    /// <param name="pool">Source of temporary memory.</param>
    /// <param name="centerOfMass">Centre of mass in the frame of the shape, m.</param>
    /// <exception cref="ArgumentException">
    /// The shape has no child, a mass is out of range, or floats cannot hold the inverse inertia.
    /// </exception>
    public static BodyInertia ComputeInertia<TShape, TChildShape, TChildShapeWide>(
        in TShape shape, float childMass, BufferPool pool, out Vector3 centerOfMass)
        where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
        where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
    {
        const int InitialCapacity = 64;
        ArgumentNullException.ThrowIfNull(pool);
        shape.Validate();
        shape.ComputeBounds(Quaternion.Identity, out var min, out var max);
        var children = new QuickList<int>(InitialCapacity, pool);
        try
        {
            // In the order of their numbers, in whatever order they were found.
            Unsafe.As<TShape, HomogeneousContainer<TShape, TChildShape, TChildShapeWide>>(ref Unsafe.AsRef(in shape)).FindOverlaps(
                min, max, default, null!, null, ref children, pool);
            return Sum<TShape, TChildShape, TChildShapeWide>(shape, children.AsSpan(), childMass, out centerOfMass);
        }
        finally
        {
            children.Dispose(pool);
        }
    }

    static BodyInertia Sum<TShape, TChildShape, TChildShapeWide>(in TShape shape, Span<int> children, float childMass, out Vector3 centerOfMass)
        where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
        where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
    {
        if (children.Length == 0)
            throw new ArgumentException("The shape has no child, so it has no mass.", nameof(shape));
        var center = default(CompoundMass);
        foreach (var index in children)
        {
            shape.GetPosedLocalChild(index, out _, out var pose);
            center.AddCenter(pose.Position, childMass);
        }
        centerOfMass = center.Center;
        var sum = default(CompoundMass);
        foreach (var index in children)
        {
            shape.GetPosedLocalChild(index, out var child, out var pose);
            sum.Add(pose, centerOfMass, child.ComputeInertia(childMass).InverseInertiaTensor, childMass);
        }
        return sum.ToInverse();
    }
}
