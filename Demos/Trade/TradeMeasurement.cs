using System;
using System.Diagnostics;
using System.Threading;
using Demos.Accuracy;

namespace Demos.Trade;

/// <summary>One run of a scene at one setting.</summary>
/// <param name="Error">In the scene's unit; null when what was to hold has broken, or is no longer finite.</param>
/// <param name="Milliseconds">Of each step.</param>
sealed record TradeMeasurement(double? Error, double[] Milliseconds)
{
    /// <summary>Runs a scene; null when it was stopped before its end.</summary>
    /// <param name="scene">What runs.</param>
    /// <param name="settings">How hard the engine works.</param>
    /// <param name="stop">Asked after each step.</param>
    /// <param name="steps">Steps to run; all of the scene's when null.</param>
    public static TradeMeasurement? Take(TradeScene scene, AccuracySettings settings, CancellationToken stop, int? steps = null)
    {
        using TradeCase run = scene.Create(settings);
        var milliseconds = new double[Math.Min(steps ?? run.StepCount, run.StepCount)];
        for (int i = 0; i < milliseconds.Length; ++i)
        {
            if (stop.IsCancellationRequested)
                return null;
            long start = Stopwatch.GetTimestamp();
            run.Step(i);
            milliseconds[i] = Stopwatch.GetElapsedTime(start).TotalMilliseconds;
            run.Observe(i);
        }
        double error = run.Error;
        return new TradeMeasurement(double.IsFinite(error) ? error : null, milliseconds);
    }
}
