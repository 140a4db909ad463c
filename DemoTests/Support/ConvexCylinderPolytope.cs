using System;
using System.Collections.Generic;
using System.Linq;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Depth of a cylinder and a polytope by trying all pairs of features, in the cylinder's frame.</summary>
/// <remarks>
/// With u a direction out of the cylinder and w the vertices of the polytope, f(u) = r |u across Y| + h |u.Y| - min w.u. Its least value
/// is at one of these: Y and -Y (a cap); minus the normal of a face; across Y and an edge (the side meets the edge); on the arc of
/// directions in which an edge is the farthest (the rim meets the edge), which is searched; and for a vertex, towards it across Y (the side)
/// or from the rim (when apart). A vertex within has no nearest point on the rim, as that is convex.
/// </remarks>
sealed class ConvexCylinderPolytope : IConvexSearch
{
    readonly ConvexShape polytope;
    readonly double radius;
    readonly double halfLength;
    readonly bool cylinderIsA;
    readonly ConvexRotation rotation;
    // Relative to the polytope's origin, in the cylinder's frame.
    readonly Double3[] vertices;
    readonly List<(Double3 Direction, double Extent)> axes = [];
    readonly List<Arc> arcs = [];
    readonly List<Double3> minima = [];

    /// <summary>Directions out of the cylinder that an edge meets first.</summary>
    readonly record struct Arc(Double3 Start, Double3 Across, double Angle, int Vertex);

    public ConvexCylinderPolytope(ConvexShape a, ConvexShape b, ConvexRotation rotation)
    {
        cylinderIsA = a.IsCylinder;
        var cylinder = cylinderIsA ? a : b;
        polytope = cylinderIsA ? b : a;
        radius = cylinder.Radius;
        halfLength = cylinder.HalfLength;
        this.rotation = rotation;
        var toCylinder = cylinderIsA ? rotation : rotation.Transposed;
        vertices = [.. polytope.Vertices.Select(toCylinder.Rotate)];
        AddAxis(new(0, 1, 0));
        AddAxis(new(0, -1, 0));
        var faces = polytope.FaceNormals.Select(n => -toCylinder.Rotate(n)).ToArray();
        foreach (var n in faces)
            AddAxis(n);
        foreach (var edge in polytope.Edges)
        {
            var e = vertices[edge.B] - vertices[edge.A];
            var length = e.Length;
            if (length == 0)
                continue;
            e *= 1 / length;
            var across = new Double3(e.Z, 0, -e.X);
            if (across.Length > 1e-12)
            {
                across *= 1 / across.Length;
                AddAxis(across);
                AddAxis(-across);
            }
            AddArc(edge, e, faces);
        }
    }

    public (double Depth, double AxisDepth) Find(Double3 offset, ConvexCandidates found)
    {
        // From the cylinder's centre to the polytope's origin, in the cylinder's frame.
        var q = cylinderIsA ? offset : -rotation.RotateBack(offset);
        foreach (var (direction, extent) in axes)
            Add(extent - Double3.Dot(direction, q), direction, found);
        foreach (var v in vertices)
        {
            var w = v + q;
            var reach = Math.Sqrt(w.X * w.X + w.Z * w.Z);
            var outwards = reach > 0 ? new Double3(w.X / reach, 0, w.Z / reach) : new(1, 0, 0);
            Add(Value(outwards, q), outwards, found);
            var aboveCap = Math.Abs(w.Y) - halfLength;
            if (reach > radius && aboveCap > 0)
            {
                var fromRim = outwards * (reach - radius) + new Double3(0, Math.CopySign(aboveCap, w.Y), 0);
                fromRim *= 1 / fromRim.Length;
                Add(Value(fromRim, q), fromRim, found);
            }
        }
        var reachOfCylinder = Math.Sqrt(radius * radius + halfLength * halfLength);
        foreach (var arc in arcs)
        {
            var w = vertices[arc.Vertex] + q;
            minima.Clear();
            var limit = found.Least + found.Tolerance;
            ConvexArc.Minimise(arc.Start, arc.Across, arc.Angle, reachOfCylinder + w.Length, ref limit, found.Tolerance,
                u => CylinderExtent(u) - Double3.Dot(u, w), minima);
            foreach (var u in minima)
            {
                var unit = u * (1 / u.Length);
                Add(Value(unit, q), unit, found);
            }
        }
        return (found.Least, found.Least);
    }

    void Add(double depth, Double3 u, ConvexCandidates found) => found.Add(depth, cylinderIsA ? u : -rotation.Rotate(u));

    void AddAxis(Double3 direction) => axes.Add((direction, Value(direction, default)));

    void AddArc(ConvexEdge edge, Double3 along, Double3[] faces)
    {
        if (edge.FaceA < 0)
        {
            // A segment alone: all directions across it.
            var any = Double3.Cross(along, Math.Abs(along.X) < 0.7 ? new(1, 0, 0) : new(0, 1, 0));
            any *= 1 / any.Length;
            arcs.Add(new(any, Double3.Cross(along, any), 2 * Math.PI, edge.A));
            return;
        }
        var start = faces[edge.FaceA];
        var end = faces[edge.FaceB];
        var across = Double3.Cross(along, start);
        if (Double3.Dot(start, end) < -0.999999)
        {
            // The edge of a triangle: half a turn, past the direction from the edge to the inside.
            var inside = polytope.Vertices.Length == 3 ? vertices[3 - edge.A - edge.B] - vertices[edge.A] : -(start + end);
            arcs.Add(new(start, Double3.Dot(across, inside) > 0 ? across : -across, Math.PI, edge.A));
            return;
        }
        var angle = Math.Atan2(Double3.Dot(end, across), Double3.Dot(end, start));
        arcs.Add(new(start, angle > 0 ? across : -across, Math.Abs(angle), edge.A));
    }

    double CylinderExtent(Double3 u) => radius * Math.Sqrt(u.X * u.X + u.Z * u.Z) + halfLength * Math.Abs(u.Y);

    double Value(Double3 u, Double3 q)
    {
        var least = double.MaxValue;
        foreach (var v in vertices)
        {
            var along = v.X * u.X + v.Y * u.Y + v.Z * u.Z;
            if (along < least)
                least = along;
        }
        return CylinderExtent(u) - least - Double3.Dot(u, q);
    }
}
