using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Checks of the values in constraint descriptions.</summary>
static class ConstraintChecks
{
    /// <summary>Greatest length of an offset, m: squares and products with velocities must stay finite in float.</summary>
    const float MaximumLength = 1e12f;

    internal static void Finite(Vector3 value, string name)
    {
        if (!(MathF.Abs(value.X) <= MaximumLength && MathF.Abs(value.Y) <= MaximumLength && MathF.Abs(value.Z) <= MaximumLength))
            throw new ArgumentException($"{name} must be finite and at most {MaximumLength} in each component, not {value}.", name);
    }

    internal static void Finite(float value, string name)
    {
        if (!float.IsFinite(value))
            throw new ArgumentException($"{name} must be finite, not {value}.", name);
    }

    internal static void NotNegative(float value, string name)
    {
        if (!(value >= 0))
            throw new ArgumentOutOfRangeException(name, value, $"{name} must not be negative or NaN.");
    }

    internal static void Cosine(float value, string name)
    {
        if (!(value >= -1 && value <= 1))
            throw new ArgumentOutOfRangeException(name, value, "A cosine must be from -1 to 1.");
    }

    internal static void Unit(Vector3 value, string name)
    {
        Finite(value, name);
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
                $"{name} must be finite and not negative, not an angular frequency of {value.AngularFrequency} " +
                $"and twice a damping ratio of {value.TwiceDampingRatio}.", name);
    }

    internal static void Servo(in ServoSettings value, string name)
    {
        if (!ServoSettings.Validate(value))
            throw new ArgumentException(
                $"{name} must not be negative or NaN, not maximum speed {value.MaximumSpeed}, base speed {value.BaseSpeed}, " +
                $"maximum force {value.MaximumForce}.", name);
    }

    internal static void Order(float minimum, float maximum, string minimumName, string maximumName)
    {
        Finite(minimum, minimumName);
        Finite(maximum, maximumName);
        if (minimum > maximum)
            throw new ArgumentException($"{minimumName} ({minimum}) must not be above {maximumName} ({maximum}).", minimumName);
    }
}
