using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Height fields; returns their memory together with them when asked to.</summary>
sealed class HeightFieldShapeBatch(BufferPool pool, int initialCapacity) : ShapeBatch<HeightField>(pool, initialCapacity)
{
    public override bool Compound => true;

    internal override bool IsForStaticsOnly => true;

    public override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max) =>
        this[shapeIndex].ComputeBounds(orientation, out min, out max);

    public override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler) =>
        this[shapeIndex].RayTest(pose, ray, ref maximumT, pool, ref hitHandler);

    internal override float MaximumRadius(int shapeIndex) => Get(shapeIndex).MaximumRadius;

    internal override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations, out Vector<float> maximumRadius,
        out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max) =>
        throw new InvalidOperationException("No body is a height field.");

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);
}
