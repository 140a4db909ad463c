using System;
using System.Collections.Generic;
using System.Numerics;
using System.Threading;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Scenes;

namespace Demos.Running;

/// <summary>One scene in a simulation of its own: built, stepped, measured, disposed of.</summary>
public sealed class SceneRun : IDisposable
{
    const int DefaultWarmup = 30;
    // A step of so many is long enough for anybody; beyond, a slip of the finger would look like a hang.
    const int MaximumSweeps = 1_000_000;

    readonly SceneDescription scene;
    readonly RunSettings settings;
    readonly int steps;
    readonly int warmup;
    readonly BufferPool pool;
    readonly ThreadDispatcher? dispatcher;
    readonly Simulation simulation;
    readonly ContactRecorder recorder;
    readonly BuiltScene built;
    readonly List<StepHash> hashes = [];

    /// <summary>Builds the scene.</summary>
    /// <exception cref="SceneException">The settings do not fit the scene, or the engine lacks something that the scene needs.</exception>
    public SceneRun(SceneDescription scene, RunSettings settings)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(settings);
        this.scene = scene;
        this.settings = settings;
        steps = settings.Steps ?? scene.Steps;
        warmup = settings.Warmup ?? Math.Min(DefaultWarmup, steps / 2);
        Refuse(settings);
        if (steps <= warmup)
            throw new SceneException($"the warm-up of {warmup} steps leaves none of {steps} to measure");

        (SpringSettings contactSpring, SpringSettings jointSpring) = (EngineDefaults.ContactSpring, EngineDefaults.JointSpring);
        if (settings.Frequency is float frequency)
            contactSpring = jointSpring = new SpringSettings(frequency, settings.DampingRatio ?? 1);
        pool = new BufferPool();
        recorder = new ContactRecorder(settings.Threads);
        dispatcher = settings.Threads > 1 ? new ThreadDispatcher(settings.Threads) : null;
        simulation = Simulation.Create(pool,
            new SceneNarrowPhaseCallbacks(recorder,
                new PairMaterialProperties(scene.Friction, EngineDefaults.MaximumRecoveryVelocity, contactSpring)),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, scene.Damping),
            EngineDefaults.Solve(settings));
        try
        {
            built = SceneBuilder.Build(scene, simulation, jointSpring, recorder, settings.Sleep);
            if (settings.Listen)
                EngineEvents.ListenToAll(simulation);
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>Runs all steps and returns the figures.</summary>
    /// <param name="progress">Called between steps with the number of steps done; its time and its garbage are not counted.</param>
    /// <param name="stop">Ends the run after the step that is under way; the figures are then those of the steps so far.</param>
    public RunResult Run(Action<int>? progress = null, CancellationToken stop = default)
    {
        var clock = new StepClock();
        StageTimes stages = StageTimes.Zero;
        clock.Reset();
        ulong poolBytesAtReset = PoolBytes();
        int step = 0;
        while (step < steps && !stop.IsCancellationRequested)
        {
            ++step;
            clock.Begin();
            simulation.Timestep(settings.StepDuration, dispatcher);
            clock.End();
            stages = stages.Add(EngineDefaults.ReadStages(simulation));
            if (settings.HashEvery > 0 && step % settings.HashEvery == 0)
                hashes.Add(new StepHash(step, settings.Listen ? EngineEvents.Hash(simulation, built.Hash()) : built.Hash()));
            progress?.Invoke(step);
            if (step == warmup)
            {
                clock.Reset();
                stages = StageTimes.Zero;
                poolBytesAtReset = PoolBytes();
            }
        }
        long managedBytes = clock.ManagedBytes;
        long poolBytes = (long)(PoolBytes() - poolBytesAtReset);
        RunResult result = built.Measure(new RunResult
        {
            Engine = EngineDefaults.Name,
            Scene = scene.Name,
            Steps = step,
            StepsAsked = steps,
            StepDuration = settings.StepDuration,
            Substeps = settings.Substeps,
            Iterations = settings.Iterations,
            Relaxations = settings.Relaxations,
            Threads = settings.Threads,
            Lanes = Vector<float>.Count,
            Seed = settings.Seed,
            Times = clock.Summarize(),
            Stages = stages.Scale(1000.0 / clock.Count),
            Bodies = built.BodyCount,
            Awake = simulation.Bodies.ActiveSet.Count,
            Statics = simulation.Statics.Count,
            Constraints = simulation.Solver.CountConstraints(),
            Batches = EngineDefaults.CountBatches(simulation),
            Fallback = EngineDefaults.CountFallback(simulation),
            ManagedBytes = managedBytes,
            PoolBytes = poolBytes,
            Hash = built.Hash(),
            Hashes = hashes,
        });
        return result.NotFinite == 0 ? MeasureContacts(result) : result;
    }

    /// <summary>
    /// Contacts are found at the start of a step, so one more step tells those of the final poses. It comes last: nothing else is
    /// measured after it, and no timed step pays for the recording.
    /// </summary>
    RunResult MeasureContacts(RunResult result)
    {
        recorder.Begin();
        simulation.Timestep(settings.StepDuration, dispatcher);
        ContactRecorder.Slot found = recorder.End();
        return result with
        {
            Pairs = found.Pairs,
            Manifolds = found.Manifolds,
            Contacts = found.Contacts,
            MaximumPenetration = found.Pairs > 0 ? found.GreatestDepth : null,
        };
    }

    /// <summary>The simulation, for what a run does not do by itself.</summary>
    public Simulation Simulation => simulation;

    /// <summary>Takes one step and measures nothing, for those who measure it themselves.</summary>
    public void Step() => simulation.Timestep(settings.StepDuration, dispatcher);

    /// <summary>Where a body is turned to now. Bodies count in the scene's order, statics left out.</summary>
    public Quaternion Orientation(int bodyIndex) => built[bodyIndex].Pose.Orientation;

    /// <inheritdoc/>
    public void Dispose()
    {
        simulation.Dispose();
        dispatcher?.Dispose();
        pool.Clear();
    }

    ulong PoolBytes() => (ulong)pool.GetTotalAllocatedByteCount() + (ulong)(dispatcher?.WorkerPools.GetTotalAllocatedByteCount() ?? 0);

    static void Refuse(RunSettings settings)
    {
        Require(settings.Steps is null or > 0, "steps", settings.Steps);
        Require(settings.StepDuration is > 0 and <= EngineDefaults.MaximumTimestep, "dt", settings.StepDuration);
        Require(settings.Substeps is > 0 and <= MaximumSweeps, "substeps", settings.Substeps);
        Require(settings.Iterations is > 0 and <= MaximumSweeps, "iterations", settings.Iterations);
        Require(settings.Relaxations is >= 0 and <= MaximumSweeps, "relaxations", settings.Relaxations);
        long sweeps = (long)settings.Substeps * (settings.Iterations + settings.Relaxations);
        Require(sweeps <= MaximumSweeps, "substeps times iterations and relaxations", sweeps);
        Require(settings.Threads is > 0 and <= 1024, "threads", settings.Threads);
        Require(settings.HashEvery >= 0, "hash-every", settings.HashEvery);
        Require(settings.Warmup is null or >= 0, "warmup", settings.Warmup);
        Require(settings.Frequency is null or (> 0 and <= EngineDefaults.MaximumSpringFrequency), "frequency", settings.Frequency);
        Require(settings.DampingRatio is null or (>= 0 and <= EngineDefaults.MaximumDampingRatio), "damping-ratio", settings.DampingRatio);
        Require(settings.DampingRatio is null || settings.Frequency is not null, "damping-ratio without frequency", settings.DampingRatio);
    }

    static void Require(bool condition, string setting, object? value)
    {
        if (!condition)
            throw new SceneException(FormattableString.Invariant($"the setting {setting} cannot be {value}"));
    }
}
