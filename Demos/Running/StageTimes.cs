namespace Demos.Running;

/// <summary>Where a step's time goes, in the order of the step. Null where the engine does not say.</summary>
public readonly record struct StageTimes(
    double? Sleep, double? Predict, double? Broad, double? Narrow, double? Flush, double? Solve, double? Settle)
{
    /// <summary>What <see cref="Add"/> starts from.</summary>
    public static StageTimes Zero => new(0, 0, 0, 0, 0, 0, 0);

    /// <summary>The sum, stage by stage; what one side does not know stays unknown.</summary>
    public StageTimes Add(in StageTimes other) => new(Sleep + other.Sleep, Predict + other.Predict, Broad + other.Broad,
        Narrow + other.Narrow, Flush + other.Flush, Solve + other.Solve, Settle + other.Settle);

    /// <summary>Each stage times the factor.</summary>
    public StageTimes Scale(double factor) => new(Sleep * factor, Predict * factor, Broad * factor, Narrow * factor,
        Flush * factor, Solve * factor, Settle * factor);
}
