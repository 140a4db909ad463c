namespace BepuPhysics;

/// <summary>The greatest impulse of a step that a constraint bears.</summary>
/// <remarks>
/// The impulses of all substeps of a step are summed, each by its length over the rows: over the time of the step that is the mean force, or torque,
/// whatever the number of substeps. Where rows have other units (areas, volumes, gears), it is in these.
/// </remarks>
/// <param name="impulse">Greatest impulse along directions, N s.</param>
/// <param name="angularImpulse">Greatest impulse about axes, N m s.</param>
public struct BreakThreshold(float impulse, float angularImpulse = float.PositiveInfinity)
{
    /// <summary>Greatest impulse along directions, N s; positive, infinite where it breaks nothing.</summary>
    public float Impulse = impulse;
    /// <summary>Greatest impulse about axes, N m s; positive, infinite where it breaks nothing.</summary>
    public float AngularImpulse = angularImpulse;

    /// <summary>What every constraint has at first: it never breaks.</summary>
    public static BreakThreshold Unbreakable => new(float.PositiveInfinity);
}
