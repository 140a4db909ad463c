using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using Demos.References;

namespace DemoTests.Support;

/// <summary>
/// A convex shape and triangles, which are touched from both sides, in double precision: the least translation by which the shape comes out of all of them.
/// </summary>
/// <remarks>
/// The translations by which a polytope meets one triangle are the inside of a polytope, the Minkowski difference of the two. The least one that is inside of
/// none of them lies on one, two or three planes of these: all are tried. Of round shapes the difference has no planes; there each triangle is left along
/// its normal of least depth at the last translation, until nothing changes, from many starts. Nothing can be less than what is found for polytopes. For
/// round shapes it may, so a test compares both ways.
/// </remarks>
sealed class TriangleUnion
{
    const double Rounding = 1e-11;

    readonly record struct Plane(Double3 Normal, double Depth);

    readonly ConvexShape shape;
    readonly ConvexRotation toWorld;
    readonly List<Plane[]> polytopes = [];
    readonly List<ConvexReference> references = [];
    readonly Double3 meshOffset;

    TriangleUnion(ConvexShape shape) => (this.shape, toWorld) = (shape, ConvexRotation.Identity);

    /// <summary>Triangles that are moved as one thing, and others that stay: all pairs of them that are in reach.</summary>
    /// <param name="movers">The triangles that are moved, less their position.</param>
    /// <param name="triangles">The others.</param>
    /// <param name="position">Where the movers are.</param>
    /// <param name="reach">How far they may be moved, m.</param>
    public static TriangleUnion Of(Triangle[] movers, (Vector3 A, Vector3 B, Vector3 C)[] triangles, Vector3 position, double reach)
    {
        TriangleUnion all = new(ConvexShape.Triangle(movers[0].A, movers[0].B, movers[0].C));
        foreach (var mover in movers)
        {
            var one = ConvexShape.Triangle(mover.A, mover.B, mover.C);
            // Planes depend on nothing but the shapes and the position.
            all.polytopes.AddRange(new TriangleUnion(one, position, Quaternion.Identity, triangles, reach).polytopes);
        }
        return all;
    }

    /// <param name="shape">The shape.</param>
    /// <param name="position">Where it is, in the frame of the triangles.</param>
    /// <param name="orientation">How it lies there.</param>
    /// <param name="triangles">The triangles; those out of reach are left out.</param>
    /// <param name="reach">How far the shape may be moved, m.</param>
    public TriangleUnion(ConvexShape shape, Vector3 position, Quaternion orientation, IEnumerable<(Vector3 A, Vector3 B, Vector3 C)> triangles, double reach)
    {
        this.shape = shape;
        toWorld = ConvexRotation.From(orientation);
        meshOffset = toWorld.RotateBack(-(Double3)position);
        foreach (var (a, b, c) in triangles)
        {
            var middle = toWorld.Rotate(shape.Middle) + position;
            var far = shape.OuterRadius + reach;
            if (Beyond(a.X, b.X, c.X, middle.X, far) || Beyond(a.Y, b.Y, c.Y, middle.Y, far) || Beyond(a.Z, b.Z, c.Z, middle.Z, far))
                continue;
            if (shape.Kind is ConvexKind.Box or ConvexKind.Hull or ConvexKind.Triangle)
            {
                var planes = CreatePlanes([ToLocal(a), ToLocal(b), ToLocal(c)]);
                if (planes.Min(plane => plane.Depth) > -reach)
                    polytopes.Add(planes);
            }
            else
            {
                var reference = new ConvexReference(shape, ConvexShape.Triangle(a, b, c), toWorld.Transposed);
                if (reference.Find(meshOffset).Depth > -reach)
                    references.Add(reference);
            }
        }
    }

    /// <summary>Whether triangles are near enough to be met.</summary>
    public int TriangleCount => polytopes.Count + references.Count;

    static bool Beyond(double a, double b, double c, double middle, double reach) =>
        Math.Min(a, Math.Min(b, c)) > middle + reach || Math.Max(a, Math.Max(b, c)) < middle - reach;

    Double3 ToLocal(Vector3 v) => toWorld.RotateBack(v) + meshOffset;

    // Planes beyond which the shape is apart from a triangle. Of directions of two edges that are no face of the difference, the plane touches it only.
    Plane[] CreatePlanes(Double3[] corners)
    {
        var planes = new List<Plane>();
        var normal = Double3.Cross(corners[1] - corners[0], corners[2] - corners[0]);
        Add(normal);
        Add(-normal);
        foreach (var face in shape.FaceNormals)
            Add(-face);
        foreach (var edge in shape.Edges)
        {
            for (int i = 0; i < 3; ++i)
            {
                var across = Double3.Cross(shape.Vertices[edge.B] - shape.Vertices[edge.A], corners[(i + 1) % 3] - corners[i]);
                Add(across);
                Add(-across);
            }
        }
        return [.. planes];

        void Add(Double3 direction)
        {
            var length = direction.Length;
            if (length <= 1e-12 * shape.OuterRadius * shape.OuterRadius)
                return;
            direction *= 1 / length;
            planes.Add(new(direction, corners.Max(corner => Double3.Dot(corner, direction)) + shape.CoreExtent(-direction)));
        }
    }

    /// <summary>Greatest depth in any of the triangles after a translation, m; negative where it is apart from all.</summary>
    /// <param name="translation">The translation, in the frame of the triangles.</param>
    public double Depth(Double3 translation) => LocalDepth(toWorld.RotateBack(translation));

    double LocalDepth(Double3 t)
    {
        var depth = double.MinValue;
        foreach (var planes in polytopes)
            depth = Math.Max(depth, DepthIn(planes, t));
        foreach (var reference in references)
            depth = Math.Max(depth, reference.Find(meshOffset - t).Depth);
        return depth;
    }

    static double DepthIn(Plane[] planes, Double3 t)
    {
        var least = double.MaxValue;
        foreach (var plane in planes)
        {
            least = Math.Min(least, plane.Depth - Double3.Dot(plane.Normal, t));
            if (least <= 0)
                break;
        }
        return least;
    }

    /// <summary>The least translation that takes the shape out of all triangles, in their frame.</summary>
    /// <param name="limit">Length beyond which nothing is looked for, m.</param>
    public Double3? LeastTranslation(double limit)
    {
        var found = references.Count > 0 ? Descend(limit) : Enumerate(limit);
        return found is { } t ? toWorld.Rotate(t) : null;
    }

    Double3? Enumerate(double limit)
    {
        if (polytopes.Count == 0)
            return Double3.Zero;
        var tolerance = Rounding * (shape.OuterRadius + limit);
        // It cannot be less than the depth in any one triangle.
        var least = polytopes.Max(planes => planes.Min(plane => plane.Depth));
        if (least <= 0)
            return Double3.Zero;
        var (bestLength, best) = (limit, (Double3?)null);
        foreach (var planes in polytopes)
        {
            foreach (var plane in planes)
            {
                if (plane.Depth > 0)
                    Try(plane.Normal * plane.Depth);
            }
        }
        if (bestLength <= least + tolerance)
            return best;
        var near = polytopes.SelectMany(planes => planes).Where(plane => Math.Abs(plane.Depth) <= bestLength).ToArray();
        for (int i = 0; i < near.Length; ++i)
        {
            for (int j = i + 1; j < near.Length; ++j)
            {
                if (OnTwo(near[i], near[j]) is { } t)
                    Try(t);
            }
        }
        near = [.. near.Where(plane => Math.Abs(plane.Depth) <= bestLength)];
        for (int i = 0; i < near.Length; ++i)
        {
            for (int j = i + 1; j < near.Length; ++j)
            {
                // What is on three planes is no nearer than what is on two of them.
                if (OnTwo(near[i], near[j]) is not { } two || two.LengthSquared > bestLength * bestLength)
                    continue;
                for (int k = j + 1; k < near.Length; ++k)
                {
                    if (OnThree(near[i], near[j], near[k]) is { } t)
                        Try(t);
                }
            }
        }
        return best;

        void Try(Double3 t)
        {
            var length = t.Length;
            if (length >= bestLength || polytopes.Any(planes => DepthIn(planes, t) > tolerance))
                return;
            (bestLength, best) = (length, t);
        }
    }

    static Double3? OnTwo(Plane a, Plane b)
    {
        var cosine = Double3.Dot(a.Normal, b.Normal);
        var squared = 1 - cosine * cosine;
        if (squared < 1e-12)
            return null;
        return a.Normal * ((a.Depth - cosine * b.Depth) / squared) + b.Normal * ((b.Depth - cosine * a.Depth) / squared);
    }

    static Double3? OnThree(Plane a, Plane b, Plane c)
    {
        var bc = Double3.Cross(b.Normal, c.Normal);
        var volume = Double3.Dot(a.Normal, bc);
        if (Math.Abs(volume) < 1e-9)
            return null;
        return (bc * a.Depth + Double3.Cross(c.Normal, a.Normal) * b.Depth + Double3.Cross(a.Normal, b.Normal) * c.Depth) * (1 / volume);
    }

    Double3? Descend(double limit)
    {
        var (bestLength, best) = (limit, (Double3?)null);
        var starts = new List<Double3>();
        foreach (var reference in references)
        {
            var depth = reference.Find(meshOffset, .5);
            if (depth.Depth <= 0)
                continue;
            foreach (var normal in depth.Normals.Take(4))
                starts.Add(normal * reference.DepthAlong(normal, meshOffset));
            foreach (var normal in reference.B.FaceNormals)
                starts.Add(reference.Rotation.Rotate(normal) * reference.DepthAlong(reference.Rotation.Rotate(normal), meshOffset));
        }
        if (starts.Count == 0)
            return Double3.Zero;
        foreach (var start in starts)
        {
            var t = start;
            for (int round = 0; round < 30; ++round)
            {
                var bounds = references.Select(reference =>
                {
                    var found = reference.Find(meshOffset - t);
                    return (found.Normal, Double3.Dot(found.Normal, t) + found.Depth);
                }).ToArray();
                if (LeastBeyond(bounds) is not { } next)
                    break;
                var isDone = (next - t).Length < 1e-9 * shape.OuterRadius;
                t = next;
                if (isDone)
                    break;
            }
            if (t.Length < bestLength && LocalDepth(t) < 1e-7 * shape.OuterRadius)
                (bestLength, best) = (t.Length, t);
        }
        return best;
    }

    /// <summary>The least vector beyond planes, each by its unit normal and distance; none where they leave nothing.</summary>
    public static Double3? LeastBeyond(IReadOnlyList<(Double3 Normal, double Distance)> bounds)
    {
        var (bestSquared, best) = (double.MaxValue, (Double3?)null);
        Try(Double3.Zero);
        for (int i = 0; i < bounds.Count; ++i)
            Try(bounds[i].Normal * bounds[i].Distance);
        for (int i = 0; i < bounds.Count; ++i)
        {
            for (int j = i + 1; j < bounds.Count; ++j)
                Try(OnTwo(At(i), At(j)));
        }
        for (int i = 0; i < bounds.Count; ++i)
        {
            for (int j = i + 1; j < bounds.Count; ++j)
            {
                for (int k = j + 1; k < bounds.Count; ++k)
                    Try(OnThree(At(i), At(j), At(k)));
            }
        }
        return best;

        Plane At(int i) => new(bounds[i].Normal, bounds[i].Distance);

        void Try(Double3? candidate)
        {
            if (candidate is not { } t || t.LengthSquared >= bestSquared)
                return;
            foreach (var (normal, distance) in bounds)
            {
                if (Double3.Dot(normal, t) < distance - 1e-12 - 1e-9 * Math.Abs(distance))
                    return;
            }
            (bestSquared, best) = (t.LengthSquared, t);
        }
    }
}
