using System;

namespace BepuPhysics;

/// <summary>Lets a simulation choose its number of substeps by the error that it reads of its own constraints.</summary>
/// <remarks>
/// The error of a step is the greatest distance at its end by which a rigid constraint is not met: how deep a contact overlaps, how far apart the points
/// are which a ball socket, a hinge or a weld holds together, how far a distance limit is overdrawn. Springs of the game's own, servos, motors and angles
/// do not count. It is read of all constraints that are awake, so the worst of them decides for all.
/// </remarks>
public struct SubstepGovernor
{
    /// <summary>Error to hold, m; above 0 and finite. The governor aims somewhat below.</summary>
    public float TargetError;
    /// <summary>Least number of substeps of a step of the usual length; at least 1.</summary>
    public int LeastSubstepCount;
    /// <summary>Greatest number of substeps of a step of the usual length; at least <see cref="LeastSubstepCount"/>.</summary>
    public int GreatestSubstepCount;

    /// <summary>Describes a governor.</summary>
    /// <param name="targetError">Error to hold, m; above 0 and finite.</param>
    /// <param name="leastSubstepCount">Least number of substeps; at least 1.</param>
    /// <param name="greatestSubstepCount">Greatest number of substeps; at least the least.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range.</exception>
    public SubstepGovernor(float targetError, int leastSubstepCount, int greatestSubstepCount)
    {
        TargetError = targetError;
        LeastSubstepCount = leastSubstepCount;
        GreatestSubstepCount = greatestSubstepCount;
        Validate();
    }

    internal readonly void Validate()
    {
        if (!(TargetError > 0 && float.IsFinite(TargetError)))
            throw new ArgumentOutOfRangeException(nameof(TargetError), TargetError, $"{nameof(TargetError)} must be above 0 and finite.");
        ArgumentOutOfRangeException.ThrowIfLessThan(LeastSubstepCount, 1, nameof(LeastSubstepCount));
        ArgumentOutOfRangeException.ThrowIfLessThan(GreatestSubstepCount, LeastSubstepCount, nameof(GreatestSubstepCount));
    }
}
