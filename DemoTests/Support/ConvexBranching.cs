using System;
using System.Collections.Generic;
using Demos.References;

namespace DemoTests.Support;

/// <summary>The least depth of all directions by branch and bound: it shows that nothing is less, for any shapes.</summary>
/// <remarks>
/// The depth along m is the greatest p.m of all points p of the difference of the shapes, so that each point of it bounds the depth from
/// below, in all directions at once. The directions are cut into triangles, with the farthest point along each corner. A direction within a
/// triangle is a sum of its corners with shares of zero or more, divided by the length of the sum: that is at most 1, and at least the cosine
/// of the greatest angle between a corner and the middle. So p.m is nowhere less than at the corner where it is least, and where that is
/// negative, than that divided by the cosine. Any p between the three farthest points may be taken, and that is taken which lies nearest to
/// the line along the middle: in a crease of the depth, and at the tip of a cone, the corners have points to all sides of that line, so that
/// what is lost falls with the square of the triangle's size there as elsewhere. The triangle with the least bound is cut in four, until it
/// meets the least depth that is known: in the mean after 50.
/// </remarks>
static class ConvexBranching
{
    readonly record struct Corner(Double3 Direction, Double3 Point);

    readonly record struct Triangle(Corner A, Corner B, Corner C);

    /// <summary>Looks for directions along which the depth is less than a value that may fall while they are found.</summary>
    /// <param name="support">Farthest point of the difference of the shapes in a unit direction.</param>
    /// <param name="limit">The value.</param>
    /// <param name="visit">
    /// Takes unit directions along which the depth is less than the limit, and the middles of small triangles in which it may be.
    /// </param>
    /// <param name="smallest">Angle, radians: triangles around smaller cones are not cut. Zero to cut them until they are shown to have nothing.</param>
    /// <param name="greatestCount">Triangles to cut at most: of a depth that is the same along a whole circle there is no end.</param>
    /// <returns>Whether nothing is less than the limit; with a smallest angle, whether nothing is but in triangles that were visited.</returns>
    public static bool Search(Func<Double3, Double3> support, Func<double> limit, Action<Double3> visit, double smallest, int greatestCount)
    {
        var open = new PriorityQueue<Triangle, double>();
        var greatestCosine = Math.Cos(smallest);
        for (int octant = 0; octant < 8; ++octant)
            Add(new(At(new((octant & 1) * 2 - 1, 0, 0)), At(new(0, (octant & 2) - 1, 0)), At(new(0, 0, (octant & 4) / 2 - 1))));
        for (int i = 0; i < greatestCount; ++i)
        {
            if (!open.TryDequeue(out var triangle, out var bound) || bound >= limit())
                return true;
            var (a, b, c) = triangle;
            var middle = Middle(triangle, out var cosine);
            if (smallest > 0 && cosine > greatestCosine)
            {
                visit(middle);
                continue;
            }
            var ab = At(a.Direction + b.Direction);
            var bc = At(b.Direction + c.Direction);
            var ca = At(c.Direction + a.Direction);
            Add(new(a, ab, ca));
            Add(new(b, bc, ab));
            Add(new(c, ca, bc));
            Add(new(ab, bc, ca));
        }
        return false;

        Corner At(Double3 direction)
        {
            direction *= 1 / direction.Length;
            var point = support(direction);
            if (Double3.Dot(point, direction) < limit())
                visit(direction);
            return new(direction, point);
        }

        void Add(in Triangle triangle)
        {
            var bound = Bound(triangle);
            if (bound < limit())
                open.Enqueue(triangle, bound);
        }
    }

    static Double3 Middle(in Triangle triangle, out double cosine)
    {
        var (a, b, c) = (triangle.A.Direction, triangle.B.Direction, triangle.C.Direction);
        var middle = a + b + c;
        middle *= 1 / middle.Length;
        cosine = Math.Min(Double3.Dot(middle, a), Math.Min(Double3.Dot(middle, b), Double3.Dot(middle, c)));
        return middle;
    }

    /// <summary>What the depth is at least in all directions of a triangle.</summary>
    static double Bound(in Triangle triangle)
    {
        var (a, b, c) = triangle;
        var middle = Middle(triangle, out var cosine);
        // Seen along the middle, p lies within the triangle of the three points or on its border: each of its points bounds the depth.
        var bound = Math.Max(Edge(a.Point, b.Point), Math.Max(Edge(b.Point, c.Point), Edge(c.Point, a.Point)));
        var u = b.Point - a.Point;
        var v = c.Point - a.Point;
        var area = Double3.Dot(Double3.Cross(u, v), middle);
        if (area == 0)
            return bound;
        var s = -Double3.Dot(Double3.Cross(a.Point, v), middle) / area;
        var t = -Double3.Dot(Double3.Cross(u, a.Point), middle) / area;
        return s < 0 || t < 0 || s + t > 1 ? bound : Math.Max(bound, Least(a.Point + u * s + v * t));

        double Edge(Double3 from, Double3 to)
        {
            var edge = to - from;
            var along = Double3.Dot(edge, middle);
            var squared = edge.LengthSquared - along * along;
            var place = -(Double3.Dot(edge, from) - along * Double3.Dot(middle, from));
            return Least(squared > 0 ? from + edge * Math.Clamp(place / squared, 0, 1) : from);
        }

        double Least(Double3 point)
        {
            var least = Math.Min(Double3.Dot(point, a.Direction), Math.Min(Double3.Dot(point, b.Direction), Double3.Dot(point, c.Direction)));
            return least >= 0 ? least : least / cosine;
        }
    }
}
