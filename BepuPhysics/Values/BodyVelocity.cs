using System.Numerics;
using System.Runtime.InteropServices;

namespace BepuPhysics;

/// <summary>Velocity of a body in world space.</summary>
/// <remarks>32 bytes, so that a bundle of bodies is read by one transpose of eight floats each.</remarks>
[StructLayout(LayoutKind.Explicit, Size = 32)]
public struct BodyVelocity(Vector3 linear, Vector3 angular)
{
    /// <summary>Velocity of the centre of mass, m/s.</summary>
    [FieldOffset(0)] public Vector3 Linear = linear;
    /// <summary>Angular velocity, rad/s.</summary>
    [FieldOffset(16)] public Vector3 Angular = angular;

    /// <summary>Velocity without rotation.</summary>
    public BodyVelocity(Vector3 linear) : this(linear, default) { }

    /// <summary>Velocity without rotation.</summary>
    public static implicit operator BodyVelocity(Vector3 linear) => new(linear);
    /// <summary>Linear and angular velocity.</summary>
    public static implicit operator BodyVelocity((Vector3 linear, Vector3 angular) velocity) => new(velocity.linear, velocity.angular);
}
