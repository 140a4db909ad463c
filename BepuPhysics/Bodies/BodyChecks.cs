using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Checks of the values that describe bodies and statics.</summary>
static class BodyChecks
{
    const float LeastInverseMass = 1 / Limits.MaximumMass, GreatestInverseMass = 1 / Limits.MinimumMass;

    internal static bool HasUnitLength(float lengthSquared) => UnitTolerance.Holds(lengthSquared, UnitTolerance.Described);

    internal static void Position(Vector3 value, string name) => Bounded(value, Limits.MaximumPosition, name);

    /// <summary>Whether a position that may be described still may once it is seen from a new origin.</summary>
    internal static void ShiftedPosition(Vector3 value, Vector3 shift)
    {
        if (!IsBounded(value, Limits.MaximumPosition) || IsBounded(value - shift, Limits.MaximumPosition))
            return;
        throw new ArgumentException(
            $"What is at {value} would be beyond {Limits.MaximumPosition} m, seen from {shift}. Nothing was changed.", nameof(shift));
    }

    internal static void Velocity(in BodyVelocity value)
    {
        Bounded(value.Linear, Limits.MaximumLinearVelocity, "linear velocity");
        Bounded(value.Angular, Limits.MaximumAngularVelocity, "angular velocity");
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

    /// <summary>A pose that was checked, with an orientation that turns normals into unit normals; what rounding leaves of it is left as it is.</summary>
    internal static RigidPose Straighten(in RigidPose pose)
    {
        var q = pose.Orientation;
        return UnitTolerance.Holds(Exact.Dot(q, q), UnitTolerance.Combined) ? pose : new(pose.Position, Exact.Normalize(q));
    }

    internal static void Inertia(in BodyInertia inertia)
    {
        if (inertia.InverseMass != 0 && !(inertia.InverseMass >= LeastInverseMass && inertia.InverseMass <= GreatestInverseMass))
        {
            throw new ArgumentException(
                $"The inverse mass must be 0, or from {LeastInverseMass} to {GreatestInverseMass} 1/kg, not {inertia.InverseMass}.", nameof(inertia));
        }
        var i = inertia.InverseInertiaTensor;
        Bounded(new(i.XX, i.YY, i.ZZ), Limits.MaximumInverseInertia, "inverse inertia");
        Bounded(new(i.YX, i.ZX, i.ZY), Limits.MaximumInverseInertia, "inverse inertia");
        if (!IsPositiveSemidefinite(i))
        {
            throw new ArgumentException(
                "The inverse inertia must have no negative principal moment, as it would gain energy by being turned, and be zero or have one of at " +
                $"least {Limits.MinimumInverseInertia} 1/(kg m2); not " +
                $"({i.XX}, {i.YY}, {i.ZZ}) on the diagonal and ({i.YX}, {i.ZX}, {i.ZY}) below it.", nameof(inertia));
        }
    }

    /// <summary>Whether no principal moment is negative by more than rounding.</summary>
    // A tensor of a locked axis, or of a needle, that was turned in floats may have lost its least moment to rounding: some times 2^-24 of the
    // trace. With that added, a matrix without a negative eigenvalue has three positive pivots; a double has digits to spare for them.
    static bool IsPositiveSemidefinite(in Symmetric3x3 tensor)
    {
        const double Rounding = 1.0 / (1 << 20);
        double trace = (double)tensor.XX + tensor.YY + tensor.ZZ, yx = tensor.YX, zx = tensor.ZX, zy = tensor.ZY;
        if (tensor.XX < 0 || tensor.YY < 0 || tensor.ZZ < 0)
            return false;
        if (trace == 0)
            return yx == 0 && zx == 0 && zy == 0;
        if (trace < Limits.MinimumInverseInertia)
            return false;
        double xx = tensor.XX + trace * Rounding, yy = tensor.YY + trace * Rounding, zz = tensor.ZZ + trace * Rounding;
        yy -= yx * yx / xx;
        zy -= yx * zx / xx;
        zz -= zx * zx / xx;
        return yy > 0 && zz - zy * zy / yy > 0;
    }

    internal static void Activity(in BodyActivityDescription activity)
    {
        if (float.IsNaN(activity.SleepThreshold))
            throw new ArgumentException("The sleep threshold must not be NaN.", nameof(activity));
    }

    internal static void Vector(Vector3 value, string name) => Bounded(value, Limits.MaximumImpulse, name);

    static bool IsBounded(Vector3 value, float maximum) =>
        MathF.Abs(value.X) <= maximum && MathF.Abs(value.Y) <= maximum && MathF.Abs(value.Z) <= maximum;

    static void Bounded(Vector3 value, float maximum, string name)
    {
        if (!IsBounded(value, maximum))
            throw new ArgumentException($"The {name} must be finite and at most {maximum} in each component, not {value}.", name);
    }
}
