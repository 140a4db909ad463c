namespace BepuPhysics.Collidables;

/// <summary>Why a set of points has no convex hull that can be a shape.</summary>
public enum HullFailure
{
    /// <summary>There is a hull.</summary>
    None,
    /// <summary>There are fewer than four points.</summary>
    TooFewPoints,
    /// <summary>All points are at one place, within a tolerance.</summary>
    AllPointsCoincide,
    /// <summary>All points are on one line, within a tolerance.</summary>
    AllPointsOnALine,
    /// <summary>All points are in one plane, within a tolerance.</summary>
    AllPointsInAPlane,
    /// <summary>The hull has more vertices than <see cref="ConvexHull.MaximumVertexCount"/>, whatever the tolerance merges.</summary>
    TooManyVertices,
    /// <summary>The points are farther apart, closer together or in a thinner layer than what a shape can be.</summary>
    SizeOutOfRange,
}
