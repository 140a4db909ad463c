using System;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>What sizes shapes may have, and how the inertia of a solid follows from them.</summary>
/// <remarks>
/// Within these limits and for masses from 1e-9 to 1e12 kg no product of the simulation leaves the range of a float: moments of
/// inertia are from 1e-21 to 1e26 kg m2. Sizes of one shape may differ by any ratio, but positions within it are rounded
/// relative to its largest size, so a feature a million times smaller is not resolved.
/// </remarks>
static class ShapeLimits
{
    /// <summary>Greatest type id of the library's own shapes.</summary>
    public const int LastTypeId = HalfSpace.Id;

    /// <summary>Least radius or half extent, m.</summary>
    public const float MinimumSize = Limits.MinimumSize;
    /// <summary>Greatest radius or half extent, m.</summary>
    public const float MaximumSize = Limits.MaximumSize;

    /// <summary>Whether a radius or half extent is within the limits; NaN is not.</summary>
    public static bool IsSize(float size) => size >= MinimumSize && size <= MaximumSize;

    /// <summary>Refuses a radius or half extent outside the limits; NaN is outside.</summary>
    public static void CheckSize(float size, string shape, string field)
    {
        if (!IsSize(size))
            throw new ArgumentOutOfRangeException(field, size, $"{field} of a {shape} must be from {MinimumSize} to {MaximumSize} m.");
    }

    /// <summary>Least and greatest mass of a body, kg.</summary>
    public const float MinimumMass = Limits.MinimumMass, MaximumMass = Limits.MaximumMass;

    /// <summary>Refuses a half length outside zero and the upper limit; NaN is outside.</summary>
    public static void CheckSizeOrZero(float size, string shape, string field)
    {
        if (!(size >= 0 && size <= MaximumSize))
            throw new ArgumentOutOfRangeException(field, size, $"{field} of a {shape} must be from 0 to {MaximumSize} m.");
    }

    /// <summary>Inverse inertia of a body from its mass and its moments per mass around the three axes of its frame, m2.</summary>
    public static BodyInertia InvertInertia(float mass, float momentX, float momentY, float momentZ)
    {
        // Mass and moments are inverted one after the other: their product is the first to leave the range of a float.
        var inverseMass = 1 / mass;
        var inertia = new BodyInertia
        {
            InverseMass = inverseMass,
            InverseInertiaTensor = Symmetric3x3.Diagonal(inverseMass / momentX, inverseMass / momentY, inverseMass / momentZ),
        };
        ref var tensor = ref inertia.InverseInertiaTensor;
        var isInRange = float.IsNormal(inverseMass) && float.IsNormal(tensor.XX) && float.IsNormal(tensor.YY) && float.IsNormal(tensor.ZZ);
        if (!(mass >= MinimumMass && mass <= MaximumMass) || !isInRange)
            throw new ArgumentOutOfRangeException(nameof(mass), mass, $"A mass must be from {MinimumMass} to {MaximumMass} kg.");
        return inertia;
    }
}
