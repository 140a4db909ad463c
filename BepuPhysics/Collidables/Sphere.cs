using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A ball around the origin.</summary>
/// <param name="radius">Radius, 1e-6 to 1e7 m; checked when the shape is added.</param>
public struct Sphere(float radius) : IConvexShape
{
    /// <summary>Type id of spheres.</summary>
    public const int Id = 0;

    /// <summary>Radius, m.</summary>
    public float Radius = radius;

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new ConvexShapeBatch<Sphere, SphereWide>(pool, initialCapacity);

    /// <inheritdoc/>
    public readonly void Validate() => ShapeLimits.CheckSize(Radius, "sphere", nameof(Radius));

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        min = new(-Radius);
        max = new(Radius);
    }

    /// <inheritdoc/>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        maximumRadius = Radius;
        maximumAngularExpansion = 0;
    }

    /// <inheritdoc/>
    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        var moment = Radius * Radius * (2f / 5);
        return ShapeLimits.InvertInertia(mass, moment, moment, moment);
    }

    /// <inheritdoc/>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        OneLane.RayTest<Sphere, SphereWide>(this, pose, origin, direction, out t, out normal);
}

/// <summary>A bundle of spheres.</summary>
public struct SphereWide : IShapeWide<Sphere>
{
    /// <inheritdoc cref="Sphere.Radius"/>
    public Vector<float> Radius;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        maximumRadius = Radius;
        maximumAngularExpansion = Vector<float>.Zero;
        max = new(Radius);
        min = -max;
    }

    /// <inheritdoc/>
    public readonly void RayTest(
        in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        var line = new CenteredRayWide(ray, pose.Position);
        var discriminant = Radius * Radius - line.Closest.LengthSquared();
        // The root of a negative discriminant is NaN, and no distance is less than that.
        var halfChord = Vector.SquareRoot(discriminant);
        line.Resolve(-halfChord, halfChord, out hitMask, out var distance, out t);
        normal = Vector3Wide.Mask(hitMask, line.NormalFromCore(line.At(distance), Radius));
    }
}
