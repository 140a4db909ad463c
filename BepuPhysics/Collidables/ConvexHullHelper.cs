using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Creates convex hulls.</summary>
public static class ConvexHullHelper
{
    /// <summary>Creates the convex hull of a set of points, and says why when there is none.</summary>
    /// <param name="points">Points in any order and number.</param>
    /// <param name="pool">Source of the hull's memory and of temporary memory.</param>
    /// <param name="center">Centre of mass in the coordinates of the points; the hull's own coordinates begin there.</param>
    /// <param name="hullShape">The hull; without memory when there is none.</param>
    /// <param name="failure">Why there is none.</param>
    /// <returns>Whether there is a hull.</returns>
    /// <exception cref="ArgumentException">A point is not finite.</exception>
    public static bool TryCreateShape(Span<Vector3> points, BufferPool pool, out Vector3 center, out ConvexHull hullShape, out HullFailure failure)
    {
        ArgumentNullException.ThrowIfNull(pool);
        throw new NotSupportedException("The builder follows.");
    }

    internal static string Describe(HullFailure failure, int pointCount) => $"{failure}: {pointCount} points.";
}
