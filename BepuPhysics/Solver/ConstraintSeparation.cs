namespace BepuPhysics;

/// <summary>How far the bodies of a constraint are from where it holds them.</summary>
public struct ConstraintSeparation
{
    /// <summary>
    /// Length of the error of all rows along directions, m; of areas and volumes what the rows measure, m2 and m3. Zero where there are no such rows, and
    /// of limits where they are kept.
    /// </summary>
    public float Linear;
    /// <summary>Length of the error of all rows about axes, radians. Zero where there are no such rows, and of limits where they are kept.</summary>
    public float Angular;
}
