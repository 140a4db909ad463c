using System;

namespace BepuPhysics.Collidables;

/// <summary>Integrals over the inside of a closed surface of triangles, or over the surface itself, in double precision.</summary>
/// <remarks>
/// The inside is the sum of the tetrahedra from one point to the triangles, with signs. Over a tetrahedron from the origin to a, b, c with
/// d = a . (b x c): volume d / 6, integral of x is d / 24 (a + b + c), integral of x x^T is d / 120 (a a^T + b b^T + c c^T + s s^T)
/// with s = a + b + c. Over a triangle of area w: integral of x is w / 3 s, that of x x^T is w / 12 (a a^T + b b^T + c c^T + s s^T).
/// </remarks>
struct MassIntegrals
{
    // Products of inertia below this part of the moments are roundings of the sums: a hull that is symmetric has none.
    const double NoProduct = 1e-12;
    // Of the rounded inverse, relative: a percent, less what the sums and the rounding of the vertices add.
    internal const double GreatestError = 8e-3;

    /// <summary>Volume, m3, or area, m2.</summary>
    public double Measure;
    double firstX, firstY, firstZ;
    double secondXX, secondYX, secondYY, secondZX, secondZY, secondZZ;

    /// <summary>Centre of mass, m.</summary>
    public readonly (double X, double Y, double Z) Center => (firstX / Measure, firstY / Measure, firstZ / Measure);

    /// <summary>Adds the tetrahedron from the origin to a triangle, which is counterclockwise seen from outside.</summary>
    public void AddTetrahedron((double X, double Y, double Z) a, (double X, double Y, double Z) b, (double X, double Y, double Z) c)
    {
        var determinant = a.X * (b.Y * c.Z - b.Z * c.Y) + a.Y * (b.Z * c.X - b.X * c.Z) + a.Z * (b.X * c.Y - b.Y * c.X);
        Add(determinant, 1.0 / 6, 1.0 / 24, 1.0 / 120, a, b, c);
    }

    /// <summary>Adds a triangle of a thin sheet.</summary>
    public void AddTriangle((double X, double Y, double Z) a, (double X, double Y, double Z) b, (double X, double Y, double Z) c)
    {
        double abX = b.X - a.X, abY = b.Y - a.Y, abZ = b.Z - a.Z, acX = c.X - a.X, acY = c.Y - a.Y, acZ = c.Z - a.Z;
        double x = abY * acZ - abZ * acY, y = abZ * acX - abX * acZ, z = abX * acY - abY * acX;
        Add(Math.Sqrt(x * x + y * y + z * z), 1.0 / 2, 1.0 / 6, 1.0 / 24, a, b, c);
    }

    void Add(double weight, double zeroth, double first, double second,
        in (double X, double Y, double Z) a, in (double X, double Y, double Z) b, in (double X, double Y, double Z) c)
    {
        double x = a.X + b.X + c.X, y = a.Y + b.Y + c.Y, z = a.Z + b.Z + c.Z;
        Measure += weight * zeroth;
        first *= weight;
        firstX += first * x;
        firstY += first * y;
        firstZ += first * z;
        second *= weight;
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
        var integrals = default(MassIntegrals);
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
                integrals.AddTetrahedron(a, b, c);
                b = c;
            }
        }
        return integrals.Invert(mass, 1 / scale, aroundCenter: true);
    }

    static unsafe (double X, double Y, double Z) Scaled(HullHeader* hull, int faceVertex, double scale)
    {
        var point = hull->GetPoint(hull->FaceVertices[faceVertex].Number);
        return (point.X * scale, point.Y * scale, point.Z * scale);
    }

    /// <summary>Moments and products of inertia per mass, around the centre of mass or around the origin.</summary>
    public readonly InertiaTensor GetMoments(bool aroundCenter)
    {
        var (x, y, z) = aroundCenter ? Center : default;
        double sumXX = secondXX / Measure - x * x, sumYY = secondYY / Measure - y * y, sumZZ = secondZZ / Measure - z * z;
        double xx = sumYY + sumZZ, yy = sumXX + sumZZ, zz = sumXX + sumYY;
        return new()
        {
            XX = xx,
            YX = ProductOrZero(secondYX / Measure - y * x, xx, yy),
            YY = yy,
            ZX = ProductOrZero(secondZX / Measure - z * x, xx, zz),
            ZY = ProductOrZero(secondZY / Measure - z * y, yy, zz),
            ZZ = zz,
        };
    }

    /// <summary>Inverse mass and inertia, around the centre of mass or around the origin.</summary>
    /// <param name="mass">Mass, kg.</param>
    /// <param name="size">Unit in which coordinates were added, m.</param>
    /// <param name="aroundCenter">Whether around the centre of mass.</param>
    public readonly BodyInertia Invert(float mass, double size, bool aroundCenter)
    {
        var error = InertiaRounding.Round(GetMoments(aroundCenter).Invert(mass * size * size), out var tensor);
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
                "The shape is so much longer than thick that floats cannot hold its inverse inertia in axes at an angle to it. " +
                "Turn its points so that its length is along an axis, and its bodies the other way.");
        }
        return inertia;
    }

    static bool IsPositive(float value) => value > 0 && float.IsNormal(value);

    // The product of inertia is the negative of the mixed sum.
    static double ProductOrZero(double mixed, double momentA, double momentB) =>
        mixed * mixed <= NoProduct * NoProduct * momentA * momentB ? 0 : -mixed;
}
