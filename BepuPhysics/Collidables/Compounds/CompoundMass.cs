using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Masses and second moments of bodies that are joined to one, summed up in doubles.</summary>
struct CompoundMass
{
    double mass, firstX, firstY, firstZ;
    double xx, yx, yy, zx, zy, zz;

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
        xx += partMass * (y * y + z * z);
        yy += partMass * (x * x + z * z);
        zz += partMass * (x * x + y * y);
        yx -= partMass * y * x;
        zx -= partMass * z * x;
        zy -= partMass * z * y;
        if (inverse.XX == 0 && inverse.YY == 0 && inverse.ZZ == 0)
            return;
        Invert(inverse.XX, inverse.YX, inverse.YY, inverse.ZX, inverse.ZY, inverse.ZZ,
            out var iXX, out var iYX, out var iYY, out var iZX, out var iZY, out var iZZ);
        // R I transpose(R), by the columns of R.
        double qx = pose.Orientation.X, qy = pose.Orientation.Y, qz = pose.Orientation.Z, qw = pose.Orientation.W;
        double aX = 1 - 2 * (qy * qy + qz * qz), aY = 2 * (qx * qy + qz * qw), aZ = 2 * (qx * qz - qy * qw);
        double bX = 2 * (qx * qy - qz * qw), bY = 1 - 2 * (qx * qx + qz * qz), bZ = 2 * (qy * qz + qx * qw);
        double cX = 2 * (qx * qz + qy * qw), cY = 2 * (qy * qz - qx * qw), cZ = 1 - 2 * (qx * qx + qy * qy);
        double uX = iXX * aX + iYX * bX + iZX * cX, vX = iYX * aX + iYY * bX + iZY * cX, wX = iZX * aX + iZY * bX + iZZ * cX;
        double uY = iXX * aY + iYX * bY + iZX * cY, vY = iYX * aY + iYY * bY + iZY * cY, wY = iZX * aY + iZY * bY + iZZ * cY;
        double uZ = iXX * aZ + iYX * bZ + iZX * cZ, vZ = iYX * aZ + iYY * bZ + iZY * cZ, wZ = iZX * aZ + iZY * bZ + iZZ * cZ;
        xx += aX * uX + bX * vX + cX * wX;
        yx += aY * uX + bY * vX + cY * wX;
        yy += aY * uY + bY * vY + cY * wY;
        zx += aZ * uX + bZ * vX + cZ * wX;
        zy += aZ * uY + bZ * vY + cZ * wY;
        zz += aZ * uZ + bZ * vZ + cZ * wZ;
    }

    /// <summary>Inertia around the origin.</summary>
    public readonly Symmetric3x3 Inertia => new((float)xx, (float)yx, (float)yy, (float)zx, (float)zy, (float)zz);

    /// <summary>Inverse mass and inertia around the origin.</summary>
    /// <exception cref="ArgumentException">The mass is out of range, or there is no inverse inertia that floats can hold.</exception>
    public readonly BodyInertia ToInverse()
    {
        if (!(mass >= ShapeLimits.MinimumMass && mass <= ShapeLimits.MaximumMass))
        {
            throw new ArgumentOutOfRangeException(
                nameof(mass), mass, $"The mass of all children must be from {ShapeLimits.MinimumMass} to {ShapeLimits.MaximumMass} kg.");
        }
        Invert(xx, yx, yy, zx, zy, zz, out var iXX, out var iYX, out var iYY, out var iZX, out var iZY, out var iZZ);
        var error = InertiaRounding.Round([iXX, iYX, iYY, iZX, iZY, iZZ], out var tensor);
        if (!(error <= MassIntegrals.GreatestError) || !float.IsNormal(tensor.XX) || !float.IsNormal(tensor.YY) || !float.IsNormal(tensor.ZZ))
            throw new ArgumentException("Floats cannot hold the inverse inertia of these children: they have no extent, or are much longer than thick.");
        return new() { InverseMass = (float)(1 / mass), InverseInertiaTensor = tensor };
    }

    static void Invert(double xx, double yx, double yy, double zx, double zy, double zz,
        out double iXX, out double iYX, out double iYY, out double iZX, out double iZY, out double iZZ)
    {
        double cXX = yy * zz - zy * zy, cYX = zx * zy - yx * zz, cZX = yx * zy - zx * yy;
        var scale = 1 / (xx * cXX + yx * cYX + zx * cZX);
        iXX = cXX * scale;
        iYX = cYX * scale;
        iYY = (xx * zz - zx * zx) * scale;
        iZX = cZX * scale;
        iZY = (yx * zx - xx * zy) * scale;
        iZZ = (xx * yy - yx * yx) * scale;
    }
}
