using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Checks of the values in constraint descriptions.</summary>
static class ConstraintChecks
{
    internal static void Offset(Vector3 value, string name) => Bounded(value, Limits.MaximumOffset, name);

    internal static void Position(Vector3 value, string name) => Bounded(value, Limits.MaximumPosition, name);

    static void Bounded(Vector3 value, float maximum, string name)
    {
        if (!(MathF.Abs(value.X) <= maximum && MathF.Abs(value.Y) <= maximum && MathF.Abs(value.Z) <= maximum))
            throw new ArgumentException($"{name} must be finite and at most {maximum} in each component, not {value}.", name);
    }

    internal static void Offset(float value, string name)
    {
        if (!(MathF.Abs(value) <= Limits.MaximumOffset))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be finite and at most {Limits.MaximumOffset} m.");
    }

    internal static void Finite(float value, string name)
    {
        if (!float.IsFinite(value))
            throw new ArgumentException($"{name} must be finite, not {value}.", name);
    }

    internal static void Distance(float value, string name)
    {
        if (!(value >= 0 && value <= Limits.MaximumDistance))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be from 0 to {Limits.MaximumDistance} m.");
    }

    internal static void Cosine(float value, string name)
    {
        if (!(value >= -1 && value <= 1))
            throw new ArgumentOutOfRangeException(name, value, "A cosine must be from -1 to 1.");
    }

    internal static void Unit(Vector3 value, string name)
    {
        if (!BodyChecks.HasUnitLength(Exact.LengthSquared(value)))
            throw new ArgumentException($"{name} must have unit length, not {value}.", name);
    }

    internal static void Unit(Quaternion value, string name)
    {
        if (!BodyChecks.HasUnitLength(Exact.Dot(value, value)))
            throw new ArgumentException($"{name} must have unit length, not {value}.", name);
    }

    internal static void Spring(in SpringSettings value, string name)
    {
        if (!SpringSettings.Validate(value))
            throw new ArgumentException(
                $"{name} must not be negative, at most {Limits.MaximumSpringFrequency} Hz and of a damping ratio of at most {Limits.MaximumDampingRatio}, " +
                $"not an angular frequency of {value.AngularFrequency} and twice a damping ratio of {value.TwiceDampingRatio}.", name);
    }

    internal static void Servo(in ServoSettings value, string name)
    {
        if (!ServoSettings.Validate(value))
            throw new ArgumentException(
                $"{name} must not be negative or NaN, with a base speed of at most {Limits.MaximumServoBaseSpeed}, not maximum speed " +
                $"{value.MaximumSpeed}, base speed {value.BaseSpeed}, maximum force {value.MaximumForce}.", name);
    }

    internal static void Motor(in MotorSettings value, string name)
    {
        if (!MotorSettings.Validate(value))
            throw new ArgumentException(
                $"{name} must not be negative or NaN, not maximum force {value.MaximumForce}, damping {value.Damping}.", name);
    }

    internal static void AngularVelocity(float value, string name)
    {
        if (!(MathF.Abs(value) <= Limits.MaximumAngularVelocity))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be finite and at most {Limits.MaximumAngularVelocity} rad/s.");
    }

    internal static void AngularVelocity(Vector3 value, string name) => Bounded(value, Limits.MaximumAngularVelocity, name);

    internal static void LinearVelocity(float value, string name)
    {
        if (!(MathF.Abs(value) <= Limits.MaximumLinearVelocity))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be finite and at most {Limits.MaximumLinearVelocity} m/s.");
    }

    internal static void LinearVelocity(Vector3 value, string name) => Bounded(value, Limits.MaximumLinearVelocity, name);

    internal static void Angle(float value, string name)
    {
        if (!(MathF.Abs(value) <= Limits.MaximumAngle))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be finite and at most {Limits.MaximumAngle} radians.");
    }

    internal static void GearRatio(float value, string name)
    {
        if (!(MathF.Abs(value) <= Limits.MaximumGearRatio))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be finite and at most {Limits.MaximumGearRatio}.");
    }

    internal static void RopeRatio(float value, string name)
    {
        if (!(value > 0 && value <= Limits.MaximumGearRatio))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be positive and at most {Limits.MaximumGearRatio}.");
    }

    internal static void Teeth(float value, string name)
    {
        const float Maximum = 1000;
        if (!(MathF.Abs(value) >= 1 && MathF.Abs(value) <= Maximum && value == MathF.Floor(value)))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be a whole number of at least 1 and at most {Maximum}, or its negative.");
    }

    // Of smaller ones a turn is next to no way.
    internal static void PinionRadius(float value, string name)
    {
        const float Minimum = 1e-3f;
        if (!(MathF.Abs(value) >= Minimum && MathF.Abs(value) <= Limits.MaximumOffset))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be at least {Minimum} and at most {Limits.MaximumOffset} m, or its negative.");
    }

    // The square and the cube of a distance that constraints take.
    internal static void Area(float value, string name)
    {
        if (!(value >= 0 && value <= Limits.MaximumDistance * Limits.MaximumDistance))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be from 0 to {Limits.MaximumDistance * Limits.MaximumDistance} m^2.");
    }

    internal static void Volume(float value, string name)
    {
        const float Maximum = Limits.MaximumDistance * Limits.MaximumDistance * Limits.MaximumDistance;
        if (!(MathF.Abs(value) <= Maximum))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must be finite and at most {Maximum} m^3.");
    }

    internal static void Order(float minimum, float maximum, string minimumName, string maximumName)
    {
        Finite(minimum, minimumName);
        Finite(maximum, maximumName);
        if (minimum > maximum)
            throw new ArgumentException($"{minimumName} ({minimum}) must not be above {maximumName} ({maximum}).", minimumName);
    }
}
