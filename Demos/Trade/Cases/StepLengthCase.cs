using System;
using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>A stack under steps that change by up to four times from one to the next, as of a game that stutters.</summary>
sealed class StepLengthCase(AccuracySettings settings) : StackCase(settings, 10)
{
    static ReadOnlySpan<int> StepsPerSecond => [60, 120, 60, 30, 90, 144, 45, 60, 240, 75, 100, 30, 120];

    public override int StepCount => 390;

    public override float StepDuration(int step) => 1f / StepsPerSecond[step % StepsPerSecond.Length];
}
