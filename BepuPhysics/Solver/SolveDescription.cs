using System;

namespace BepuPhysics;

/// <summary>How hard the solver works: the dial between speed and accuracy.</summary>
/// <remarks>Substeps are the first dial: four with one iteration each are more accurate than one with eight, at about the same cost.</remarks>
public struct SolveDescription
{
    /// <summary>Number of batches before constraints of a body go to the fallback batch, unless said otherwise.</summary>
    public const int DefaultFallbackBatchThreshold = 64;

    /// <summary>Sweeps over the constraints per substep; at least 1.</summary>
    public int VelocityIterationCount;
    /// <summary>
    /// Parts into which a step of the usual length is divided; at least 1. Longer steps have more of them, up to four times as many, and shorter
    /// ones fewer, so that all are of about the same length.
    /// </summary>
    public int SubstepCount;
    /// <summary>Whether every step has <see cref="SubstepCount"/> parts, whatever its length.</summary>
    public bool HasFixedSubstepCount;
    /// <summary>Chooses the number of substeps by the error of the constraints; null for <see cref="SubstepCount"/>.</summary>
    public SubstepGovernor? Governor;
    /// <summary>Number of batches before constraints of a body go to the fallback batch; at least 1.</summary>
    public int FallbackBatchThreshold;
    /// <summary>Sweeps per substep that take back the velocity which the correction of positions has left behind; 0 for none.</summary>
    /// <remarks>
    /// One costs about half as much as a substep with one iteration. Rigid joints are then as stiff as with twice the substeps, rigid contacts, and joints of
    /// bodies that have three or more, as with half again as many; what overlaps parts without being thrown, and energy is kept better.
    /// What has a frequency of its own, and servos, gain nothing.
    /// </remarks>
    public int RelaxationIterationCount;
    /// <summary>
    /// Whether rigid contacts stop what comes fast at once, in steps of four substeps and more; not unless said otherwise. What falls flat at 10 m/s leaves
    /// with a tenth of that and a spin without, and lies still with it. It is new: what is crushed, under great gravity or by a thousand times its mass, is
    /// thrown farther by it.
    /// </summary>
    public bool StopsImpacts;
    /// <summary>
    /// Frequency of rigid contacts, Hz, where sweeps hold that; 0 for as stiff as sweeps hold, which is 30 Hz at four substeps of sixty steps a second, and
    /// goes with the number of both.
    /// </summary>
    /// <remarks>
    /// What falls onto each other is thrown about the more the stiffer contacts are: of 32 houses of three storeys that are dropped layer by layer 11 fall
    /// at eight substeps, 27 at sixteen, and none at 30 Hz. What no <see cref="LoadPath"/> carries, heaps and what is squeezed, sinks in by the inverse
    /// square of it. Changed while things rest on each other it lifts them or lets them sink.
    /// </remarks>
    public float ContactFrequency;
    /// <summary>
    /// Whether rigid joints close slowly what they are off by when they are added, or enabled: with a time constant of .2 s, and at no more than five radii
    /// of gyration, or radians, a second for any body; not unless said otherwise, when they close it as fast as a substep can. Ropes that are cut and joined
    /// again with a gap are not thrown about by it. What opens later is corrected at once, and so is what has a frequency of its own.
    /// </summary>
    public bool ClosesGapsSlowly;
    /// <summary>
    /// Whether loads of what rests on others are handed down to the ground in one go; <see cref="LoadPathMode.WhereNeeded"/> unless said otherwise.
    /// </summary>
    public LoadPathMode LoadPath;
    /// <summary>
    /// Whether all joints of a structure are solved at once, so that none gives way, whatever hangs in it: nowhere, everywhere, or where sweeps do not hold
    /// them; <see cref="DirectJointsMode.Off"/> unless said otherwise.
    /// </summary>
    public DirectJointsMode DirectJoints;
    /// <summary>Chooses the number of velocity iterations of each substep; null for the same in all.</summary>
    public SubstepVelocityIterationScheduler? VelocityIterationScheduler;

    /// <summary>Two substeps: for scenes in which things lie about and few joints bear loads. Joints give way four times as far as by default.</summary>
    public static SolveDescription Fast => new(1, 2);

    /// <summary>Four substeps: towers and walls stand, heavy things rest on light ones.</summary>
    public static SolveDescription Default => new(1, 4);

    /// <summary>
    /// Eight substeps with a relaxation: joints give way a sixteenth as far as by default, and what <see cref="LoadPath"/> cannot help, arches, stands as well.
    /// </summary>
    public static SolveDescription Accurate => new(1, 8) { RelaxationIterationCount = 1 };

    /// <summary>The same number of iterations in each substep.</summary>
    public SolveDescription(int velocityIterationCount, int substepCount, int fallbackBatchThreshold = DefaultFallbackBatchThreshold)
    {
        VelocityIterationCount = velocityIterationCount;
        SubstepCount = substepCount;
        FallbackBatchThreshold = fallbackBatchThreshold;
        LoadPath = LoadPathMode.WhereNeeded;
        Validate();
    }

    /// <summary>A number of iterations for each substep, chosen by a function.</summary>
    public SolveDescription(
        int substepCount, SubstepVelocityIterationScheduler velocityIterationScheduler, int fallbackBatchThreshold = DefaultFallbackBatchThreshold)
        : this(1, substepCount, fallbackBatchThreshold) =>
        VelocityIterationScheduler = velocityIterationScheduler ?? throw new ArgumentNullException(nameof(velocityIterationScheduler));

    /// <summary>A number of iterations for each substep.</summary>
    public SolveDescription(ReadOnlySpan<int> substepVelocityIterations, int fallbackBatchThreshold = DefaultFallbackBatchThreshold)
        : this(1, substepVelocityIterations.Length, fallbackBatchThreshold)
    {
        var iterations = substepVelocityIterations.ToArray();
        foreach (var count in iterations)
            ArgumentOutOfRangeException.ThrowIfLessThan(count, 1, nameof(substepVelocityIterations));
        VelocityIterationScheduler = substep => substep < iterations.Length ? iterations[substep] : 0;
    }

    /// <summary>One substep with a number of iterations.</summary>
    public static implicit operator SolveDescription(int velocityIterationCount) => new(velocityIterationCount, 1);
    /// <summary>Iterations per substep, and substeps.</summary>
    public static implicit operator SolveDescription((int velocityIterationCount, int substepCount) schedule) =>
        new(schedule.velocityIterationCount, schedule.substepCount);
    /// <summary>Iterations of each substep.</summary>
    public static implicit operator SolveDescription(ReadOnlySpan<int> substepVelocityIterations) => new(substepVelocityIterations);
    /// <summary>Iterations of each substep.</summary>
    public static implicit operator SolveDescription(int[] substepVelocityIterations) => new(substepVelocityIterations.AsSpan());

    internal readonly void Validate()
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(VelocityIterationCount, 1, nameof(VelocityIterationCount));
        ArgumentOutOfRangeException.ThrowIfLessThan(SubstepCount, 1, nameof(SubstepCount));
        ArgumentOutOfRangeException.ThrowIfNegative(RelaxationIterationCount, nameof(RelaxationIterationCount));
        ArgumentOutOfRangeException.ThrowIfLessThan(FallbackBatchThreshold, 1, nameof(FallbackBatchThreshold));
        CheckFrequency(ContactFrequency);
        Check(LoadPath);
        Check(DirectJoints);
        Governor?.Validate();
    }

    internal static void CheckFrequency(float frequency)
    {
        if (!(frequency >= 0 && frequency <= Limits.MaximumSpringFrequency))
            throw new ArgumentOutOfRangeException(
                nameof(frequency), frequency, $"{nameof(ContactFrequency)} must be from 0 to {Limits.MaximumSpringFrequency} Hz.");
    }

    internal static void Check(DirectJointsMode mode)
    {
        if (mode is < DirectJointsMode.Off or > DirectJointsMode.WhereNeeded)
            throw new ArgumentOutOfRangeException(nameof(mode), mode, $"{nameof(DirectJoints)}: there is no such mode.");
    }

    internal static void Check(LoadPathMode mode)
    {
        if (mode is < LoadPathMode.Off or > LoadPathMode.Always)
            throw new ArgumentOutOfRangeException(nameof(mode), mode, $"{nameof(LoadPath)}: there is no such mode.");
    }
}
