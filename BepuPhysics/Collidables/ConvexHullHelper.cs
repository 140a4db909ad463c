using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Creates convex hulls.</summary>
/// <remarks>
/// Points may come in any order and number, on one plane or line, doubled or nearly so. What they may be off by is decided once for all of
/// them: 3e-5 of their thickness, or what rounding their coordinates to floats did if that is more, but never more than 3e-5 of their
/// largest extent. Points that lie outside by less are left out, faces that are flat but for so much are one face.
/// Points that are thinner in some direction than 1e-5 of their extent, or than four gaps between floats of their coordinates, span no
/// volume.
/// Time grows with n log n for points that a hull has few of or that are spread over it. Memory, all of it from the pool and returned at
/// the end, is up to 100 bytes per point and 1.5 kilobytes per vertex.
/// The same points give the same hull on every machine and for every width of vectors; in another order they may give another hull within
/// the same tolerance.
/// </remarks>
public static unsafe class ConvexHullHelper
{
    /// <summary>Creates the convex hull of a set of points.</summary>
    /// <param name="points">Points in any order and number.</param>
    /// <param name="pool">Source of the hull's memory and of temporary memory.</param>
    /// <param name="center">Centre of mass in the coordinates of the points; the hull's own coordinates begin there.</param>
    /// <param name="convexHull">The hull; without memory when there is none.</param>
    /// <returns>Whether there is a hull: not when the points span no volume, or none of a size that a shape can have.</returns>
    /// <exception cref="ArgumentException">A point is not finite.</exception>
    public static bool CreateShape(Span<Vector3> points, BufferPool pool, out Vector3 center, out ConvexHull convexHull) =>
        TryCreateShape(points, pool, out center, out convexHull, out _);

    /// <summary>Creates the convex hull of a set of points, and says why when there is none.</summary>
    /// <param name="points">Points in any order and number.</param>
    /// <param name="pool">Source of the hull's memory and of temporary memory.</param>
    /// <param name="center">Centre of mass in the coordinates of the points; the hull's own coordinates begin there.</param>
    /// <param name="hullShape">The hull; without memory when there is none.</param>
    /// <param name="failure">Why there is none.</param>
    /// <returns>Whether there is a hull: not when the points span no volume, or none of a size that a shape can have.</returns>
    /// <exception cref="ArgumentException">A point is not finite.</exception>
    public static bool TryCreateShape(
        Span<Vector3> points, BufferPool pool, out Vector3 center, out ConvexHull hullShape, out HullFailure failure)
    {
        var exists = TryCreateShape(points, pool, out var hullData, out center, out hullShape, out failure);
        if (exists)
            hullData.Dispose(pool);
        return exists;
    }

    /// <summary>Creates the convex hull of a set of points, as a shape and as indices of the points.</summary>
    /// <param name="points">Points in any order and number.</param>
    /// <param name="pool">Source of the hull's memory and of temporary memory.</param>
    /// <param name="hullData">Vertices and faces as indices, to be disposed too; without memory when there is no hull.</param>
    /// <param name="center">Centre of mass in the coordinates of the points; the hull's own coordinates begin there.</param>
    /// <param name="convexHull">The hull; without memory when there is none.</param>
    /// <returns>Whether there is a hull: not when the points span no volume, or none of a size that a shape can have.</returns>
    /// <exception cref="ArgumentException">A point is not finite.</exception>
    public static bool CreateShape(
        Span<Vector3> points, BufferPool pool, out HullData hullData, out Vector3 center, out ConvexHull convexHull) =>
        TryCreateShape(points, pool, out hullData, out center, out convexHull, out _);

    /// <summary>Finds the convex hull of a set of points without making a shape of it.</summary>
    /// <param name="points">Points in any order and number.</param>
    /// <param name="pool">Source of the result's memory and of temporary memory.</param>
    /// <param name="hullData">Vertices and faces as indices of the points; without memory when there is no hull.</param>
    /// <returns>Whether there is a hull: not when the points span no volume.</returns>
    /// <exception cref="ArgumentException">A point is not finite.</exception>
    public static bool ComputeHull(Span<Vector3> points, BufferPool pool, out HullData hullData)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (HullAssembly.TryFind(points, pool, out hullData, out var normals) != HullFailure.None)
            return false;
        pool.Return(ref normals);
        return true;
    }

    /// <summary>Creates a scaled, mirrored, sheared or turned copy of a hull.</summary>
    /// <param name="source">The hull to copy.</param>
    /// <param name="transform">Where the axes of the hull's frame go, one per row; not singular.</param>
    /// <param name="pool">Source of the copy's memory.</param>
    /// <param name="target">The copy, with memory of its own.</param>
    /// <exception cref="ArgumentException">The hull has no memory, the transform is not finite or is singular, or the copy would have no
    /// size that a shape can have.</exception>
    public static void CreateTransformedCopy(in ConvexHull source, in Matrix3x3 transform, BufferPool pool, out ConvexHull target)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (source.Header == null)
            throw new ArgumentException("A convex hull without memory cannot be copied.", nameof(source));
        HullTransform.Copy(source.Header, transform, pool, out target);
    }

    /// <summary>Does what <see cref="CreateTransformedCopy"/> does: hulls share no memory with each other.</summary>
    /// <inheritdoc cref="CreateTransformedCopy" path="/param"/>
    /// <inheritdoc cref="CreateTransformedCopy" path="/exception"/>
    public static void CreateTransformedShallowCopy(in ConvexHull source, in Matrix3x3 transform, BufferPool pool, out ConvexHull target) =>
        CreateTransformedCopy(source, transform, pool, out target);

    static bool TryCreateShape(Span<Vector3> points, BufferPool pool,
        out HullData hullData, out Vector3 center, out ConvexHull hullShape, out HullFailure failure)
    {
        ArgumentNullException.ThrowIfNull(pool);
        center = default;
        hullShape = default;
        failure = HullAssembly.TryFind(points, pool, out hullData, out var normals);
        if (failure != HullFailure.None)
            return false;
        HullAssembly.Assemble(points, hullData, normals, pool, out center, out hullShape);
        pool.Return(ref normals);
        if (hullShape.Header->IsShape)
            return true;
        failure = HullFailure.SizeOutOfRange;
        hullShape.Dispose(pool);
        hullData.Dispose(pool);
        center = default;
        return false;
    }

    internal static string Describe(HullFailure failure, int pointCount)
    {
        var reason = failure switch
        {
            HullFailure.TooFewPoints => "there are fewer than four",
            HullFailure.AllPointsCoincide => "all are at one place, within the tolerance",
            HullFailure.AllPointsOnALine => "all are on one line, within the tolerance",
            HullFailure.AllPointsInAPlane => "all are in one plane, within the tolerance",
            HullFailure.TooManyVertices => $"their hull has more than {ConvexHull.MaximumVertexCount} vertices",
            _ => $"they are too far apart or too close together: the centre of mass must be from {ShapeLimits.MinimumSize} to " +
                $"{ShapeLimits.MaximumSize} m away from the nearest face, and half the extent as long",
        };
        return $"{pointCount} points have no convex hull that can be a shape: {reason}.";
    }
}
