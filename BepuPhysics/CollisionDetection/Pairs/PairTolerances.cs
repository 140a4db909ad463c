namespace BepuPhysics.CollisionDetection;

/// <summary>What counts as parallel, as the same, or as rounding for closed forms of pairs of shapes; each relative to what it is about.</summary>
/// <remarks>
/// "Size" is the size of the pair: reaches of both shapes together; "smaller" is the smaller shape. Floats have a relative rounding of 6e-8; what a
/// test computes from some ten of them is off by about 1e-6 of its size.
/// </remarks>
static class PairTolerances
{
    // Nearly parallel, as squares of the sine.

    /// <summary>
    /// Edges of boxes, with each other's, a triangle's or a segment: at that angle one leaves the other's line by 1e-6 of its length, and
    /// the faces beside them show the depth as well to that.
    /// </summary>
    public const float ParallelBoxEdge = 1e-12f;

    /// <summary>Segments of capsules, with each other or with a triangle's edge: at that angle one leaves the other's line by 3e-6 of its length.</summary>
    public const float ParallelSegment = 1e-11f;

    /// <summary>
    /// Edges of two triangles. The direction of their product is wrong by the rounding of an edge over the sine, and without it the
    /// depth is wrong by up to the sine times the shorter edge: both are some 2e-4 here.
    /// </summary>
    public const float ParallelTriangleEdge = 1e-7f;

    /// <summary>
    /// A segment and a cylinder's axis, in place of zero: below this a direction across both is taken from nowhere, and its square must not
    /// underflow.
    /// </summary>
    public const float ParallelToAxis = 1e-20f;

    /// <summary>
    /// Unit speed across a plane in place of less: where a line crosses that plane is divided by it, and is then far off, and finite.
    /// </summary>
    public const float LeastSpeed = 1e-20f;

    // Choices between directions that rounding must not make.

    /// <summary>Part of the smaller shape by which an axis of edges must beat the faces: faces that rest on each other keep their normal.</summary>
    public const float EdgeAdvantage = 1e-5f;

    /// <summary>Part of the smaller shape by which nearest points must show more than the axes.</summary>
    public const float NearestAdvantage = 1e-6f;

    /// <summary>Part of the smaller shape by which nearest points may be farther apart than the axis shows and still be what it belongs to.</summary>
    public const float SamePoints = 1e-5f;

    /// <summary>
    /// Part of the size by which an edge or a rim must beat a face of a capsule's partner, and by which nearest points must lie beside an axis that
    /// shows their distance.
    /// </summary>
    public const float CapsuleAdvantage = 1e-6f;

    // Where contacts are.

    /// <summary>
    /// Part of the size that a capsule's segment may be beside a face and still be over it: along the face's border, contacts must not
    /// depend on rounding.
    /// </summary>
    public const float CapsuleBorder = 3e-6f;

    /// <summary>Part of a capsule's size within which its contacts with a face are one.</summary>
    public const float SameContactOnFace = 0.02f;

    /// <summary>Part of the radii, or of the smaller size, within which contacts of two round sides are one.</summary>
    public const float SameContactOnSide = 0.2f;
}
