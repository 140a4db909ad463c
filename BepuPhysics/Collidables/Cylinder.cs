using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A solid cylinder around the local Y axis, its flat ends equally far from the origin.</summary>
/// <remarks>
/// Radius and length may differ by any ratio, from a coin to a rod; positions are rounded relative to the larger of the two, so what is a
/// million times smaller is not resolved.
/// </remarks>
/// <param name="radius">Radius, 1e-6 to 1e7 m; checked when the shape is added.</param>
/// <param name="length">Distance between the flat ends, 2e-6 to 2e7 m; checked when the shape is added.</param>
public struct Cylinder(float radius, float length) : IConvexShape
{
    /// <summary>Type id of cylinders.</summary>
    public const int Id = 4;

    /// <summary>Radius, m.</summary>
    public float Radius = radius;
    /// <summary>Half the distance between the flat ends along Y, m.</summary>
    public float HalfLength = length * 0.5f;

    /// <summary>Distance between the flat ends along Y, m.</summary>
    public float Length
    {
        readonly get => HalfLength * 2;
        set => HalfLength = value * 0.5f;
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new ConvexShapeBatch<Cylinder, CylinderWide>(pool, initialCapacity);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        ShapeLimits.CheckSize(Radius, "cylinder", nameof(Radius));
        ShapeLimits.CheckSize(HalfLength, "cylinder", nameof(HalfLength));
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        OneLane.ComputeBounds<Cylinder, CylinderWide>(this, orientation, out min, out max);

    /// <inheritdoc/>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        maximumRadius = Exact.Length(new Vector3(Radius, HalfLength, 0));
        maximumAngularExpansion = maximumRadius - (Radius < HalfLength ? Radius : HalfLength);
    }

    /// <inheritdoc/>
    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        var squaredRadius = Radius * Radius;
        var across = squaredRadius * 0.25f + HalfLength * HalfLength * (1f / 3);
        return ShapeLimits.InvertInertia(mass, across, squaredRadius * 0.5f, across);
    }

    /// <inheritdoc/>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        OneLane.RayTest<Cylinder, CylinderWide>(this, pose, origin, direction, out t, out normal);
}

/// <summary>A bundle of cylinders.</summary>
public struct CylinderWide : IShapeWide<Cylinder>
{
    /// <inheritdoc cref="Cylinder.Radius"/>
    public Vector<float> Radius;
    /// <inheritdoc cref="Cylinder.HalfLength"/>
    public Vector<float> HalfLength;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = new Vector3Wide(Radius, HalfLength, Vector<float>.Zero).Length();
        maximumAngularExpansion = maximumRadius - Wide.Min(Radius, HalfLength);
        var axes = Matrix3x3Wide.FromQuaternion(orientation);
        // A disc reaches as far along a direction as the length of the direction's part within its plane; as one minus the square of the
        // part along the axis, that would lose its digits where the axis points along the direction.
        var within = axes.X * axes.X + axes.Z * axes.Z;
        var disc = new Vector3Wide(Vector.SquareRoot(within.X), Vector.SquareRoot(within.Y), Vector.SquareRoot(within.Z));
        max = disc * Radius + Vector3Wide.Abs(axes.Y) * HalfLength;
        min = -max;
    }

    /// <inheritdoc/>
    // The line is inside where it is both within the endless cylinder and between the planes of the ends.
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.Orientation);
        var line = new CenteredRayWide(ray, pose.Position);
        line.ToLocal(axes);
        BoxWide.IntersectSlab(line.Closest.Y, line.Direction.Y, HalfLength, out var endEntry, out var endExit);
        IntersectSide(line, out var sideEntry, out var sideExit);
        // A line that misses the side has NaN there, which is what these return for NaN, and no ray hits at NaN.
        var entry = Wide.Max(endEntry, sideEntry);
        var exit = Wide.Min(endExit, sideExit);
        line.Resolve(entry, exit, out hitMask, out var distance, out t);

        // What was entered last; for a ray that starts inside, what is nearest. In both cases the greatest number wins.
        var startsInside = Vector.LessThan(entry, line.Start);
        var point = line.At(distance);
        var zero = Vector<float>.Zero;
        var squaredFromAxis = point.X * point.X + point.Z * point.Z;
        var fromAxis = Vector.SquareRoot(squaredFromAxis);
        var endScore = Wide.Select(startsInside, Vector.Abs(point.Y) - HalfLength, endEntry);
        var sideScore = Wide.Select(startsInside, fromAxis - Radius, sideEntry);
        var useSide = Vector.GreaterThan(sideScore, endScore);
        // On the axis all of the side is equally near: against the ray, as far as that is across the axis, or else along X. Below 1e-7
        // radii an offset from the axis is rounding, not direction.
        var hasDirection = Vector.GreaterThan(fromAxis, Radius * new Vector<float>(1e-7f));
        var x = Wide.Select(hasDirection, point.X, -line.Direction.X);
        var z = Wide.Select(hasDirection, point.Z, -line.Direction.Z);
        var length = Vector.SquareRoot(x * x + z * z);
        var hasLength = Vector.GreaterThan(length, zero);
        var endNormal = Wide.Sign(Wide.Select(startsInside, point.Y, -line.Direction.Y));
        var local = new Vector3Wide(
            Wide.Mask(useSide, Wide.Select(hasLength, x / length, Vector<float>.One)),
            Wide.Select(useSide, zero, endNormal),
            Wide.Mask(useSide & hasLength, z / length));
        normal = Vector3Wide.Mask(hitMask, Matrix3x3Wide.TransposeTimes(axes, local));
    }

    /// <summary>Part of a line that is within the radius of the axis; NaN where none is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void IntersectSide(in CenteredRayWide line, out Vector<float> entry, out Vector<float> exit)
    {
        // Seen along the axis: a circle, and a line that is shortened. One that is shortened to less than this keeps its distance from the
        // axis, to rounding, over any chord: the interval is then everything or nothing.
        var p = line.Closest;
        var d = line.Direction;
        var length = Vector.SquareRoot(d.X * d.X + d.Z * d.Z);
        var parallel = Vector.LessThan(length, new Vector<float>(CenteredRayWide.ParallelSpeed));
        var inverse = Vector<float>.One / length;
        var x = d.X * inverse;
        var z = d.Z * inverse;
        var miss = p.X * z - p.Z * x;
        var middle = -(p.X * x + p.Z * z);
        var halfChord = Vector.SquareRoot(Radius * Radius - miss * miss);
        var isWithin = Vector.LessThanOrEqual(p.X * p.X + p.Z * p.Z, Radius * Radius);
        var everything = Wide.Select(isWithin, new Vector<float>(float.MaxValue), new Vector<float>(float.NaN));
        entry = Wide.Select(parallel, -everything, (middle - halfChord) * inverse);
        exit = Wide.Select(parallel, everything, (middle + halfChord) * inverse);
    }
}
