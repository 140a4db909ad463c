using System;

namespace BepuPhysics.Collidables;

/// <summary>How contacts of a fast collidable are found before they happen.</summary>
public enum ContinuousDetectionMode
{
    /// <summary>Bounds grow with the velocity by no more than the speculative margin.</summary>
    Discrete = 0,
    /// <summary>Bounds grow with the whole velocity; contacts are still limited to the speculative margin.</summary>
    Passive = 1,
    /// <summary>As passive, and the time of impact is searched for where the motion exceeds the margin.</summary>
    Continuous = 2,
}

/// <summary>Continuous detection of one collidable.</summary>
public struct ContinuousDetection
{
    /// <summary>How contacts are found.</summary>
    public ContinuousDetectionMode Mode;
    /// <summary>Shortest time that a sweep tells apart, s; used by continuous detection.</summary>
    public float MinimumSweepTimestep;
    /// <summary>Time to which a sweep converges, s; used by continuous detection.</summary>
    public float SweepConvergenceThreshold;

    /// <summary>Whether bounds grow by more than the speculative margin.</summary>
    public readonly bool AllowExpansionBeyondSpeculativeMargin => Mode > ContinuousDetectionMode.Discrete;
    /// <summary>Bounds grow with the velocity by no more than the speculative margin.</summary>
    public static ContinuousDetection Discrete => default;
    /// <summary>Bounds grow with the whole velocity.</summary>
    public static ContinuousDetection Passive => new() { Mode = ContinuousDetectionMode.Passive };

    /// <summary>Sweeps where the motion exceeds the speculative margin.</summary>
    /// <param name="minimumSweepTimestep">Shortest time that a sweep tells apart, s.</param>
    /// <param name="sweepConvergenceThreshold">Time to which a sweep converges, s.</param>
    public static ContinuousDetection Continuous(float minimumSweepTimestep = 1e-3f, float sweepConvergenceThreshold = 1e-3f) =>
        new() { Mode = ContinuousDetectionMode.Continuous, MinimumSweepTimestep = minimumSweepTimestep, SweepConvergenceThreshold = sweepConvergenceThreshold };

    internal readonly void Validate(string name)
    {
        if ((uint)Mode > (uint)ContinuousDetectionMode.Continuous || !float.IsFinite(MinimumSweepTimestep) || !float.IsFinite(SweepConvergenceThreshold))
            throw new ArgumentException(
                $"{name} must have a known mode and finite times, not {Mode}, {MinimumSweepTimestep}, {SweepConvergenceThreshold}.", name);
    }
}
