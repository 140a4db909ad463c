using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>One row of a contact between two bodies: what velocity it sees, and what an impulse along it does.</summary>
readonly struct ContactRow(Vector3 linear, Vector3 angularA, Vector3 angularB)
{
    readonly Vector3 linear = linear;
    readonly Vector3 angularA = angularA;
    readonly Vector3 angularB = angularB;

    /// <summary>The row at an arm about A in a direction.</summary>
    /// <param name="arm">Position relative to the centre of A.</param>
    /// <param name="direction">Unit direction, in which A is pushed.</param>
    /// <param name="offsetB">Position of B relative to A.</param>
    internal static ContactRow At(Vector3 arm, Vector3 direction, Vector3 offsetB) =>
        new(direction, Exact.Cross(arm, direction), Exact.Cross(direction, arm - offsetB));

    /// <summary>A unit vector across a direction; the second one is their cross product.</summary>
    // A frame without a branch, as wide kernels have it, is across to what rounds in one: in a row of balls that bounce without loss that grows.
    internal static Vector3 Across(in Vector3 direction) =>
        Exact.Normalize(Exact.Cross(direction, MathF.Abs(direction.X) < MathF.Abs(direction.Y) ? Vector3.UnitX : Vector3.UnitY));

    /// <summary>Velocity of A against B along the row.</summary>
    internal float Along(in BodyVelocity a, in BodyVelocity b) =>
        Exact.Dot(a.Linear, linear) + Exact.Dot(a.Angular, angularA) + (Exact.Dot(b.Angular, angularB) - Exact.Dot(b.Linear, linear));

    /// <summary>What an impulse along the row adds to the velocity of A.</summary>
    internal BodyVelocity ResponseOfA(in BodyInertia inertia, float impulse) =>
        new(linear * (inertia.InverseMass * impulse), inertia.InverseInertiaTensor * (angularA * impulse));

    /// <summary>What an impulse along the row adds to the velocity of B.</summary>
    internal BodyVelocity ResponseOfB(in BodyInertia inertia, float impulse) =>
        new(linear * -(inertia.InverseMass * impulse), inertia.InverseInertiaTensor * (angularB * impulse));
}
