namespace Demos.Fuzz;

/// <summary>How long and what for.</summary>
sealed record FuzzSettings
{
    public int Seed { get; init; } = 1;

    public long Calls { get; init; } = 1_000_000;

    public int CallsPerWorld { get; init; } = 400;

    /// <summary>The one world to run; all when null.</summary>
    public int? World { get; init; }

    public FuzzScope Scope { get; init; } = FuzzScope.All;

    /// <summary>Failures after which a run ends.</summary>
    public int MaximumFailures { get; init; } = 1;

    /// <summary>Time for leaving out calls that a failure does not need.</summary>
    public int ShrinkSeconds { get; init; } = 60;

    /// <summary>File that says where a run is, for when it dies; none when null.</summary>
    public string? TracePath { get; init; }
}
