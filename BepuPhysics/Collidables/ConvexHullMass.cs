using System;

namespace BepuPhysics.Collidables;

/// <summary>Integrals over the inside of a closed surface of triangles, in double precision.</summary>
/// <remarks>
/// The inside is the sum of the tetrahedra from one point to the triangles, with signs. Over a tetrahedron from the origin to a, b, c with
/// d = a . (b x c): volume d / 6, integral of x is d / 24 (a + b + c), integral of x x^T is d / 120 (a a^T + b b^T + c c^T + s s^T)
/// with s = a + b + c.
/// </remarks>
struct ConvexHullMass
{
    // Products of inertia below this part of the moments are roundings of the sums: a hull that is symmetric has none.
    const double NoProduct = 1e-12;
    // Of the rounded inverse, relative: a percent, less what the sums and the rounding of the vertices add.
    internal const double GreatestError = 8e-3;

    /// <summary>Volume, m3.</summary>
    public double Volume;
    double firstX, firstY, firstZ;
    double secondXX, secondYX, secondYY, secondZX, secondZY, secondZZ;

    /// <summary>Centre of mass, m.</summary>
    public readonly (double X, double Y, double Z) Center => (firstX / Volume, firstY / Volume, firstZ / Volume);

    /// <summary>Adds the tetrahedron from the origin to a triangle, which is counterclockwise seen from outside.</summary>
    public void Add((double X, double Y, double Z) a, (double X, double Y, double Z) b, (double X, double Y, double Z) c)
    {
        var determinant = a.X * (b.Y * c.Z - b.Z * c.Y) + a.Y * (b.Z * c.X - b.X * c.Z) + a.Z * (b.X * c.Y - b.Y * c.X);
        double x = a.X + b.X + c.X, y = a.Y + b.Y + c.Y, z = a.Z + b.Z + c.Z;
        Volume += determinant * (1.0 / 6);
        var first = determinant * (1.0 / 24);
        firstX += first * x;
        firstY += first * y;
        firstZ += first * z;
        var second = determinant * (1.0 / 120);
        secondXX += second * (a.X * a.X + b.X * b.X + c.X * c.X + x * x);
        secondYX += second * (a.Y * a.X + b.Y * b.X + c.Y * c.X + y * x);
        secondYY += second * (a.Y * a.Y + b.Y * b.Y + c.Y * c.Y + y * y);
        secondZX += second * (a.Z * a.X + b.Z * b.X + c.Z * c.X + z * x);
        secondZY += second * (a.Z * a.Y + b.Z * b.Y + c.Z * c.Y + z * y);
        secondZZ += second * (a.Z * a.Z + b.Z * b.Z + c.Z * c.Z + z * z);
    }

    /// <summary>Inverse mass and inertia around the centre of mass of a hull filled uniformly.</summary>
    public static unsafe BodyInertia ComputeInertia(HullHeader* hull, float mass)
    {
        var integrals = default(ConvexHullMass);
        // In units of the hull's radius, so that no power of a size leaves the range even of a double's precision.
        var scale = 1.0 / hull->OuterRadius;
        for (int face = 0; face < hull->FaceCount; ++face)
        {
            int start = hull->FaceStarts[face], end = hull->FaceStarts[face + 1];
            var a = Scaled(hull, start, scale);
            var b = Scaled(hull, start + 1, scale);
            for (int i = start + 2; i < end; ++i)
            {
                var c = Scaled(hull, i, scale);
                integrals.Add(a, b, c);
                b = c;
            }
        }
        return integrals.Invert(mass, 1 / scale);
    }

    static unsafe (double X, double Y, double Z) Scaled(HullHeader* hull, int faceVertex, double scale)
    {
        var point = hull->GetPoint(hull->FaceVertices[faceVertex].Number);
        return (point.X * scale, point.Y * scale, point.Z * scale);
    }

    readonly BodyInertia Invert(float mass, double size)
    {
        var (x, y, z) = Center;
        double sumXX = secondXX / Volume - x * x, sumYY = secondYY / Volume - y * y, sumZZ = secondZZ / Volume - z * z;
        double xx = sumYY + sumZZ, yy = sumXX + sumZZ, zz = sumXX + sumYY;
        var yx = ProductOrZero(secondYX / Volume - y * x, xx, yy);
        var zx = ProductOrZero(secondZX / Volume - z * x, xx, zz);
        var zy = ProductOrZero(secondZY / Volume - z * y, yy, zz);
        // Inverse by cofactors.
        double cofactorXX = yy * zz - zy * zy, cofactorYX = zx * zy - yx * zz, cofactorZX = yx * zy - zx * yy;
        var inverse = 1 / (xx * cofactorXX + yx * cofactorYX + zx * cofactorZX) / (mass * size * size);
        var error = InertiaRounding.Round(
            [cofactorXX * inverse, cofactorYX * inverse, (xx * zz - zx * zx) * inverse,
            cofactorZX * inverse, (yx * zx - xx * zy) * inverse, (xx * yy - yx * yx) * inverse], out var tensor);
        var inertia = new BodyInertia { InverseMass = 1 / mass, InverseInertiaTensor = tensor };
        var isInRange = float.IsNormal(inertia.InverseMass) && IsPositive(tensor.XX) && IsPositive(tensor.YY) && IsPositive(tensor.ZZ);
        if (!(mass >= ShapeLimits.MinimumMass && mass <= ShapeLimits.MaximumMass) || !isInRange)
        {
            throw new ArgumentOutOfRangeException(
                nameof(mass), mass, $"A mass must be from {ShapeLimits.MinimumMass} to {ShapeLimits.MaximumMass} kg.");
        }
        if (!(error <= GreatestError))
        {
            throw new ArgumentException(
                "The hull is so much longer than thick that floats cannot hold its inverse inertia in axes at an angle to it. " +
                "Turn its points so that its length is along an axis, and its bodies the other way.");
        }
        return inertia;
    }

    static bool IsPositive(float value) => value > 0 && float.IsNormal(value);

    // The product of inertia is the negative of the mixed sum.
    static double ProductOrZero(double mixed, double momentA, double momentB) =>
        mixed * mixed <= NoProduct * NoProduct * momentA * momentB ? 0 : -mixed;
}
