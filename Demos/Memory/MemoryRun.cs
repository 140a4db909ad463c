using System;
using System.Diagnostics;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Memory;

/// <summary>Memory in bytes per body.</summary>
/// <param name="Resident">What the process has more in memory than before there was a world.</param>
/// <param name="Peak">The most of it at any time.</param>
/// <param name="Held">What pools hold from the system, touched or not.</param>
/// <param name="Lent">What of it is lent; null where the engine does not tell.</param>
readonly record struct MemoryFigures(double Resident, double Peak, double Held, double? Lent);

/// <summary>A world of separate boxes that lie on a ground, and the memory that it takes.</summary>
static class MemoryRun
{
    const int SmallWorld = 64;

    /// <summary>Makes the world, steps it and measures.</summary>
    /// <param name="bodies">Number of boxes.</param>
    /// <param name="steps">Number of steps before memory is looked at.</param>
    /// <param name="threads">Threads that step.</param>
    /// <param name="sleepThreshold">Speed below which the boxes may fall asleep, m/s; negative where they stay awake.</param>
    public static MemoryFigures Measure(int bodies, int steps, int threads, float sleepThreshold)
    {
        using var dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        // What is compiled, and what the runtime needs, is there before.
        Measure(SmallWorld, steps, dispatcher, sleepThreshold, 0, 0);
        GC.Collect();
        return Measure(bodies, steps, dispatcher, sleepThreshold, Environment.WorkingSet, dispatcher?.WorkerPools.GetTotalAllocatedByteCount() ?? 0);
    }

    static MemoryFigures Measure(int bodies, int steps, ThreadDispatcher? dispatcher, float sleepThreshold, long residentBefore, ulong heldBefore)
    {
        using var pool = new BufferPool();
        var material = new PairMaterialProperties(1, EngineDefaults.MaximumRecoveryVelocity, EngineDefaults.ContactSpring);
        var simulation = Simulation.Create(
            pool, new SceneNarrowPhaseCallbacks(new ContactRecorder(dispatcher?.ThreadCount ?? 1), material),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, 0), EngineDefaults.Solve(new RunSettings()));
        AddBoxes(simulation, bodies, sleepThreshold);
        for (int i = 0; i < steps; ++i)
            simulation.Timestep(1 / 60f, dispatcher);
        GC.Collect();
        using var process = Process.GetCurrentProcess();
        ulong held = pool.GetTotalAllocatedByteCount() + (dispatcher?.WorkerPools.GetTotalAllocatedByteCount() ?? 0) - heldBefore;
        var figures = new MemoryFigures(
            (Environment.WorkingSet - residentBefore) / (double)bodies, (process.PeakWorkingSet64 - residentBefore) / (double)bodies,
            held / (double)bodies, EngineDefaults.LentBytes(pool) / (double?)bodies);
        simulation.Dispose();
        return figures;
    }

    static void AddBoxes(Simulation simulation, int count, float sleepThreshold)
    {
        const float spacing = 2.5f;
        int width = (int)Math.Ceiling(Math.Sqrt(count));
        var ground = new Box(spacing * (width + 2), 1, spacing * (width + 2));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -0.5f, 0), simulation.Shapes.Add(ground)));
        var box = new Box(1, 1, 1);
        BodyInertia inertia = box.ComputeInertia(1);
        var collidable = new CollidableDescription(simulation.Shapes.Add(box));
        for (int i = 0; i < count; ++i)
        {
            var place = new Vector3(i % width - (width - 1) * 0.5f, 0, i / width - (width - 1) * 0.5f) * spacing + new Vector3(0, 0.5f, 0);
            simulation.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(place), inertia, collidable, new BodyActivityDescription(sleepThreshold)));
        }
    }
}
