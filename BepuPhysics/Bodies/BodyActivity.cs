using System.Runtime.CompilerServices;

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
    /// <summary>Steps that it has rested, no more than <see cref="MinimumTimestepsUnderThreshold"/>.</summary>
    public byte TimestepsUnderThresholdCount;
    /// <summary>Whether it has rested long enough: it sleeps as soon as all that it is connected with has.</summary>
    public bool SleepCandidate;
    /// <summary>Whether the body touched several things in the last step that do not give way; their contacts then wait for each other.</summary>
    // Here is a byte to spare, and collidables keep their 32 bytes.
    internal bool IsAtSeam;

    /// <summary>Takes note of the speed with which a step begins.</summary>
    /// <param name="speedSquared">Speed squared, linear plus angular.</param>
    /// <returns>1 if the body has rested long enough, else 0.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal int Note(float speedSquared)
    {
        // What is no number does not rest.
        if (!(speedSquared <= SleepThreshold))
        {
            Forget();
            return 0;
        }
        if (TimestepsUnderThresholdCount < MinimumTimestepsUnderThreshold)
            ++TimestepsUnderThresholdCount;
        SleepCandidate = TimestepsUnderThresholdCount >= MinimumTimestepsUnderThreshold;
        return SleepCandidate ? 1 : 0;
    }

    /// <summary>Begins anew to count rest.</summary>
    internal void Forget()
    {
        TimestepsUnderThresholdCount = 0;
        SleepCandidate = false;
    }
}
