namespace BepuPhysics;

/// <summary>How quickly a body may fall asleep.</summary>
/// <param name="sleepThreshold">Speed squared, linear plus angular, under which a body counts as resting. Negative: never sleeps.</param>
/// <param name="minimumTimestepCountUnderThreshold">Steps that it must rest before it may sleep.</param>
public struct BodyActivityDescription(float sleepThreshold, byte minimumTimestepCountUnderThreshold = 32)
{
    /// <summary>Speed squared, linear plus angular, under which a body counts as resting. Negative: never sleeps.</summary>
    public float SleepThreshold = sleepThreshold;
    /// <summary>Steps that a body must rest before it may sleep.</summary>
    public byte MinimumTimestepCountUnderThreshold = minimumTimestepCountUnderThreshold;

    /// <summary>Description with the usual number of steps.</summary>
    public static implicit operator BodyActivityDescription(float sleepThreshold) => new(sleepThreshold);
}

/// <summary>Progress of a body towards sleep.</summary>
public struct BodyActivity
{
    /// <summary>Speed squared, linear plus angular, under which the body counts as resting. Negative: never sleeps.</summary>
    public float SleepThreshold;
    /// <summary>Steps that the body must rest before it may sleep.</summary>
    public byte MinimumTimestepsUnderThreshold;
    /// <summary>Steps that it has rested.</summary>
    public byte TimestepsUnderThresholdCount;
    /// <summary>Whether it has rested long enough.</summary>
    public bool SleepCandidate;
}
