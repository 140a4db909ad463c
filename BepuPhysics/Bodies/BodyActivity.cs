using System;
using System.Runtime.CompilerServices;

namespace BepuPhysics;

/// <summary>How quickly a body may fall asleep.</summary>
/// <param name="sleepThreshold">Speed squared, linear plus angular, under which a body counts as resting. Negative: never sleeps.</param>
/// <param name="minimumTimestepCountUnderThreshold">
/// Steps that it must rest before it may sleep. Of steps that are shorter than 1/240 s, as in slow motion, only as many count as that time goes into theirs.
/// </param>
public struct BodyActivityDescription(float sleepThreshold, byte minimumTimestepCountUnderThreshold = 32)
{
    /// <summary>Speed squared, linear plus angular, under which a body counts as resting. Negative: never sleeps.</summary>
    public float SleepThreshold = sleepThreshold;
    /// <summary>Steps that a body must rest before it may sleep; of steps shorter than 1/240 s one counts in each such time.</summary>
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
    // Here is a byte to spare, and collidables keep their 32 bytes.
    Marks marks;

    [Flags]
    enum Marks : byte
    {
        AtSeam = 1,
        JustRipened = 2,
        WillBeTurned = 4,
        WasTurned = 8,
    }

    /// <summary>Whether the body touched several things in the last step that do not give way; their contacts then wait for each other.</summary>
    internal bool IsAtSeam
    {
        readonly get => (marks & Marks.AtSeam) != 0;
        set => marks = value ? marks | Marks.AtSeam : marks & ~Marks.AtSeam;
    }

    /// <summary>Whether it had rested long enough in the last step, and not before.</summary>
    internal readonly bool HasJustRipened => (marks & Marks.JustRipened) != 0;

    /// <summary>Whether a game has turned a kinematic body by its pose since the last step. Known when the bounds of a step are predicted.</summary>
    internal readonly bool WasTurned => (marks & Marks.WasTurned) != 0;

    /// <summary>Says that a game has turned a kinematic body by its pose, which the next step is to know.</summary>
    internal void NoteTurned() => marks |= Marks.WillBeTurned;

    /// <summary>Takes note of the speed with which a step begins.</summary>
    /// <param name="speedSquared">Speed squared, linear plus angular.</param>
    /// <param name="isCounted">Whether the step counts as one of rest: of very short ones only some do.</param>
    /// <returns>What the body adds to <see cref="Bodies.RestCounts"/>.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal long Note(float speedSquared, bool isCounted)
    {
        if ((marks & (Marks.WillBeTurned | Marks.WasTurned)) != 0 && IsTurned())
        {
            Forget();
            return 0;
        }
        // What is no number does not rest.
        if (!(speedSquared <= SleepThreshold))
        {
            Forget();
            return 0;
        }
        if (isCounted && TimestepsUnderThresholdCount < MinimumTimestepsUnderThreshold)
            ++TimestepsUnderThresholdCount;
        if (TimestepsUnderThresholdCount < MinimumTimestepsUnderThreshold)
        {
            Forgo();
            return 0;
        }
        marks = SleepCandidate ? marks & ~Marks.JustRipened : marks | Marks.JustRipened;
        var counts = SleepCandidate ? Bodies.OneRipe : Bodies.OneRipe + Bodies.OneJustRipened;
        SleepCandidate = true;
        return counts;
    }

    // What a game said since the last step is what this step knows.
    bool IsTurned()
    {
        var isTurned = (marks & Marks.WillBeTurned) != 0;
        marks &= ~(Marks.WillBeTurned | Marks.WasTurned);
        if (isTurned)
            marks |= Marks.WasTurned;
        return isTurned;
    }

    /// <summary>Begins a body that has slept: what was said of it before that is long past.</summary>
    internal void Wake()
    {
        Forget();
        marks &= ~(Marks.WillBeTurned | Marks.WasTurned);
    }

    /// <summary>Begins anew to count rest.</summary>
    internal void Forget()
    {
        TimestepsUnderThresholdCount = 0;
        Forgo();
    }

    void Forgo()
    {
        SleepCandidate = false;
        marks &= ~Marks.JustRipened;
    }
}
