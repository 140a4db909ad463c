namespace BepuPhysics.CollisionDetection;

/// <summary>What counts as one point, as a line, as parallel in the depth search. How exact a result is, <see cref="SearchFrame"/> says.</summary>
/// <remarks>Lengths are in units of the search, in which the larger shape's radius is between 1 and 2.</remarks>
static class SearchTolerances
{
    /// <summary>Squared length below which two vertices are one: 1e-7 is the rounding of a coordinate.</summary>
    public const float SquaredSamePoint = 1e-14f;

    /// <summary>
    /// Squared sine between two edges below which three vertices are on a line. The product of the edges is then as small as its rounding, some
    /// 1e-7 of their lengths, and says nothing; down to there it says which side is which.
    /// </summary>
    public const float SquaredSineOfLine = 1e-12f;

    /// <summary>
    /// Squared sine between two edges below which a triangle is too narrow to say where its plane is: its normal is off by the rounding of the
    /// edges, 1e-7, over the sine, which is 1e-4 here.
    /// </summary>
    public const float SquaredSineOfPlane = 1e-6f;

    /// <summary>
    /// Sine of the angle, 3 degrees, up to which a flat face and the end or side of a cylinder, or two sides, count as nearly parallel. Up to there
    /// a closed form has the least depth but for the square of the sine, and around the axis of an end farthest points run too fast for a
    /// Newton step.
    /// </summary>
    public const float NearlyParallel = 0.05f;
}
