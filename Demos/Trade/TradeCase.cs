using System;
using Demos.Accuracy;

namespace Demos.Trade;

/// <summary>A scene of the trade in a world of its own: taken a step at a time by whoever times it, and looked at between the steps.</summary>
abstract class TradeCase(AccuracySettings settings) : IDisposable
{
    /// <summary>Steps of a run.</summary>
    public abstract int StepCount { get; }

    /// <summary>How far the run was from the truth, in the unit of the scene; not a number when what was to hold has broken.</summary>
    public abstract double Error { get; }

    /// <summary>Seconds of a step.</summary>
    public virtual float StepDuration(int step) => World.Settings.Dt;

    protected AccuracyWorld World { get; } = new(settings);

    /// <summary>Takes a step.</summary>
    public void Step(int step) => World.Step(StepDuration(step));

    /// <summary>Looks at the world after a step; its time is nobody's.</summary>
    public virtual void Observe(int step)
    {
    }

    /// <summary>The error, or not a number where it is so large that what was to hold has fallen.</summary>
    protected static double OrBroken(double error, double most) => error <= most ? error : double.NaN;

    public void Dispose() => World.Dispose();
}
