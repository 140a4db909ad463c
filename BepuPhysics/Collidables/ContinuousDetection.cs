using System;

namespace BepuPhysics.Collidables;

/// <summary>How contacts of a fast collidable are found before they happen.</summary>
public enum ContinuousDetectionMode
{
    /// <summary>Bounds grow with the velocity by no more than the speculative margin.</summary>
    Discrete = 0,
    /// <summary>Bounds grow with the whole velocity; contacts are still limited to the speculative margin.</summary>
    Passive = 1,
    /// <summary>
    /// As passive, and what moves by more than half of its inner radius in a step is tested where it will touch, and does not pass: turning included, and
    /// without loss of time. Either of two collidables may be marked.
    /// </summary>
    Continuous = 2,
}

/// <summary>Continuous detection of one collidable.</summary>
public struct ContinuousDetection
{
    /// <summary>How contacts are found.</summary>
    public ContinuousDetectionMode Mode;
    /// <summary>
    /// Time that a search for an impact goes on by at least, s; counts for no more than a hundredth of the thinner shape's inner radius. Of continuous
    /// detection; the less of two that are not the same.
    /// </summary>
    public float MinimumSweepTimestep;
    /// <summary>
    /// Time to which a search for an impact converges, s; counts for no more than a thousandth of the thinner shape's inner radius. Of continuous detection.
    /// </summary>
    public float SweepConvergenceThreshold;

    /// <summary>Whether bounds grow by more than the speculative margin.</summary>
    public readonly bool AllowExpansionBeyondSpeculativeMargin => Mode > ContinuousDetectionMode.Discrete;
    /// <summary>Bounds grow with the velocity by no more than the speculative margin.</summary>
    public static ContinuousDetection Discrete => default;
    /// <summary>Bounds grow with the whole velocity.</summary>
    public static ContinuousDetection Passive => new() { Mode = ContinuousDetectionMode.Passive };

    /// <summary>What is fast passes nothing.</summary>
    /// <param name="minimumSweepTimestep">See <see cref="MinimumSweepTimestep"/>, s.</param>
    /// <param name="sweepConvergenceThreshold">See <see cref="SweepConvergenceThreshold"/>, s.</param>
    public static ContinuousDetection Continuous(float minimumSweepTimestep = 1e-3f, float sweepConvergenceThreshold = 1e-3f) =>
        new() { Mode = ContinuousDetectionMode.Continuous, MinimumSweepTimestep = minimumSweepTimestep, SweepConvergenceThreshold = sweepConvergenceThreshold };

    internal readonly void Validate(string name)
    {
        if ((uint)Mode > (uint)ContinuousDetectionMode.Continuous || !float.IsFinite(MinimumSweepTimestep) || !float.IsFinite(SweepConvergenceThreshold))
            throw new ArgumentException(
                $"{name} must have a known mode and finite times, not {Mode}, {MinimumSweepTimestep}, {SweepConvergenceThreshold}.", name);
    }
}
