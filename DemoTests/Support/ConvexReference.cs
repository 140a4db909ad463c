using System;
using System.Collections.Generic;
using Demos.References;

namespace DemoTests.Support;

/// <summary>What the reference knows of a pair.</summary>
/// <param name="Depth">Least distance by which a move parts two shapes that overlap, or the negated distance of two that do not.</param>
/// <param name="Normals">
/// Unit normals from B to A in A's frame, the best one first: all along which the depth is within the asked tolerance of the least. Where
/// the least depth is that of a whole range of normals, only some of them.
/// </param>
/// <param name="AxisDepth">Depth along the best normal of a face or of two edges; not the distance when polytopes are apart at a corner.</param>
public readonly record struct ConvexDepth(double Depth, Double3[] Normals, double AxisDepth)
{
    public Double3 Normal => Normals[0];
}

/// <summary>
/// The depth of two convex shapes in double precision, by enumeration. It is made for one orientation of B in A's frame and answers for
/// any offset, as the difference of the shapes only moves with it. Used by one thread.
/// </summary>
/// <remarks>
/// The depth along a unit direction m from A to B is f(m) = h(m) - m.o, where o is the offset of B and h the support function of the
/// difference of the cores. Its least value lies on one of the faces of that difference, each of which stems from a feature of A and one
/// of B. Polytopes: the normals of faces and of pairs of edges; when apart, all pairs of features. Cylinders: see ConvexCylinders. Every
/// value that is looked at is f of some direction, so the reference is never too small; ConvexSampling shows that it is not too large.
/// </remarks>
public sealed class ConvexReference
{
    readonly IConvexSearch search;

    public ConvexReference(ConvexShape a, ConvexShape b, ConvexRotation rotation)
    {
        A = a;
        B = b;
        Rotation = rotation;
        search = (a.IsCylinder, b.IsCylinder) switch
        {
            (true, true) => new ConvexCylinders(a, b, rotation),
            (false, false) => new ConvexPolytopes(a, b, rotation),
            _ => new ConvexCylinderPolytope(a, b, rotation),
        };
    }

    public ConvexShape A { get; }

    public ConvexShape B { get; }

    /// <summary>Axes of B in A's frame.</summary>
    public ConvexRotation Rotation { get; }

    /// <summary>What errors are relative to: the outer radius of the smaller shape.</summary>
    public double Size => Math.Min(A.OuterRadius, B.OuterRadius);

    /// <summary>What rounding errors are relative to.</summary>
    public double LargerSize => Math.Max(A.OuterRadius, B.OuterRadius);

    /// <summary>The offset at which the middles of the shapes coincide.</summary>
    public Double3 ConcentricOffset => A.Middle - Rotation.Rotate(B.Middle);

    /// <summary>Depth along a unit normal from B to A in A's frame, at an offset of B in A's frame.</summary>
    public double DepthAlong(Double3 normal, Double3 offset) =>
        A.CoreExtent(-normal) + B.CoreExtent(Rotation.RotateBack(normal)) + Double3.Dot(normal, offset) + A.Rounding + B.Rounding;

    /// <summary>Finds the depth at an offset of B in A's frame.</summary>
    /// <param name="offset">Position of B in A's frame.</param>
    /// <param name="ambiguity">Normals are listed along which the depth is within this of the least, relative to the smaller size.</param>
    public ConvexDepth Find(Double3 offset, double ambiguity = 1e-4)
    {
        var found = new ConvexCandidates(ambiguity * Size);
        var (depth, axisDepth) = search.Find(offset, found);
        var rounding = A.Rounding + B.Rounding;
        return new(depth + rounding, found.Normals(depth), axisDepth + rounding);
    }

    /// <summary>Whether a point in A's frame lies in both shapes, or no farther from either than a tolerance.</summary>
    public bool InsideBoth(Double3 pointInA, Double3 offset, double tolerance) =>
        A.InsideWithin(pointInA, tolerance) && B.InsideWithin(Rotation.RotateBack(pointInA - offset), tolerance);
}

/// <summary>A way to find the depth of the cores of two shapes.</summary>
interface IConvexSearch
{
    (double Depth, double AxisDepth) Find(Double3 offset, ConvexCandidates found);
}

/// <summary>Directions from A to B that may be the best, with the depth along each.</summary>
sealed class ConvexCandidates(double tolerance)
{
    const int MaximumCount = 64;

    readonly List<(double Depth, Double3 Direction)> candidates = [];

    public double Tolerance => tolerance;

    public double Least { get; private set; } = double.MaxValue;

    public void Add(double depth, Double3 direction)
    {
        if (depth > Least + tolerance)
            return;
        Least = Math.Min(Least, depth);
        candidates.Add((depth, direction));
    }

    /// <summary>Directions from B to A that are within the tolerance of a depth, each once, best first.</summary>
    public Double3[] Normals(double depth)
    {
        // A depth of nothing may be less than that of any candidate by rounding.
        depth = Math.Max(depth, Least);
        candidates.RemoveAll(c => c.Depth > depth + tolerance);
        candidates.Sort((a, b) => a.Depth.CompareTo(b.Depth));
        var normals = new List<Double3>();
        foreach (var (_, direction) in candidates)
        {
            if (normals.Count == MaximumCount)
                break;
            var isNew = true;
            foreach (var n in normals)
                isNew &= (n + direction).LengthSquared > 1e-10;
            if (isNew)
                normals.Add(-direction);
        }
        return [.. normals];
    }
}
