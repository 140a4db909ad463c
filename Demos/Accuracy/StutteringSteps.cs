using System;

namespace Demos.Accuracy;

/// <summary>Steps that change by up to four times from one to the next, as of a game that stutters.</summary>
static class StutteringSteps
{
    static ReadOnlySpan<int> PerSecond => [60, 120, 60, 30, 90, 144, 45, 60, 240, 75, 100, 30, 120];

    /// <summary>Seconds of a step, by its number.</summary>
    public static float Duration(int step) => 1f / PerSecond[step % PerSecond.Length];
}
