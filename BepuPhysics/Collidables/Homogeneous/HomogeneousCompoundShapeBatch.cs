using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Shapes of one type of a game's own; see <see cref="IHomogeneousCompoundShape{TChildShape, TChildShapeWide}"/>.</summary>
/// <typeparam name="TShape">Type of the shapes.</typeparam>
/// <typeparam name="TChildShape">Type of their children.</typeparam>
/// <typeparam name="TChildShapeWide">Wide form of the children.</typeparam>
public sealed unsafe class HomogeneousCompoundShapeBatch<TShape, TChildShape, TChildShapeWide> : ShapeBatch<TShape>, IHomogeneousBatch
    where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
    where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
{
    /// <summary>Creates an empty batch.</summary>
    /// <param name="pool">Source of the batch's memory.</param>
    /// <param name="initialCapacity">Number of shapes to make room for.</param>
    /// <exception cref="InvalidOperationException">The type has the id of a type of the library's, or its children are none that a shape can have.</exception>
    public HomogeneousCompoundShapeBatch(BufferPool pool, int initialCapacity) : base(pool, initialCapacity)
    {
        OwnShapeChecks.TypeId(typeof(TShape), TShape.TypeId);
        OwnShapeChecks.Child(typeof(TShape), typeof(TChildShape), TChildShape.TypeId, sizeof(TChildShape));
    }

    /// <inheritdoc/>
    public override bool Compound => true;

    /// <inheritdoc/>
    public override void ComputeBounds(int shapeIndex, Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        this[shapeIndex].ComputeBounds(orientation, out min, out max);
        OwnShapeChecks.Bounds(typeof(TShape), min, max);
    }

    /// <inheritdoc/>
    public override void RayTest<TRayHitHandler>(
        int shapeIndex, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler) =>
        this[shapeIndex].RayTest(pose, ray, ref maximumT, pool, ref hitHandler);

    void IHomogeneousBatch.Use<TUser>(void* shape, ref TUser user) =>
        user.Use(Unsafe.AsRef<HomogeneousContainer<TShape, TChildShape, TChildShapeWide>>(shape));

    // The farthest point is no farther than the farthest corner of the box, and no side of the box is left by more than that exceeds the nearest side.
    private protected override ContainerExtent Measure(int shapeIndex, in Quaternion orientation)
    {
        Get(shapeIndex).ComputeBounds(orientation, out var min, out var max);
        OwnShapeChecks.Bounds(typeof(TShape), min, max);
        var radius = Exact.Length(Exact.Max(Vector3.Abs(min), Vector3.Abs(max)));
        var nearest = Exact.Min(-min, max);
        return new(min, max, radius, radius - MathHelper.Min(nearest.X, MathHelper.Min(nearest.Y, nearest.Z)));
    }

    internal override float MaximumRadius(int shapeIndex) => Measure(shapeIndex, Quaternion.Identity).MaximumRadius;

    internal override void GetBounds(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations, out Vector<float> maximumRadius,
        out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max) =>
        GetBoundsOneByOne(shapeIndices, orientations, out maximumRadius, out maximumAngularExpansion, out min, out max);

    // Its children are swept by what their batch knows of them, be there any other shape of their type or not.
    private protected override void OnOwned(Shapes shapes)
    {
        if (TChildShape.TypeId > ShapeLimits.LastTypeId)
            shapes.MakeRoomForType<TChildShape>();
    }

    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);

    private protected override bool HasMemory => true;
}
