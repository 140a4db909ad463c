namespace BepuPhysics;

/// <summary>What a simulation can bear: values beyond are refused where they are given.</summary>
public static class Limits
{
    /// <summary>Longest step, s.</summary>
    public const float MaximumTimestep = 1e6f;
    /// <summary>Greatest frequency of a spring, Hz.</summary>
    public const float MaximumSpringFrequency = 1e12f;
    /// <summary>Greatest damping ratio of a spring.</summary>
    public const float MaximumDampingRatio = 1e12f;
}
