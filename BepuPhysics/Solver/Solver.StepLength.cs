using System;
using BepuUtilities;

namespace BepuPhysics;

// Steps of changing length.
//
// The depth at which a load rests on a rigid contact goes with the square of the substep: stiffness is bought with substeps. A stiffness that
// followed the length of each step would do work. A long step softens what holds a stack, which falls onto the softer springs; short ones stiffen
// them, and the springs give back more than the fall has put into them: F^2 / 2 (k2 - k1) / k2 (1 / k1 - 1 / k2) for each contact under a force F,
// 2.25 times the stored energy for one step of twice the length. Meanwhile the stack is below the stiffness at which it buckles.
//
// So what a game asks for, SubstepCount, is the number of substeps in a step of its usual length: a longer step is divided into more of them, a
// shorter one into fewer, all of about the same length; and rigid constraints are as stiff as in the usual substep, whatever the present one is. Both
// usual lengths are means that move slowly, so that a game which changes its rate for good has what it asked for in the end. All of this is exact where
// the length never changes: then the usual length is that one to the bit.
public sealed partial class Solver
{
    /// <summary>Part of its difference from the present length by which a usual length moves in a step.</summary>
    const float FollowedPerStep = 0.005f;
    /// <summary>First steps of which each is taken for the usual one.</summary>
    const int OddSteps = 2;
    /// <summary>The most substeps of a step, in multiples of what was asked for.</summary>
    const double GreatestMultiple = 4;

    // What carries over from step to step; zero before the first.
    float previousSubstepDt;
    float usualDt;
    float usualSubstepDt;
    int stepsSeen;

    /// <summary>The usual length of a step, s; 0 before the first.</summary>
    internal float UsualDt => usualDt;

    /// <summary>While a step is solved: the length of the one before, s; 0 in the first.</summary>
    internal float PreviousDt { get; private set; }

    bool hasFixedSubstepCount;

    /// <summary>
    /// Whether every step has <see cref="SubstepCount"/> substeps, whatever its length. If not, that is the number for a step of the usual length, and others
    /// have substeps of about the same length.
    /// </summary>
    /// <remarks>With a fixed number a step that is longer than usual is less accurate, and a stack that bears the usual steps may sink or fall in it.</remarks>
    public bool HasFixedSubstepCount
    {
        get => hasFixedSubstepCount;
        set
        {
            world.CheckChangeable("Solver.HasFixedSubstepCount");
            hasFixedSubstepCount = value;
        }
    }

    /// <summary>Substeps of the present step while it is solved, and of the last one afterwards; 0 before the first.</summary>
    public int LastSubstepCount { get; private set; }

    /// <summary>About how long the substeps of a step will be, s: before it begins, its number of them is not rounded yet.</summary>
    internal float ForeseeSubstepDt(float dt) =>
        stepsSeen < OddSteps || (hasFixedSubstepCount && governor is null) ? dt / substepCount : MathHelper.Min(dt, usualSubstepDt);

    /// <summary>Divides a step into substeps.</summary>
    /// <returns>Length of its substeps, s.</returns>
    float BeginStep(float dt)
    {
        if (governor is SubstepGovernor settings)
        {
            LastSubstepCount = GovernedSubstepCount(settings, dt);
            return dt / LastSubstepCount;
        }
        // The first step of a game is often an odd one, and nothing has sunk into anything yet: the second one says what is usual.
        if (stepsSeen < OddSteps)
        {
            ++stepsSeen;
            usualDt = dt;
            usualSubstepDt = dt / substepCount;
        }
        usualDt += (dt - usualDt) * FollowedPerStep;
        usualSubstepDt += (dt / substepCount - usualSubstepDt) * FollowedPerStep;
        // To the nearest number, where that of a step of the usual length is exact.
        var wanted = Math.Ceiling(substepCount * (double)(dt / usualDt) - 0.5);
        LastSubstepCount = hasFixedSubstepCount ? substepCount : (int)Math.Clamp(wanted, 1, Math.Min(substepCount * GreatestMultiple, int.MaxValue));
        return dt / LastSubstepCount;
    }

    void ForgetStepLengths()
    {
        previousSubstepDt = 0;
        usualDt = 0;
        usualSubstepDt = 0;
        stepsSeen = 0;
        LastSubstepCount = 0;
        LastConstraintError = 0;
        governedCount = 0;
        recentError = 0;
    }
}
