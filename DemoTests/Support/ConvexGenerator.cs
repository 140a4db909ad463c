using System;
using System.Linq;
using System.Numerics;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Forms of shapes: how thin they are.</summary>
public enum ConvexForm
{
    /// <summary>All sizes alike, within a factor of five.</summary>
    Fat,

    /// <summary>A plate, a disc, a triangle with a short side: one size is 1/100 of the others.</summary>
    Flat,

    /// <summary>A needle, a rod: one size is 100 times the others. For triangles, two corners nearly coincide.</summary>
    Slender,
}

/// <summary>Random convex shapes with an outer radius of about a given size.</summary>
public static class ConvexGenerator
{
    /// <summary>Half of the shapes are fat.</summary>
    public static ConvexForm NextForm(ConvexRandom random) =>
        random.Next(4) switch { 0 => ConvexForm.Flat, 1 => ConvexForm.Slender, _ => ConvexForm.Fat };

    public static ConvexShape Create(ConvexKind kind, ConvexForm form, double size, ConvexRandom random)
    {
        // From 1/20 to 1/100: thinner ones only where a form is asked for.
        var thin = random.NextLogarithmic(0.01, 0.05) * size;
        switch (kind)
        {
            case ConvexKind.Sphere:
                return ConvexShape.Sphere((float)(size * random.Next(0.3, 1)));
            case ConvexKind.Capsule:
                return form switch
                {
                    ConvexForm.Slender => ConvexShape.Capsule((float)thin, (float)(2 * size)),
                    ConvexForm.Flat => ConvexShape.Capsule((float)(size * random.Next(0.3, 1)), (float)(random.Next(2) * thin)),
                    _ => ConvexShape.Capsule((float)(size * random.Next(0.1, 0.5)), (float)(size * random.Next(0.2, 1.5))),
                };
            case ConvexKind.Cylinder:
                return form switch
                {
                    ConvexForm.Slender => ConvexShape.Cylinder((float)thin, (float)(2 * size)),
                    ConvexForm.Flat => ConvexShape.Cylinder((float)(size * random.Next(0.5, 1)), (float)(2 * thin)),
                    _ => ConvexShape.Cylinder((float)(size * random.Next(0.2, 0.8)), (float)(size * random.Next(0.2, 1.6))),
                };
            case ConvexKind.Triangle:
                return CreateTriangle(form, size, thin, random);
        }
        var extents = form switch
        {
            ConvexForm.Slender => new Double3(size, thin, thin * random.Next(0.5, 1)),
            ConvexForm.Flat => new Double3(size * random.Next(0.4, 1), thin, size),
            _ => new Double3(size * random.Next(0.2, 1), size * random.Next(0.2, 1), size),
        };
        if (kind == ConvexKind.Box)
            return ConvexShape.Box((float)(1.2 * extents.X), (float)(1.2 * extents.Y), (float)(1.2 * extents.Z));
        return CreateHull(extents, random);
    }

    static ConvexShape CreateTriangle(ConvexForm form, double size, double thin, ConvexRandom random)
    {
        var origin = random.Next(2) == 0 ? Double3.Zero : random.NextDirection() * (size * random.Next(0, 2));
        var u = random.NextDirection();
        var v = Double3.Cross(u, random.NextDirection());
        v *= 1 / v.Length;
        var (a, b, c) = form switch
        {
            // Flat: the third corner close to the opposite edge. Slender: two corners close to each other.
            ConvexForm.Flat => (u * size, u * -size, v * thin + u * (size * random.Next(-0.8, 0.8))),
            ConvexForm.Slender => (u * size, u * -size, v * thin - u * size),
            _ => (u * size, u * (size * random.Next(-1, -0.3)), v * (size * random.Next(0.5, 1))),
        };
        return ConvexShape.Triangle(ToVector(a + origin), ToVector(b + origin), ToVector(c + origin));
    }

    /// <summary>Eight to 32 points on an ellipsoid; every fourth is a prism, whose faces have many corners and lie in parallel.</summary>
    static ConvexShape CreateHull(Double3 extents, ConvexRandom random)
    {
        if (random.Next(4) == 0)
        {
            var sides = 3 + random.Next(8);
            return ConvexShape.Hull([.. Enumerable.Range(0, 2 * sides).Select(i =>
            {
                var angle = 2 * Math.PI * (i / 2) / sides;
                return ToVector(Double3.Scale(extents, new(Math.Cos(angle), i % 2 * 2 - 1, Math.Sin(angle))) * 0.8);
            })]);
        }
        var count = 8 + random.Next(25);
        return ConvexShape.Hull([.. Enumerable.Range(0, count).Select(_ =>
            ToVector(Double3.Scale(extents, random.NextDirection()) * random.Next(0.85, 1)))]);
    }

    public static Vector3 ToVector(Double3 v) => new((float)v.X, (float)v.Y, (float)v.Z);
}
