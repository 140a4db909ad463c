using Demos.Engine;

namespace Demos.Running;

/// <summary>How a scene is run; nothing in here changes what the scene is.</summary>
public sealed record RunSettings
{
    /// <summary>Steps to run, warm-up included; the scene's own number when null.</summary>
    public int? Steps { get; init; }

    /// <summary>Seconds per step.</summary>
    public float StepDuration { get; init; } = 1 / 60f;

    public int Substeps { get; init; } = 4;

    /// <summary>Velocity iterations per substep.</summary>
    public int Iterations { get; init; } = 1;

    /// <summary>Sweeps per substep that take back what the correction of positions leaves of velocity.</summary>
    public int Relaxations { get; init; }

    /// <summary>Whether loads are handed down to the ground in one go.</summary>
    public LoadPathChoice LoadPath { get; init; } = EngineDefaults.LoadPath;

    /// <summary>Whether all joints of a structure are solved at once.</summary>
    public DirectJointsChoice DirectJoints { get; init; } = EngineDefaults.DirectJoints;

    public int Threads { get; init; } = 1;

    /// <summary>Seed of the scenes that are random.</summary>
    public int Seed { get; init; } = 1;

    /// <summary>Steps between two recorded hashes; 0 records none.</summary>
    public int HashEvery { get; init; }

    /// <summary>First steps that no time or byte is counted of; when null 30, but never more than half of the steps.</summary>
    public int? Warmup { get; init; }

    /// <summary>Whether bodies may fall asleep; as the scene says when null.</summary>
    public bool? Sleep { get; init; }

    /// <summary>Whether all events of all bodies are listened to, and part of the recorded hashes.</summary>
    public bool Listen { get; init; }

    /// <summary>Frequency in Hz of contacts and joints; the engine's own default when null.</summary>
    public float? Frequency { get; init; }

    /// <summary>Damping ratio of contacts and joints; 1 when null and a frequency is given.</summary>
    public float? DampingRatio { get; init; }
}
