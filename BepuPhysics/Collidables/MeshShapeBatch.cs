using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Meshes; removes their memory together with them when asked to.</summary>
sealed class MeshShapeBatch(BufferPool pool, int initialCapacity, Shapes collection)
    : ContainerShapeBatch<Mesh>(pool, initialCapacity, collection)
{
    public override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max) =>
        this[shapeIndex].ComputeBounds(orientation, out min, out max);

    public override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler) =>
        this[shapeIndex].RayTest(pose, ray, ref maximumT, pool, ref hitHandler);

    // Known without the box.
    internal override float MaximumRadius(int shapeIndex)
    {
        Get(shapeIndex).ComputeAngularExpansionData(out var maximumRadius, out _);
        return maximumRadius;
    }

    private protected override ContainerExtent Measure(int shapeIndex, in Quaternion orientation)
    {
        ref var mesh = ref Get(shapeIndex);
        mesh.ComputeBounds(orientation, out var min, out var max);
        mesh.ComputeAngularExpansionData(out var maximumRadius, out var maximumAngularExpansion);
        return new(min, max, maximumRadius, maximumAngularExpansion);
    }

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);

    private protected override bool HasMemory => true;
}
