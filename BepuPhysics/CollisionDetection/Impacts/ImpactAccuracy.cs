namespace BepuPhysics.CollisionDetection;

/// <summary>How exactly a time of impact is sought, and how long.</summary>
/// <param name="minimumProgression">Time that a round takes at least, s: what is met and left within it may be missed.</param>
/// <param name="convergenceThreshold">
/// Time that the greatest speed of the shapes turns into a distance at which they count as touching, s.
/// </param>
/// <param name="maximumRoundCount">Greatest number of rounds; a pair that takes more has no impact, and it is said that they ran out.</param>
readonly struct ImpactAccuracy(double minimumProgression, double convergenceThreshold, int maximumRoundCount)
{
    /// <summary>Nothing is missed, touching is by size, and the limit is one that no pair of the tests comes near to.</summary>
    public static ImpactAccuracy Default => new(0, 0, 16_384);

    public readonly double MinimumProgression = minimumProgression, ConvergenceThreshold = convergenceThreshold;
    public readonly int MaximumRoundCount = maximumRoundCount;

    /// <summary>Distance at which shapes count as touching, m, where others are less.</summary>
    public double TouchingDistance { get; init; }
}

/// <summary>The first contact of two shapes that move.</summary>
struct Impact
{
    /// <summary>When, s; never later than the shapes truly touch.</summary>
    public double T;
    /// <summary>Unit normal from B to A, in world axes. Nothing where the shapes overlap at once.</summary>
    public DoubleVector3 Normal;
    /// <summary>
    /// Place on the surface of B, from the position of A's body at the time zero, in world axes, m. Nothing where the shapes overlap at
    /// once.
    /// </summary>
    public DoubleVector3 Place;
    /// <summary>Whether the shapes overlap or touch at the time zero.</summary>
    public bool Overlaps;
    /// <summary>Whether rounds ran out: nothing was found, and nothing is known of the rest of the time.</summary>
    public bool RanOut;
    /// <summary>Number of rounds that it took.</summary>
    public int RoundCount;
}
