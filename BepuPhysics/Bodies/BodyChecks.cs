using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Checks of the values that describe bodies and statics.</summary>
static class BodyChecks
{
    /// <summary>Greatest coordinate of a position, m.</summary>
    // Squares and products of three lengths must stay finite in float.
    internal const float MaximumPosition = 1e12f;
    /// <summary>Greatest component of a velocity, m/s or rad/s.</summary>
    internal const float MaximumVelocity = 1e12f;
    /// <summary>Greatest component of an impulse, N s, or of the arm at which it acts, m.</summary>
    const float MaximumImpulse = 1e15f;
    /// <summary>Greatest inverse mass and least mass; the reciprocal bounds the other end.</summary>
    internal const float MaximumInverseMass = 1e15f;
    const float MinimumInverseMass = 1e-15f;
    /// <summary>Greatest entry of an inverse inertia tensor.</summary>
    // A 1 mm cube of 1e-6 kg has 6e12 / (kg m2).
    internal const float MaximumInverseInertia = 1e25f;
    /// <summary>Greatest deviation of a squared length from 1 that still counts as a unit vector or quaternion.</summary>
    // Wide enough for user code that normalises in float and rounds on the way, narrow enough to find what was never normalised.
    const float UnitTolerance = 1e-2f;

    internal static bool HasUnitLength(float lengthSquared) => MathF.Abs(lengthSquared - 1) <= UnitTolerance;

    internal static void Position(Vector3 value, string name) => Bounded(value, MaximumPosition, name);

    internal static void Velocity(in BodyVelocity value)
    {
        Bounded(value.Linear, MaximumVelocity, "linear velocity");
        Bounded(value.Angular, MaximumVelocity, "angular velocity");
    }

    internal static void Pose(in RigidPose pose)
    {
        Position(pose.Position, "position");
        Orientation(pose.Orientation, "orientation");
    }

    internal static void Orientation(Quaternion value, string name)
    {
        if (!HasUnitLength(Exact.Dot(value, value)))
            throw new ArgumentException($"The {name} must be a quaternion of unit length, not {value}.", name);
    }

    internal static void Inertia(in BodyInertia inertia)
    {
        if (inertia.InverseMass != 0 && !(inertia.InverseMass >= MinimumInverseMass && inertia.InverseMass <= MaximumInverseMass))
        {
            throw new ArgumentException(
                $"The inverse mass must be 0, or from {MinimumInverseMass} to {MaximumInverseMass} 1/kg, not {inertia.InverseMass}.", nameof(inertia));
        }
        var i = inertia.InverseInertiaTensor;
        Bounded(new(i.XX, i.YY, i.ZZ), MaximumInverseInertia, "inverse inertia");
        Bounded(new(i.YX, i.ZX, i.ZY), MaximumInverseInertia, "inverse inertia");
        // A symmetric matrix with a negative principal minor would gain energy by being turned.
        const float Rounding = 1e-5f;
        if (i.XX < 0 || i.YY < 0 || i.ZZ < 0 ||
            i.YX * i.YX > i.XX * i.YY * (1 + Rounding) || i.ZX * i.ZX > i.XX * i.ZZ * (1 + Rounding) || i.ZY * i.ZY > i.YY * i.ZZ * (1 + Rounding))
            throw new ArgumentException($"The inverse inertia must have no negative principal moment, not the diagonal ({i.XX}, {i.YY}, {i.ZZ}).",
                nameof(inertia));
    }

    internal static void Activity(in BodyActivityDescription activity)
    {
        if (float.IsNaN(activity.SleepThreshold))
            throw new ArgumentException("The sleep threshold must not be NaN.", nameof(activity));
    }

    internal static void Vector(Vector3 value, string name) => Bounded(value, MaximumImpulse, name);

    static void Bounded(Vector3 value, float maximum, string name)
    {
        if (!(MathF.Abs(value.X) <= maximum && MathF.Abs(value.Y) <= maximum && MathF.Abs(value.Z) <= maximum))
            throw new ArgumentException($"The {name} must be finite and at most {maximum} in each component, not {value}.", name);
    }
}
