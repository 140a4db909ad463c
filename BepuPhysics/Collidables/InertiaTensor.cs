using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>A symmetric tensor in doubles, of an inertia or its inverse, before it is rounded: sums and inverses of what is thin cancel.</summary>
struct InertiaTensor
{
    public double XX, YX, YY, ZX, ZY, ZZ;

    public static InertiaTensor From(in Symmetric3x3 m) => new() { XX = m.XX, YX = m.YX, YY = m.YY, ZX = m.ZX, ZY = m.ZY, ZZ = m.ZZ };

    public static InertiaTensor operator +(in InertiaTensor a, in InertiaTensor b) => new()
    {
        XX = a.XX + b.XX,
        YX = a.YX + b.YX,
        YY = a.YY + b.YY,
        ZX = a.ZX + b.ZX,
        ZY = a.ZY + b.ZY,
        ZZ = a.ZZ + b.ZZ,
    };

    /// <summary>R I transpose(R) for the rotation R of a frame in which this is the tensor I.</summary>
    public readonly InertiaTensor Rotate(in Quaternion orientation)
    {
        double qx = orientation.X, qy = orientation.Y, qz = orientation.Z, qw = orientation.W;
        // Columns of R.
        double aX = 1 - 2 * (qy * qy + qz * qz), aY = 2 * (qx * qy + qz * qw), aZ = 2 * (qx * qz - qy * qw);
        double bX = 2 * (qx * qy - qz * qw), bY = 1 - 2 * (qx * qx + qz * qz), bZ = 2 * (qy * qz + qx * qw);
        double cX = 2 * (qx * qz + qy * qw), cY = 2 * (qy * qz - qx * qw), cZ = 1 - 2 * (qx * qx + qy * qy);
        // Columns of I transpose(R).
        double xA = XX * aX + YX * bX + ZX * cX, xB = YX * aX + YY * bX + ZY * cX, xC = ZX * aX + ZY * bX + ZZ * cX;
        double yA = XX * aY + YX * bY + ZX * cY, yB = YX * aY + YY * bY + ZY * cY, yC = ZX * aY + ZY * bY + ZZ * cY;
        double zA = XX * aZ + YX * bZ + ZX * cZ, zB = YX * aZ + YY * bZ + ZY * cZ, zC = ZX * aZ + ZY * bZ + ZZ * cZ;
        return new()
        {
            XX = aX * xA + bX * xB + cX * xC,
            YX = aY * xA + bY * xB + cY * xC,
            YY = aY * yA + bY * yB + cY * yC,
            ZX = aZ * xA + bZ * xB + cZ * xC,
            ZY = aZ * yA + bZ * yB + cZ * yC,
            ZZ = aZ * zA + bZ * zB + cZ * zC,
        };
    }

    /// <summary>The inverse by cofactors, divided by a number.</summary>
    public readonly InertiaTensor Invert(double divisor = 1)
    {
        double xx = YY * ZZ - ZY * ZY, yx = ZX * ZY - YX * ZZ, zx = YX * ZY - YY * ZX;
        var scale = 1 / (XX * xx + YX * yx + ZX * zx) / divisor;
        return new()
        {
            XX = xx * scale,
            YX = yx * scale,
            YY = (XX * ZZ - ZX * ZX) * scale,
            ZX = zx * scale,
            ZY = (YX * ZX - XX * ZY) * scale,
            ZZ = (XX * YY - YX * YX) * scale,
        };
    }

    /// <summary>Each entry, times a number, as the nearest float.</summary>
    public readonly Symmetric3x3 ToFloats(double factor = 1) => new(
        (float)(XX * factor), (float)(YX * factor), (float)(YY * factor), (float)(ZX * factor), (float)(ZY * factor), (float)(ZZ * factor));
}
