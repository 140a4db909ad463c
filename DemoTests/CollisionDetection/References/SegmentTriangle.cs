using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;

namespace DemoTests.CollisionDetection.References;

/// <summary>
/// A segment and a triangle in double precision, by what defines their distance and depth; a sphere's centre is a segment without length.
/// </summary>
sealed class SegmentTriangle
{
    readonly Double3[] corners;
    readonly Double3 axis;
    readonly double halfLength;

    /// <summary>Unit normal of the triangle's front.</summary>
    public readonly Double3 Front;

    /// <summary>Height of the segment's centre, the origin, over the plane.</summary>
    public readonly double CenterHeight;

    public SegmentTriangle(Triangle triangle, Vector3 offset, Quaternion orientation, Double3 axis, double halfLength)
    {
        var x = Double3.RotatedAxis(orientation, 0);
        var y = Double3.RotatedAxis(orientation, 1);
        var z = Double3.RotatedAxis(orientation, 2);
        corners = [.. new[] { triangle.A, triangle.B, triangle.C }.Select(p => new Double3(offset) + x * p.X + y * p.Y + z * p.Z)];
        var front = Double3.Cross(corners[2] - corners[0], corners[1] - corners[0]);
        Front = front * (1 / front.Length);
        CenterHeight = -Double3.Dot(Front, corners[0]);
        this.axis = axis;
        this.halfLength = halfLength;
    }

    /// <summary>Distance from the origin of the triangle's frame, which is at the offset, to its farthest corner.</summary>
    public double Reach(Vector3 offset) => corners.Max(p => (p - new Double3(offset)).Length);

    /// <summary>Distance from the centroid to the farthest corner.</summary>
    public double TriangleSize => corners.Max(p => (p - (corners[0] + corners[1] + corners[2]) * (1.0 / 3)).Length);

    /// <summary>Depth of the two along a unit direction from the triangle to the segment.</summary>
    public double DepthAlong(Double3 normal) =>
        corners.Max(p => Double3.Dot(p, normal)) + halfLength * Math.Abs(Double3.Dot(axis, normal));

    /// <summary>Offset from the nearest point of the triangle to a point.</summary>
    public Double3 FromTriangle(Double3 point)
    {
        // Inside all three edges it is the height; otherwise one of the edges is nearest.
        var best = new Double3(double.MaxValue, 0, 0);
        var isOver = true;
        for (int i = 0; i < 3; ++i)
        {
            var start = corners[i];
            var edge = corners[(i + 1) % 3] - start;
            isOver &= Double3.Dot(Double3.Cross(edge, point - start), Front) <= 0;
            var part = Math.Clamp(Double3.Dot(point - start, edge) / Double3.Dot(edge, edge), 0, 1);
            var offset = point - start - edge * part;
            if (offset.Length < best.Length)
                best = offset;
        }
        return isOver ? Front * Double3.Dot(point - corners[0], Front) : best;
    }

    /// <summary>Distance of a point from the segment.</summary>
    public double FromSegment(Double3 point) => (point - axis * Math.Clamp(Double3.Dot(point, axis), -halfLength, halfLength)).Length;

    /// <summary>Whether the segment passes through the triangle.</summary>
    public bool Crosses
    {
        get
        {
            var rise = Double3.Dot(Front, axis) * halfLength;
            if ((CenterHeight - rise) * (CenterHeight + rise) > 0 || rise == 0)
                return false;
            return FromTriangle(axis * (-CenterHeight / rise * halfLength)).Length < 1e-14 * (halfLength + TriangleSize);
        }
    }

    /// <summary>From the triangle to the segment where they are nearest; zero where they cross.</summary>
    public Double3 Separation
    {
        get
        {
            if (Crosses)
                return default;
            // The distance from a convex set is a convex function along the segment.
            double low = -halfLength, high = halfLength;
            for (int i = 0; i < 120; ++i)
            {
                var a = low + (high - low) * 0.381966011250105;
                var b = low + (high - low) * 0.618033988749895;
                if (FromTriangle(axis * a).Length <= FromTriangle(axis * b).Length)
                    high = b;
                else
                    low = a;
            }
            var best = FromTriangle(axis * low);
            foreach (var s in (ReadOnlySpan<double>)[-halfLength, halfLength, -CenterHeight / Double3.Dot(Front, axis)])
            {
                if (Math.Abs(s) <= halfLength && FromTriangle(axis * s).Length < best.Length)
                    best = FromTriangle(axis * s);
            }
            return best;
        }
    }

    /// <summary>
    /// Depths along the normals of the faces of the Minkowski difference, with how far each points to the front, as the cosine of the angle
    /// to it. For a segment that crosses the triangle, the least of these depths is the least of all.
    /// </summary>
    public IEnumerable<(double Depth, double Facing)> AxisDepths()
    {
        yield return (DepthAlong(Front), 1);
        yield return (DepthAlong(-Front), -1);
        for (int i = 0; i < 3; ++i)
        {
            var across = Double3.Cross(axis, corners[(i + 1) % 3] - corners[i]);
            if (across.Length < 1e-9 * TriangleSize)
                continue;
            across *= 1 / across.Length;
            // Away from the corner that is not on the edge: the other way is no normal of a face.
            if (Double3.Dot(across, corners[(i + 2) % 3] - corners[i]) > 0)
                across = -across;
            yield return (DepthAlong(across), Double3.Dot(across, Front));
        }
    }

    /// <summary>Least depth of a segment that crosses the triangle.</summary>
    public double LeastDepth => AxisDepths().Min(x => x.Depth);
}
