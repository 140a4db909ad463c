using System;
using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Running;
using Demos.Scenes;

namespace DemoTests.Scenes;

/// <summary>A scene of the runner in a simulation whose pools can be looked at, and must be empty at its end.</summary>
sealed unsafe class SceneWorld : IDisposable
{
    readonly BufferPool pool = new();
    readonly ThreadDispatcher? dispatcher;
    readonly long[] workerBytes;
    // Made once, so that asking costs nothing.
    readonly Action<int> readWorkerBytes;

    public SceneWorld(SceneDescription scene, int threads, int relaxations = 0, LoadPathMode loadPath = LoadPathMode.WhereNeeded)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        workerBytes = new long[threads];
        readWorkerBytes = worker => workerBytes[worker] = GC.GetAllocatedBytesForCurrentThread();
        var recorder = new ContactRecorder(threads);
        Simulation = Simulation.Create(
            pool,
            new SceneNarrowPhaseCallbacks(recorder,
                new PairMaterialProperties(scene.Friction, EngineDefaults.MaximumRecoveryVelocity, EngineDefaults.ContactSpring)),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, scene.Damping),
            new SolveDescription(1, 4) { RelaxationIterationCount = relaxations, LoadPath = loadPath });
        SceneBuilder.Build(scene, Simulation, EngineDefaults.JointSpring, recorder);
    }

    public Simulation Simulation { get; }

    /// <summary>Bytes that the pools of the simulation and of the workers hold.</summary>
    public ulong PoolBytes => pool.GetTotalAllocatedByteCount() + (dispatcher?.WorkerPools.GetTotalAllocatedByteCount() ?? 0);

    public void Step() => Simulation.Timestep(1 / 60f, dispatcher);

    /// <summary>Bytes that the threads that step have allocated from the garbage collector; those of other tests are not among them.</summary>
    public long ManagedBytes()
    {
        if (dispatcher is null)
            return GC.GetAllocatedBytesForCurrentThread();
        dispatcher.DispatchWorkers(readWorkerBytes);
        long sum = 0;
        foreach (long bytes in workerBytes)
            sum += bytes;
        return sum;
    }

    /// <summary>Hash after each of a number of steps.</summary>
    public List<ulong> HashSteps(int count)
    {
        var hashes = new List<ulong>(count);
        for (int i = 0; i < count; ++i)
        {
            Step();
            hashes.Add(Simulation.StateHash());
        }
        return hashes;
    }

    public void Dispose()
    {
        Simulation.DisposeHulls();
        Simulation.Dispose();
        pool.AssertEmpty();
        dispatcher?.WorkerPools.AssertEmpty();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
