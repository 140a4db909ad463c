using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.OwnShapes;

/// <summary>A shape without faces and edges: nothing but half axes and a farthest point.</summary>
public struct Ellipsoid(float x, float y, float z) : IConvexShape
{
    public float X = x, Y = y, Z = z;

    public static int TypeId => 127;

    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new SupportShapeBatch<Ellipsoid, EllipsoidWide, EllipsoidSupport>(pool, initialCapacity);

    public readonly void Validate()
    {
        if (!(X > 0 && Y > 0 && Z > 0))
            throw new ArgumentException("An ellipsoid has three half axes.");
    }

    public readonly BodyInertia ComputeInertia(float mass)
    {
        var inertia = new BodyInertia { InverseMass = 1 / mass };
        inertia.InverseInertiaTensor.XX = 5 / (mass * (Y * Y + Z * Z));
        inertia.InverseInertiaTensor.YY = 5 / (mass * (X * X + Z * Z));
        inertia.InverseInertiaTensor.ZZ = 5 / (mass * (X * X + Y * Y));
        return inertia;
    }

    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        ConvexSupport<EllipsoidWide, EllipsoidSupport>.GetBounds(Lanes.Broadcast<Ellipsoid, EllipsoidWide>(this), orientation, out min, out max);

    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion) =>
        ConvexSupport<EllipsoidWide, EllipsoidSupport>.ComputeAngularExpansionData(
            Lanes.Broadcast<Ellipsoid, EllipsoidWide>(this), out maximumRadius, out maximumAngularExpansion);

    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        ConvexSupport<EllipsoidWide, EllipsoidSupport>.RayTest(
            Lanes.Broadcast<Ellipsoid, EllipsoidWide>(this), pose, origin, direction, out t, out normal);
}

public struct EllipsoidWide : IShapeWide<Ellipsoid>
{
    public Vector<float> X, Y, Z;

    public readonly void GetBounds(in QuaternionWide orientation, out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion,
        out Vector3Wide min, out Vector3Wide max) =>
        ConvexSupport<EllipsoidWide, EllipsoidSupport>.GetBounds(this, orientation, out maximumRadius, out maximumAngularExpansion, out min, out max);

    public readonly void RayTest(in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal) =>
        ConvexSupport<EllipsoidWide, EllipsoidSupport>.RayTest(this, pose, ray, out hitMask, out t, out normal);
}

public struct EllipsoidSupport : ISupport<EllipsoidWide>
{
    public static Vector<float> Margin(in EllipsoidWide shape) => Vector<float>.Zero;

    public static void GetExtents(in EllipsoidWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        inner = Wide.Min(shape.X, Wide.Min(shape.Y, shape.Z));
        outer = Wide.Max(shape.X, Wide.Max(shape.Y, shape.Z));
    }

    public static Vector3Wide Support(in EllipsoidWide shape, in Vector3Wide direction, Vector<int> doneMask)
    {
        var scaled = new Vector3Wide(shape.X * direction.X, shape.Y * direction.Y, shape.Z * direction.Z);
        var inverse = Wide.DivideOrZero(Vector<float>.One, scaled.Length());
        return new(shape.X * scaled.X * inverse, shape.Y * scaled.Y * inverse, shape.Z * scaled.Z * inverse);
    }
}
