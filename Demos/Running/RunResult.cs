using System.Collections.Generic;

namespace Demos.Running;

/// <summary>The time of a step over the timed steps, in milliseconds.</summary>
public readonly record struct StepTimes(double Mean, double Median, double P95, double P99, double Max);

/// <summary>A state hash and the step after which it was taken, counted from 1.</summary>
public readonly record struct StepHash(int Step, ulong Hash);

/// <summary>The figures of one run. Null is a figure that the scene or the engine does not have.</summary>
public sealed record RunResult
{
    public required string Engine { get; init; }

    public required string Scene { get; init; }

    /// <summary>Steps that were run.</summary>
    public int Steps { get; init; }

    /// <summary>Steps that were to be run; more than <see cref="Steps"/> when the run was stopped.</summary>
    public int StepsAsked { get; init; }

    public float StepDuration { get; init; }

    public int Substeps { get; init; }

    public int Iterations { get; init; }

    public int Relaxations { get; init; }

    public int Threads { get; init; }

    /// <summary>Floats in a vector.</summary>
    public int Lanes { get; init; }

    public int Seed { get; init; }

    /// <summary>Milliseconds per step.</summary>
    public StepTimes Times { get; init; }

    /// <summary>Mean milliseconds per step.</summary>
    public StageTimes Stages { get; init; }

    public int Bodies { get; init; }

    public int Awake { get; init; }

    public int Statics { get; init; }

    public long? Pairs { get; init; }

    public long? Manifolds { get; init; }

    public long? Contacts { get; init; }

    public int? Constraints { get; init; }

    public int? Batches { get; init; }

    /// <summary>Constraints that found no batch of their own colour.</summary>
    public int? Fallback { get; init; }

    /// <summary>Bytes that the steps after the warm-up allocated from the garbage collector.</summary>
    public long ManagedBytes { get; init; }

    /// <summary>Bytes that the pools took from the system in the steps after the warm-up.</summary>
    public long PoolBytes { get; init; }

    /// <summary>Metres.</summary>
    public double? MaximumPenetration { get; init; }

    /// <summary>Metres.</summary>
    public double? MaximumJointError { get; init; }

    /// <summary>Metres.</summary>
    public double? RmsJointError { get; init; }

    /// <summary>Joules.</summary>
    public double KineticEnergy { get; init; }

    /// <summary>Joules, zero at y = 0.</summary>
    public double PotentialEnergy { get; init; }

    /// <summary>Dynamic bodies more than half a metre from where they began.</summary>
    public int Moved { get; init; }

    /// <summary>Dynamic bodies below y = -50.</summary>
    public int Lost { get; init; }

    public int NotFinite { get; init; }

    /// <summary>Hash of all bodies at the end.</summary>
    public ulong Hash { get; init; }

    public IReadOnlyList<StepHash> Hashes { get; init; } = [];

    /// <summary>Whether the run was stopped before its end.</summary>
    public bool IsStopped => Steps < StepsAsked;

    /// <summary>Whether every body is still where a body can be.</summary>
    public bool IsSound => Lost == 0 && NotFinite == 0;
}
