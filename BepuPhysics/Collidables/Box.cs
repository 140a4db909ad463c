using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A box around the origin, its edges along the axes of its frame.</summary>
/// <param name="width">Extent along X, 2e-6 to 2e7 m; checked when the shape is added.</param>
/// <param name="height">Extent along Y, 2e-6 to 2e7 m; checked when the shape is added.</param>
/// <param name="length">Extent along Z, 2e-6 to 2e7 m; checked when the shape is added.</param>
public struct Box(float width, float height, float length) : IConvexShape
{
    /// <summary>Type id of boxes.</summary>
    public const int Id = 2;

    /// <summary>Half the extent along X, m.</summary>
    public float HalfWidth = width * 0.5f;
    /// <summary>Half the extent along Y, m.</summary>
    public float HalfHeight = height * 0.5f;
    /// <summary>Half the extent along Z, m.</summary>
    public float HalfLength = length * 0.5f;

    /// <summary>Extent along X, m.</summary>
    public float Width
    {
        readonly get => HalfWidth * 2;
        set => HalfWidth = value * 0.5f;
    }

    /// <summary>Extent along Y, m.</summary>
    public float Height
    {
        readonly get => HalfHeight * 2;
        set => HalfHeight = value * 0.5f;
    }

    /// <summary>Extent along Z, m.</summary>
    public float Length
    {
        readonly get => HalfLength * 2;
        set => HalfLength = value * 0.5f;
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new ConvexShapeBatch<Box, BoxWide>(pool, initialCapacity);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        ShapeLimits.CheckSize(HalfWidth, "box", nameof(HalfWidth));
        ShapeLimits.CheckSize(HalfHeight, "box", nameof(HalfHeight));
        ShapeLimits.CheckSize(HalfLength, "box", nameof(HalfLength));
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        OneLane.ComputeBounds<Box, BoxWide>(this, orientation, out min, out max);

    /// <inheritdoc/>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        maximumRadius = Exact.Length(new Vector3(HalfWidth, HalfHeight, HalfLength));
        var smaller = HalfWidth < HalfHeight ? HalfWidth : HalfHeight;
        maximumAngularExpansion = maximumRadius - (smaller < HalfLength ? smaller : HalfLength);
    }

    /// <inheritdoc/>
    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        var x = HalfWidth * HalfWidth;
        var y = HalfHeight * HalfHeight;
        var z = HalfLength * HalfLength;
        return ShapeLimits.InvertInertia(mass, (y + z) * (1f / 3), (x + z) * (1f / 3), (x + y) * (1f / 3));
    }

    /// <inheritdoc/>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        OneLane.RayTest<Box, BoxWide>(this, pose, origin, direction, out t, out normal);
}

/// <summary>A bundle of boxes.</summary>
public struct BoxWide : IShapeWide<Box>
{
    /// <inheritdoc cref="Box.HalfWidth"/>
    public Vector<float> HalfWidth;
    /// <inheritdoc cref="Box.HalfHeight"/>
    public Vector<float> HalfHeight;
    /// <inheritdoc cref="Box.HalfLength"/>
    public Vector<float> HalfLength;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = new Vector3Wide(HalfWidth, HalfHeight, HalfLength).Length();
        maximumAngularExpansion = maximumRadius - Wide.Min(Wide.Min(HalfWidth, HalfHeight), HalfLength);
        var axes = Matrix3x3Wide.FromQuaternion(orientation);
        max = Vector3Wide.Abs(axes.X) * HalfWidth + Vector3Wide.Abs(axes.Y) * HalfHeight + Vector3Wide.Abs(axes.Z) * HalfLength;
        min = -max;
    }

    /// <inheritdoc/>
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var axes = Matrix3x3Wide.FromQuaternion(pose.Orientation);
        var line = new CenteredRayWide(ray, pose.Position);
        line.ToLocal(axes);
        IntersectSlab(line.Closest.X, line.Direction.X, HalfWidth, out var entryX, out var exitX);
        IntersectSlab(line.Closest.Y, line.Direction.Y, HalfHeight, out var entryY, out var exitY);
        IntersectSlab(line.Closest.Z, line.Direction.Z, HalfLength, out var entryZ, out var exitZ);
        var entry = Wide.Max(Wide.Max(entryX, entryY), entryZ);
        var exit = Wide.Min(Wide.Min(exitX, exitY), exitZ);
        line.Resolve(entry, exit, out hitMask, out var distance, out t);

        // The face is the one entered last; for a ray that starts inside, the one that is nearest. In both cases the greatest number wins.
        var startsInside = Vector.LessThan(entry, line.Start);
        var point = line.At(distance);
        var scoreX = Wide.Select(startsInside, Vector.Abs(point.X) - HalfWidth, entryX);
        var scoreY = Wide.Select(startsInside, Vector.Abs(point.Y) - HalfHeight, entryY);
        var scoreZ = Wide.Select(startsInside, Vector.Abs(point.Z) - HalfLength, entryZ);
        var useX = Vector.GreaterThanOrEqual(scoreX, scoreY) & Vector.GreaterThanOrEqual(scoreX, scoreZ);
        var useY = Vector.AndNot(Vector.GreaterThanOrEqual(scoreY, scoreZ), useX);
        var outward = Vector3Wide.Select(startsInside, point, -line.Direction);
        var side = Wide.Sign(Wide.Select(useX, outward.X, Wide.Select(useY, outward.Y, outward.Z)));
        var axis = Vector3Wide.Select(useX, axes.X, Vector3Wide.Select(useY, axes.Y, axes.Z));
        normal = Vector3Wide.Mask(hitMask, axis * side);
    }

    /// <summary>Part of a line that is between two parallel planes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void IntersectSlab(
        Vector<float> position, Vector<float> direction, Vector<float> halfExtent, out Vector<float> entry, out Vector<float> exit)
    {
        // Along a parallel line the interval is everything or nothing. NaN directions come out as nothing in Resolve.
        var parallel = Vector.LessThan(Vector.Abs(direction), new Vector<float>(CenteredRayWide.ParallelSpeed));
        var inside = Vector.LessThanOrEqual(Vector.Abs(position), halfExtent);
        var everything = new Vector<float>(float.MaxValue);
        var toLower = (-halfExtent - position) / direction;
        var toUpper = (halfExtent - position) / direction;
        entry = Wide.Select(parallel, Wide.Select(inside, -everything, everything), Wide.Min(toLower, toUpper));
        exit = Wide.Select(parallel, Wide.Select(inside, everything, -everything), Wide.Max(toLower, toUpper));
    }
}
