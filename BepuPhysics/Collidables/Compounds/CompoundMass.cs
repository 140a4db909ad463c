using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Masses and second moments of bodies that are joined to one, summed up in doubles.</summary>
struct CompoundMass
{
    double mass, firstX, firstY, firstZ;
    InertiaTensor tensor;

    /// <summary>Adds the mass of a part, for the centre of mass.</summary>
    public void AddCenter(in Vector3 position, float partMass)
    {
        mass += partMass;
        firstX += (double)position.X * partMass;
        firstY += (double)position.Y * partMass;
        firstZ += (double)position.Z * partMass;
    }

    /// <summary>Mass of all parts, kg.</summary>
    public readonly double Mass => mass;

    /// <summary>Centre of mass of all parts, m; the origin where there is no mass.</summary>
    public readonly Vector3 Center =>
        mass > 0 ? new((float)(firstX / mass), (float)(firstY / mass), (float)(firstZ / mass)) : default;

    /// <summary>Adds the inertia of a part around the origin: its own, turned, and that of its mass at its place.</summary>
    /// <param name="pose">Pose of the part.</param>
    /// <param name="inverse">Inverse inertia of the part around its own centre; zero for a part that is a point.</param>
    /// <param name="partMass">Mass of the part, kg.</param>
    public void AddInertia(in RigidPose pose, in Symmetric3x3 inverse, float partMass)
    {
        double x = pose.Position.X, y = pose.Position.Y, z = pose.Position.Z;
        tensor.XX += partMass * (y * y + z * z);
        tensor.YY += partMass * (x * x + z * z);
        tensor.ZZ += partMass * (x * x + y * y);
        tensor.YX -= partMass * y * x;
        tensor.ZX -= partMass * z * x;
        tensor.ZY -= partMass * z * y;
        if (inverse.XX == 0 && inverse.YY == 0 && inverse.ZZ == 0)
            return;
        tensor += InertiaTensor.From(inverse).Invert().Rotate(pose.Orientation);
    }

    /// <summary>Adds mass and inertia of a part, as seen from a point.</summary>
    public void Add(in RigidPose pose, Vector3 origin, in Symmetric3x3 inverse, float partMass)
    {
        var seen = new RigidPose(pose.Position - origin, pose.Orientation);
        AddCenter(seen.Position, partMass);
        AddInertia(seen, inverse, partMass);
    }

    /// <summary>Inertia around the origin.</summary>
    public readonly Symmetric3x3 Inertia => tensor.ToFloats();

    /// <summary>Inverse mass and inertia around the origin.</summary>
    /// <exception cref="ArgumentException">The mass is out of range, or there is no inverse inertia that floats can hold.</exception>
    public readonly BodyInertia ToInverse()
    {
        if (!(mass >= ShapeLimits.MinimumMass && mass <= ShapeLimits.MaximumMass))
        {
            throw new ArgumentOutOfRangeException(
                nameof(mass), mass, $"The mass of all children must be from {ShapeLimits.MinimumMass} to {ShapeLimits.MaximumMass} kg.");
        }
        var error = InertiaRounding.Round(tensor.Invert(), out var inverse);
        if (!(error <= MassIntegrals.GreatestError) || !float.IsNormal(inverse.XX) || !float.IsNormal(inverse.YY) || !float.IsNormal(inverse.ZZ))
            throw new ArgumentException("Floats cannot hold the inverse inertia of these children: they have no extent, or are much longer than thick.");
        return new() { InverseMass = (float)(1 / mass), InverseInertiaTensor = inverse };
    }
}
