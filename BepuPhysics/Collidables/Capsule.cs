using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>All points within a radius of a segment: a cylinder along the local Y axis with a hemisphere on each end.</summary>
/// <param name="radius">Radius, 1e-6 to 1e7 m; checked when the shape is added.</param>
/// <param name="length">Length of the segment, without the hemispheres, 0 to 2e7 m; checked when the shape is added.</param>
public struct Capsule(float radius, float length) : IConvexShape
{
    /// <summary>Type id of capsules.</summary>
    public const int Id = 1;

    /// <summary>Radius, m.</summary>
    public float Radius = radius;
    /// <summary>Half the length of the segment along Y, m; the hemispheres are beyond it.</summary>
    public float HalfLength = length * 0.5f;

    /// <summary>Length of the segment along Y, m; the hemispheres are beyond it.</summary>
    public float Length
    {
        readonly get => HalfLength * 2;
        set => HalfLength = value * 0.5f;
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new ConvexShapeBatch<Capsule, CapsuleWide>(pool, initialCapacity);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        ShapeLimits.CheckSize(Radius, "capsule", nameof(Radius));
        ShapeLimits.CheckSizeOrZero(HalfLength, "capsule", nameof(HalfLength));
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        OneLane.ComputeBounds<Capsule, CapsuleWide>(this, orientation, out min, out max);

    /// <inheritdoc/>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        maximumRadius = HalfLength + Radius;
        maximumAngularExpansion = HalfLength;
    }

    /// <inheritdoc/>
    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        // A cylinder and a ball cut in two, all divided by pi r^2. The halves' centres are 3/8 r beyond the ends of the segment, which
        // with the parallel axis theorem leaves h^2 + 3/4 h r on top of the ball's own moment.
        var squaredRadius = Radius * Radius;
        var squaredHalfLength = HalfLength * HalfLength;
        var cylinder = 2 * HalfLength;
        var ball = Radius * (4f / 3);
        var cylinderShare = cylinder / (cylinder + ball);
        var ballShare = ball / (cylinder + ball);
        var ballMoment = squaredRadius * (2f / 5);
        var along = cylinderShare * (squaredRadius * 0.5f) + ballShare * ballMoment;
        var across = cylinderShare * (squaredRadius * 0.25f + squaredHalfLength * (1f / 3)) +
            ballShare * (ballMoment + squaredHalfLength + HalfLength * Radius * 0.75f);
        return ShapeLimits.InvertInertia(mass, across, along, across);
    }

    /// <inheritdoc/>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        OneLane.RayTest<Capsule, CapsuleWide>(this, pose, origin, direction, out t, out normal);
}

/// <summary>A bundle of capsules.</summary>
public struct CapsuleWide : IShapeWide<Capsule>
{
    /// <inheritdoc cref="Capsule.Radius"/>
    public Vector<float> Radius;
    /// <inheritdoc cref="Capsule.HalfLength"/>
    public Vector<float> HalfLength;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = HalfLength + Radius;
        maximumAngularExpansion = HalfLength;
        max = Vector3Wide.Abs(QuaternionWide.TransformUnitY(orientation)) * HalfLength + new Vector3Wide(Radius);
        min = -max;
    }

    /// <inheritdoc/>
    // The capsule is a union of two balls and a cylinder, and convex: the line is inside from the first entry into any of them to the
    // last exit. The flat ends of the cylinder are inside the balls, so only its curved side matters.
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.Orientation);
        var line = new CenteredRayWide(ray, pose.Position);
        line.ToLocal(axes);
        var entry = new Vector<float>(float.MaxValue);
        var exit = new Vector<float>(float.MinValue);
        AddBall(line, HalfLength, ref entry, ref exit);
        AddBall(line, -HalfLength, ref entry, ref exit);
        AddCylinder(line, ref entry, ref exit);
        line.Resolve(entry, exit, out hitMask, out var distance, out t);
        var fromAxis = line.At(distance);
        fromAxis.Y -= Wide.Clamp(fromAxis.Y, -HalfLength, HalfLength);
        normal = Vector3Wide.Mask(hitMask, Matrix3x3Wide.TransposeTimes(axes, line.NormalFromCore(fromAxis, Radius)));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddBall(in CenteredRayWide line, Vector<float> centerY, ref Vector<float> entry, ref Vector<float> exit)
    {
        var offset = line.Closest;
        offset.Y -= centerY;
        var along = Vector3Wide.Dot(offset, line.Direction);
        var squaredMiss = (offset - line.Direction * along).LengthSquared();
        var halfChord = Vector.SquareRoot(Radius * Radius - squaredMiss);
        // A line that misses has a NaN chord, which loses both comparisons.
        entry = Wide.Min(-along - halfChord, entry);
        exit = Wide.Max(halfChord - along, exit);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddCylinder(in CenteredRayWide line, ref Vector<float> entry, ref Vector<float> exit)
    {
        // Seen along the axis: a circle, and a line whose direction is shortened. A line along the axis has no direction there; its
        // intersections are infinite or NaN and so on no part of the side.
        var p = line.Closest;
        var d = line.Direction;
        var squaredLength = d.X * d.X + d.Z * d.Z;
        var cross = p.X * d.Z - p.Z * d.X;
        var middle = -(p.X * d.X + p.Z * d.Z) / squaredLength;
        var halfChord = Vector.SquareRoot(Radius * Radius * squaredLength - cross * cross) / squaredLength;
        var sideEntry = middle - halfChord;
        var sideExit = middle + halfChord;
        var entersSide = Vector.LessThanOrEqual(Vector.Abs(p.Y + d.Y * sideEntry), HalfLength);
        var leavesSide = Vector.LessThanOrEqual(Vector.Abs(p.Y + d.Y * sideExit), HalfLength);
        entry = Wide.Select(entersSide, Wide.Min(sideEntry, entry), entry);
        exit = Wide.Select(leavesSide, Wide.Max(sideExit, exit), exit);
    }
}
