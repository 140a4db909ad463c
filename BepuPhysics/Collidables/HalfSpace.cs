using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Everything below a plane through the origin: ground, walls and ceilings without an end, a seam or a thickness.</summary>
/// <remarks>
/// <para>For statics only: it has no mass. It reaches <see cref="Extent"/> from the position of its static, to all sides; what is farther away
/// falls past it.</para>
/// <para>The broad phase knows shapes by boxes. The box of a plane across one of the world's axes ends at the plane; any other is in the box of
/// everything, and is tested against every body.</para>
/// </remarks>
/// <param name="normal">Direction out of the solid, of any length but zero, which is checked when the shape is added.</param>
public struct HalfSpace(Vector3 normal) : IConvexShape
{
    /// <summary>Type id of half-spaces.</summary>
    public const int Id = 10;

    /// <summary>How far it reaches, m.</summary>
    public const float Extent = 2e7f;

    // Of the squared length of a normal: rounding, and a depth that is 5e-6 of itself off.
    const float UnitLengthTolerance = 1e-5f;

    /// <summary>Unit direction out of the solid, in the frame of the shape.</summary>
    public Vector3 Normal = normal / Exact.Length(normal);

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) => new HalfSpaceShapeBatch(pool, initialCapacity);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        if (!UnitTolerance.Holds(Exact.Dot(Normal, Normal), UnitLengthTolerance))
            throw new ArgumentException($"The normal of a half-space must be a direction, of length one, not {Normal}.", nameof(Normal));
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        OneLane.ComputeBounds<HalfSpace, HalfSpaceWide>(this, orientation, out min, out max);

    /// <inheritdoc/>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        maximumRadius = Extent;
        maximumAngularExpansion = Extent;
    }

    /// <summary>Refuses: a half-space has no mass.</summary>
    /// <param name="mass">Any.</param>
    /// <exception cref="InvalidOperationException">Always.</exception>
    public readonly BodyInertia ComputeInertia(float mass) =>
        throw new InvalidOperationException("A half-space has no end, and so no inertia: it is for statics.");

    /// <inheritdoc/>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        OneLane.RayTest<HalfSpace, HalfSpaceWide>(this, pose, origin, direction, out t, out normal);
}

/// <summary>A bundle of half-spaces.</summary>
public struct HalfSpaceWide : IShapeWide<HalfSpace>
{
    /// <inheritdoc cref="HalfSpace.Normal"/>
    public Vector3Wide Normal;

    /// <inheritdoc/>
    // Of a point of the plane, n.x x + n.y y + n.z z = 0, and within the extent y is at most extent (|n.x| + |n.z|) / |n.y|.
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = maximumAngularExpansion = new(HalfSpace.Extent);
        var normal = orientation * Normal;
        var size = Vector3Wide.Abs(normal);
        GetInterval(normal.X, size.X, size.Y + size.Z, out min.X, out max.X);
        GetInterval(normal.Y, size.Y, size.Z + size.X, out min.Y, out max.Y);
        GetInterval(normal.Z, size.Z, size.X + size.Y, out min.Z, out max.Z);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void GetInterval(Vector<float> along, Vector<float> size, Vector<float> across, out Vector<float> min, out Vector<float> max)
    {
        var extent = new Vector<float>(HalfSpace.Extent);
        var end = Wide.Min(extent, extent * across / Wide.Max(size, new Vector<float>(float.Epsilon)));
        max = Wide.Select(Vector.GreaterThan(along, Vector<float>.Zero), end, extent);
        min = Wide.Select(Vector.LessThan(along, Vector<float>.Zero), -end, -extent);
    }

    /// <inheritdoc/>
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var zero = Vector<float>.Zero;
        var outwards = pose.Orientation * Normal;
        var height = Vector3Wide.Dot(outwards, ray.Origin - pose.Position);
        var fall = -Vector3Wide.Dot(outwards, ray.Direction);
        var isInside = Vector.LessThanOrEqual(height, zero);
        var size = Vector3Wide.Abs(ray.Direction);
        var greatest = new Vector<float>(float.MaxValue);
        var hasDirection = (Vector.GreaterThan(size.X, zero) | Vector.GreaterThan(size.Y, zero) | Vector.GreaterThan(size.Z, zero)) &
            Vector.LessThanOrEqual(size.X, greatest) & Vector.LessThanOrEqual(size.Y, greatest) & Vector.LessThanOrEqual(size.Z, greatest);
        t = Wide.Select(isInside, zero, height / fall);
        // Beyond the range of a float there is no place.
        hitMask = hasDirection & (isInside | Vector.GreaterThan(fall, zero)) & Vector.LessThanOrEqual(t, greatest);
        t = Wide.Mask(hitMask, t);
        normal = Vector3Wide.Mask(hitMask, outwards);
    }
}

/// <summary>Half-spaces.</summary>
sealed class HalfSpaceShapeBatch(BufferPool pool, int initialCapacity) : ConvexShapeBatch<HalfSpace, HalfSpaceWide>(pool, initialCapacity)
{
    internal override bool IsForStaticsOnly(int shapeIndex) => true;
}
