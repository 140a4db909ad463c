using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>How far apart two convex shapes are.</summary>
struct ShapeDistance
{
    /// <summary>Distance of the surfaces, m; zero where the shapes overlap.</summary>
    public double Distance;
    /// <summary>Unit normal from B to A, in world axes. Nothing where the shapes overlap.</summary>
    public DoubleVector3 Normal;
    /// <summary>
    /// Point of B's surface that is nearest to A, from the position of A's body, in world axes, m. Nothing where the shapes overlap.
    /// </summary>
    public DoubleVector3 Place;
    /// <summary>Whether the shapes overlap or touch.</summary>
    public bool Overlaps;
}

// Two shapes at rest.
ref partial struct ImpactPair
{
    // By how much a plane between the shapes may leave less than the distance, by the distance and the smaller size: the normal is off by
    // the root of the double at most where the shapes are round, and exact elsewhere.
    const double DistancePart = 1e-10;

    /// <summary>Finds how far apart two shapes are at the time zero.</summary>
    /// <param name="a">First shape.</param>
    /// <param name="b">Second shape; a half-space must be this one.</param>
    /// <param name="offsetB">Position of B's body less that of A's, m.</param>
    /// <param name="maximum">Greatest distance that is of interest, m; may be infinite.</param>
    /// <param name="found">The distance.</param>
    /// <returns>
    /// Whether they are no farther apart, and meet on the fronts of triangles; what overlaps a triangle is on the side of its middle.
    /// </returns>
    public static bool FindDistance(
        ref ImpactBody a, ref ImpactBody b, in DoubleVector3 offsetB, double maximum, out ShapeDistance found)
    {
        var pair = new ImpactPair(ref a, ref b, offsetB, default);
        return pair.FindDistance(maximum, out found);
    }

    bool FindDistance(double maximum, out ShapeDistance found)
    {
        found = default;
        Begin(0);
        var touching = rounding * OverlapPart;
        var isApart = Separate(touching);
        // By rounding, a gap may be wider than the distance is.
        if (isApart && gap - rounding * RoundingPart > maximum)
            return false;
        if (isApart)
            isApart = Separate(touching, Math.Max(rounding * RoundingPart, (distance + Math.Min(a.Core.Size, b.Core.Size)) * DistancePart));
        if (!isApart)
        {
            found.Overlaps = true;
            return IsInFront();
        }
        if (distance > maximum)
            return false;
        found.Distance = distance;
        found.Normal = -normal;
        found.Place = PlaceOnB();
        return MeetsFronts();
    }
}
