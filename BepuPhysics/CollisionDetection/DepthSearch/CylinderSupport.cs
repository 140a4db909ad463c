using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A cylinder is its own core. Along its axis it shows the middle of a cap.</summary>
public readonly struct CylinderSupport : ISupport<CylinderWide>
{
    /// <inheritdoc/>
    public static bool IsRound => true;

    /// <inheritdoc/>
    public static bool IsCylinder => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetCylinder(in CylinderWide shape, out Vector<float> radius, out Vector<float> halfLength)
    {
        radius = shape.Radius;
        halfLength = shape.HalfLength;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide FaceNormal(in CylinderWide shape, in Vector3Wide direction) =>
        new(Vector<float>.Zero, Wide.CopySign(Vector<float>.One, direction.Y), Vector<float>.Zero);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetFace(in CylinderWide shape, in Vector3Wide normal, out SearchFace face)
    {
        var zero = Vector<float>.Zero;
        Unsafe.SkipInit(out face);
        face.Normal = normal;
        face.AxisX = new(Vector<float>.One, zero, zero);
        face.AxisY = new(zero, zero, Vector<float>.One);
        face.Height = shape.HalfLength;
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Margin(in CylinderWide shape) => Vector<float>.Zero;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetExtents(in CylinderWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        inner = Wide.Min(shape.Radius, shape.HalfLength);
        outer = Vector.SquareRoot(shape.Radius * shape.Radius + shape.HalfLength * shape.HalfLength);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Support(in CylinderWide shape, in Vector3Wide direction, Vector<int> doneMask)
    {
        var across = Vector.SquareRoot(direction.X * direction.X + direction.Z * direction.Z);
        var scale = Wide.DivideOrZero(shape.Radius, across);
        return new(direction.X * scale, Wide.CopySign(shape.HalfLength, direction.Y), direction.Z * scale);
    }

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Radial(in Vector3Wide point) => new(point.X, Vector<float>.Zero, point.Z);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Tangent(in Vector3Wide radial) => new(radial.Z, Vector<float>.Zero, -radial.X);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Follow(in Vector3Wide point, in Vector3Wide radial) => new(radial.X, point.Y, radial.Z);

    /// <inheritdoc/>
    // With r off the radius R and off half the length H, and a ball of r around, the depth at an angle v from the axis is
    // (R - r) sin v + (H - r) cos v + r: that of the cylinder across the axis and along it, less in between. What is added by another shape within
    // a reach changes by the reach times the angle at most. So with twice the reach left of R and of H, the least of all is still across or
    // along the axis, as it is before. A cylinder that is longer than thick by that much may become a segment: only along its axis does it
    // get shallower than the cylinder then, and there it is deeper by more than the other shape.
    public static Vector<float> Shrink(ref CylinderWide shape, Vector<float> reach)
    {
        var needed = reach * new Vector<float>(2);
        var thickness = Wide.Min(shape.Radius, shape.HalfLength);
        var radius = Wide.Select(Vector.GreaterThan(shape.HalfLength - shape.Radius, needed), shape.Radius,
            Wide.Max(thickness - needed, Vector<float>.Zero));
        shape.Radius -= radius;
        shape.HalfLength -= radius;
        return radius;
    }
}
