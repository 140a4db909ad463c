using System;
using System.Collections.Generic;
using BepuPhysics.Collidables;
using Demos.References;

namespace DemoTests.Collidables;

/// <summary>Shapes as signed distance functions in double precision, and what can be computed from a distance alone.</summary>
static class ShapeOracle
{
    /// <summary>Distance from a point in the shape's frame to its surface, negative inside.</summary>
    public static double Distance<TShape>(TShape shape, Double3 p) where TShape : unmanaged, IConvexShape => shape switch
    {
        Sphere sphere => p.Length - sphere.Radius,
        Capsule capsule => (p with { Y = p.Y - Math.Clamp(p.Y, -capsule.HalfLength, capsule.HalfLength) }).Length - capsule.Radius,
        Box box => BoxDistance(box, p),
        Cylinder cylinder => CylinderDistance(cylinder, p),
        _ => throw new NotSupportedException(),
    };

    /// <summary>Largest and smallest extent of a shape.</summary>
    public static (double Largest, double Smallest) Size<TShape>(TShape shape) where TShape : unmanaged, IConvexShape => shape switch
    {
        Sphere sphere => (sphere.Radius, sphere.Radius),
        Capsule capsule => ((double)capsule.Radius + capsule.HalfLength, capsule.Radius),
        Box box => (
            new Double3(box.HalfWidth, box.HalfHeight, box.HalfLength).Length,
            Math.Min(box.HalfWidth, Math.Min(box.HalfHeight, box.HalfLength))),
        Cylinder cylinder => (
            new Double3(cylinder.Radius, cylinder.HalfLength, 0).Length, Math.Min(cylinder.Radius, cylinder.HalfLength)),
        _ => throw new NotSupportedException(),
    };

    /// <summary>Points whose convex hull, grown by a radius, is the shape.</summary>
    public static (IReadOnlyList<Double3> Corners, double Radius) Core<TShape>(TShape shape) where TShape : unmanaged, IConvexShape
    {
        if (shape is Sphere sphere)
            return ([Double3.Zero], sphere.Radius);
        if (shape is Capsule capsule)
            return ([new(0, capsule.HalfLength, 0), new(0, -capsule.HalfLength, 0)], capsule.Radius);
        var box = (Box)(object)shape;
        var corners = new List<Double3>();
        for (int i = 0; i < 8; ++i)
        {
            var signs = new Double3(1 - (i & 1) * 2, 1 - (i & 2), 1 - (i & 4) / 2);
            corners.Add(Double3.Scale(signs, new(box.HalfWidth, box.HalfHeight, box.HalfLength)));
        }
        return (corners, 0);
    }

    /// <summary>Points of the surface in directions spread evenly over the sphere.</summary>
    public static IEnumerable<Double3> SampleSurface<TShape>(TShape shape, int count) where TShape : unmanaged, IConvexShape
    {
        var reach = Size(shape).Largest * 1.01;
        for (int i = 0; i < count; ++i)
        {
            // Fibonacci lattice.
            var y = 1 - (2 * i + 1.0) / count;
            var ring = Math.Sqrt(1 - y * y);
            var angle = i * Math.PI * (3 - Math.Sqrt(5));
            var direction = new Double3(ring * Math.Cos(angle), y, ring * Math.Sin(angle));
            yield return direction * Bisect(s => Distance(shape, direction * s) > 0, 0, reach);
        }
    }

    /// <summary>Moments of inertia per mass around the axes of the frame, by summing columns whose ends are found on the surface.</summary>
    public static Double3 MomentsPerMass<TShape>(TShape shape, int resolution) where TShape : unmanaged, IConvexShape
    {
        // All shapes here are symmetric to the three coordinate planes, so one octant is enough.
        double volume = 0, xx = 0, yy = 0, zz = 0;
        var reach = Size(shape).Largest * 1.01;
        var endX = Bisect(s => Distance(shape, new(s, 0, 0)) > 0, 0, reach);
        for (int i = 0; i < resolution; ++i)
        {
            // Steps by the sine of an angle: the square root at a round end becomes smooth.
            var angleX = (i + 0.5) / resolution * Math.PI / 2;
            var x = endX * Math.Sin(angleX);
            var endY = Bisect(s => Distance(shape, new(x, s, 0)) > 0, 0, reach);
            for (int j = 0; j < resolution; ++j)
            {
                var angleY = (j + 0.5) / resolution * Math.PI / 2;
                var y = endY * Math.Sin(angleY);
                var endZ = Bisect(s => Distance(shape, new(x, y, s)) > 0, 0, reach);
                var column = endZ * endX * Math.Cos(angleX) * endY * Math.Cos(angleY);
                volume += column;
                xx += column * x * x;
                yy += column * y * y;
                zz += column * endZ * endZ / 3;
            }
        }
        return new Double3(yy + zz, xx + zz, xx + yy) * (1 / volume);
    }

    /// <summary>What a ray in the shape's frame meets.</summary>
    /// <param name="shape">The shape.</param>
    /// <param name="origin">Start of the ray.</param>
    /// <param name="direction">Unit direction.</param>
    /// <returns>
    /// Least distance of the ray to the surface (negative: how deep it passes), and where it enters, in metres from its start.
    /// </returns>
    public static (double Clearance, double Entry) CastRay<TShape>(TShape shape, Double3 origin, Double3 direction)
        where TShape : unmanaged, IConvexShape
    {
        // Along a line the distance to a convex shape is a convex function: its minimum is found by golden sections, and the way there
        // crosses the surface at most once.
        double DistanceAt(double s) => Distance(shape, origin + direction * s);
        double low = 0, high = origin.Length + 2 * Size(shape).Largest;
        for (int i = 0; i < 200; ++i)
        {
            var a = low + (high - low) * 0.381966011250105;
            var b = low + (high - low) * 0.618033988749895;
            if (DistanceAt(a) <= DistanceAt(b))
                high = b;
            else
                low = a;
        }
        var deepest = DistanceAt(0) <= DistanceAt(low) ? 0 : low;
        var clearance = DistanceAt(deepest);
        var entry = clearance > 0 || DistanceAt(0) <= 0 ? 0 : Bisect(s => DistanceAt(s) <= 0, 0, deepest);
        return (clearance, entry);
    }

    static double BoxDistance(Box box, Double3 p)
    {
        var x = Math.Abs(p.X) - box.HalfWidth;
        var y = Math.Abs(p.Y) - box.HalfHeight;
        var z = Math.Abs(p.Z) - box.HalfLength;
        var outside = new Double3(Math.Max(x, 0), Math.Max(y, 0), Math.Max(z, 0)).Length;
        return outside > 0 ? outside : Math.Max(x, Math.Max(y, z));
    }

    static double CylinderDistance(Cylinder cylinder, Double3 p)
    {
        var side = Math.Sqrt(p.X * p.X + p.Z * p.Z) - cylinder.Radius;
        var end = Math.Abs(p.Y) - cylinder.HalfLength;
        return side > 0 && end > 0 ? Math.Sqrt(side * side + end * end) : Math.Max(side, end);
    }

    /// <summary>Where a condition that is false at the low end and true at the high end becomes true.</summary>
    static double Bisect(Func<double, bool> condition, double low, double high)
    {
        for (int i = 0; i < 60; ++i)
        {
            var middle = 0.5 * (low + high);
            if (condition(middle))
                high = middle;
            else
                low = middle;
        }
        return 0.5 * (low + high);
    }
}
