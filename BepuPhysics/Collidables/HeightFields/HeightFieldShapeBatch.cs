using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
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

    internal override float MaximumRadius(int shapeIndex) => Get(shapeIndex).MaximumRadius;

    internal override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations, out Vector<float> maximumRadius,
        out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = default;
        min = max = default;
        var turns = orientations;
        for (int lane = 0; lane < shapeIndices.Length; ++lane)
        {
            if (shapeIndices[lane] < 0)
                continue;
            ref var field = ref Get(shapeIndices[lane]);
            field.ComputeBounds(Lanes.Read<Quaternion, QuaternionWide>(ref turns, lane), out var low, out var high);
            Lanes.Write(low, ref min, lane);
            Lanes.Write(high, ref max, lane);
            GatherScatter.Get(ref maximumRadius, lane) = field.MaximumRadius;
        }
        // Nothing turns by which this would be asked for; more there is not.
        maximumAngularExpansion = maximumRadius + maximumRadius;
    }

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);
}
