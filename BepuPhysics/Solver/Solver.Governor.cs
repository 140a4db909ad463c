using System;
using BepuUtilities;

namespace BepuPhysics;

// Substeps by the error of the constraints.
//
// What moves is one real number, the governed count: rigid constraints are as stiff as in a step of so many substeps, and a step has as many whole ones as
// that takes. So the stiffness never jumps, however the whole number does, and no substep is longer than the one to which its stiffness belongs.
//
// A change of stiffness does work, F^2 / 2 (k2 - k1) / k2 (1 / k1 - 1 / k2) for each contact under a force F (Solver.StepLength.cs): the square of the
// relative change, so many small changes give less than a great one, and the damping takes it. The count grows faster than it shrinks: a load that has
// come sinks in meanwhile, and one that has gone only costs.
public sealed partial class Solver
{
    /// <summary>Part of the governed count by which it grows at most in a step.</summary>
    const float RaisedPerStep = 0.05f;
    /// <summary>Part of the governed count by which it shrinks at most in a step.</summary>
    const float LoweredPerStep = 0.02f;
    /// <summary>Part of the greatest error that is remembered for another step.</summary>
    const float RememberedPerStep = 0.95f;
    /// <summary>The greatest error that is remembered, in multiples of the target: a second later nothing is left of an accident.</summary>
    const float GreatestRemembered = 16;
    // Between these parts of the target nothing changes; outside, the count goes for the middle one.
    const float QuietFrom = 0.65f;
    const float Aim = 0.8f;
    const float QuietTo = 0.9f;
    /// <summary>Part of a substep by which the stiffness may be ahead of the whole number.</summary>
    // It absorbs the rounding of usual lengths, and bounds what is beyond the limit of stiffness to a hundredth.
    const double CountSlack = 0.01;

    readonly ConstraintErrorStage errorStage;
    SubstepGovernor? governor;
    float governedCount;
    float recentError;

    /// <summary>
    /// Chooses the number of substeps by the error of the constraints; null for <see cref="SubstepCount"/>, which then is only where the first step begins.
    /// </summary>
    /// <remarks>It costs a pass over the constraints in each step. Settings may change at any time between steps: stiffness follows slowly.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">A value is out of its range; nothing was changed.</exception>
    public SubstepGovernor? Governor
    {
        get => governor;
        set
        {
            value?.Validate();
            world.CheckChangeable("Solver.Governor");
            if (value is null)
                LastConstraintError = 0;
            else if (governor is null)
            {
                // From the present stiffness; before the first steps it is chosen there.
                governedCount = stepsSeen < OddSteps ? 0 : usualDt / usualSubstepDt;
                recentError = 0;
            }
            governor = value;
        }
    }

    /// <summary>
    /// Greatest distance by which a rigid constraint was not met at the end of the last step, m; 0 before the first step with a <see cref="Governor"/>,
    /// and without one.
    /// </summary>
    public float LastConstraintError { get; private set; }

    // The usual substep is the one that the governed count is for, and the whole number what that takes.
    int GovernedSubstepCount(in SubstepGovernor governor, float dt)
    {
        // As without a governor the first steps are each taken for usual: nothing has sunk into anything yet.
        if (stepsSeen < OddSteps)
        {
            ++stepsSeen;
            usualDt = dt;
            governedCount = Math.Clamp(substepCount, governor.LeastSubstepCount, governor.GreatestSubstepCount);
        }
        usualDt += (dt - usualDt) * FollowedPerStep;
        usualSubstepDt = usualDt / governedCount;
        var count = Math.Clamp((double)governedCount, governor.LeastSubstepCount, governor.GreatestSubstepCount);
        var length = hasFixedSubstepCount ? 1 : (double)(dt / usualDt);
        return (int)Math.Clamp(Math.Ceiling(count * length - CountSlack), 1, Math.Min(Math.Ceiling(count) * GreatestMultiple, int.MaxValue));
    }

    void ReadError()
    {
        if (governor is not SubstepGovernor settings)
            return;
        LastConstraintError = errorStage.Error;
        // A load that swings is near its place twice in each period: what is quiet has been so for some time.
        recentError = MathHelper.Max(
            MathHelper.Min(LastConstraintError, GreatestRemembered * settings.TargetError), recentError * RememberedPerStep);
        var next = governedCount;
        if (LastConstraintError > QuietTo * settings.TargetError)
            next = CountFor(LastConstraintError, settings.TargetError);
        else if (recentError < QuietFrom * settings.TargetError)
            next = CountFor(recentError, settings.TargetError);
        next = MathHelper.Max(settings.LeastSubstepCount, MathHelper.Min(next, settings.GreatestSubstepCount));
        governedCount = MathHelper.Max(governedCount * (1 - LoweredPerStep), MathHelper.Min(next, governedCount * (1 + RaisedPerStep)));
    }

    // What rests on springs is as deep as the square of their substep.
    float CountFor(float error, float target) => governedCount * MathF.Sqrt(error / (Aim * target));
}
