using System;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Convex shapes of one type.</summary>
/// <typeparam name="TShape">Type of the shapes.</typeparam>
/// <typeparam name="TShapeWide">Wide form of the shapes.</typeparam>
public class ConvexShapeBatch<TShape, TShapeWide> : ShapeBatch<TShape>, IConvexShapeBatch
    where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape>
{
    /// <summary>Creates an empty batch.</summary>
    /// <param name="pool">Source of the batch's memory.</param>
    /// <param name="initialCapacity">Number of shapes to make room for.</param>
    public ConvexShapeBatch(BufferPool pool, int initialCapacity) : base(pool, initialCapacity) { }

    /// <inheritdoc/>
    public sealed override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        this[shapeIndex].ComputeBounds(orientation, out min, out max);
        if (TShape.TypeId > ShapeLimits.LastTypeId)
            OwnShapeChecks.Bounds(typeof(TShape), min, max);
    }

    /// <inheritdoc/>
    public BodyInertia ComputeInertia(int shapeIndex, float mass) => this[shapeIndex].ComputeInertia(mass);

    /// <inheritdoc/>
    public sealed override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
    {
        if (this[shapeIndex].RayTest(pose, ray.Origin, ray.Direction, out var t, out var normal) && t <= maximumT)
            hitHandler.OnRayHit(ray, ref maximumT, t, normal, 0);
    }

    internal sealed override float MaximumRadius(int shapeIndex)
    {
        this[shapeIndex].ComputeAngularExpansionData(out var maximumRadius, out _);
        return maximumRadius;
    }

    internal sealed override float InnerRadius(int shapeIndex)
    {
        this[shapeIndex].ComputeAngularExpansionData(out var maximumRadius, out var maximumAngularExpansion);
        return maximumRadius - maximumAngularExpansion;
    }

    internal sealed override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        Check.That(shapeIndices.Length <= Vector<float>.Count);
        var bundle = default(TShapeWide);
        for (int lane = 0; lane < shapeIndices.Length; ++lane)
        {
            if (shapeIndices[lane] >= 0)
                Lanes.Write(Get(shapeIndices[lane]), ref bundle, lane);
        }
        bundle.GetBounds(orientations, out maximumRadius, out maximumAngularExpansion, out min, out max);
        // The library's own need no check, and have none.
        if (TShape.TypeId > ShapeLimits.LastTypeId)
            CheckBounds(shapeIndices, ref min, ref max);
    }

    static void CheckBounds(ReadOnlySpan<int> shapeIndices, ref Vector3Wide min, ref Vector3Wide max)
    {
        for (int lane = 0; lane < shapeIndices.Length; ++lane)
        {
            if (shapeIndices[lane] >= 0)
                OwnShapeChecks.Bounds(typeof(TShape), Lanes.Read<Vector3, Vector3Wide>(ref min, lane), Lanes.Read<Vector3, Vector3Wide>(ref max, lane));
        }
    }
}
