using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Height fields; returns their memory together with them when asked to.</summary>
sealed class HeightFieldShapeBatch(BufferPool pool, int initialCapacity, Shapes collection)
    : ContainerShapeBatch<HeightField>(pool, initialCapacity, collection)
{
    internal override bool IsForStaticsOnly(int shapeIndex) => true;

    public override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max) =>
        this[shapeIndex].ComputeBounds(orientation, out min, out max);

    public override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler) =>
        this[shapeIndex].RayTest(pose, ray, ref maximumT, pool, ref hitHandler);

    // Known without the box.
    internal override float MaximumRadius(int shapeIndex) => Get(shapeIndex).MaximumRadius;

    private protected override ContainerExtent Measure(int shapeIndex, in Quaternion orientation)
    {
        ref var field = ref Get(shapeIndex);
        field.ComputeBounds(orientation, out var min, out var max);
        // Nothing turns by which the last would be asked for; more there is not.
        return new(min, max, field.MaximumRadius, 2 * field.MaximumRadius);
    }

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);

    private protected override bool HasMemory => true;
}
