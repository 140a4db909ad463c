using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Diagnostics;
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

    internal override float MaximumRadius(int shapeIndex)
    {
        Get(shapeIndex).ComputeAngularExpansionData(out var maximumRadius, out _);
        return maximumRadius;
    }

    internal override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        Check.That(shapeIndices.Length <= Vector<float>.Count);
        maximumRadius = default;
        maximumAngularExpansion = default;
        min = default;
        max = default;
        var turns = orientations;
        for (int lane = 0; lane < shapeIndices.Length; ++lane)
        {
            if (shapeIndices[lane] < 0)
                continue;
            ref var mesh = ref Get(shapeIndices[lane]);
            mesh.ComputeBounds(Lanes.Read<Quaternion, QuaternionWide>(ref turns, lane), out var low, out var high);
            mesh.ComputeAngularExpansionData(out var radius, out var expansion);
            Lanes.Write(low, ref min, lane);
            Lanes.Write(high, ref max, lane);
            GatherScatter.Get(ref maximumRadius, lane) = radius;
            GatherScatter.Get(ref maximumAngularExpansion, lane) = expansion;
        }
    }

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);
}
