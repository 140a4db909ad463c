using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Towers;

/// <summary>A simulation of parts that nothing holds but weight and friction.</summary>
sealed class TowerWorld : IDisposable
{
    /// <summary>Acceleration of all parts along y, m/s2.</summary>
    public const float Gravity = -9.81f;

    readonly BufferPool pool = new();
    readonly ThreadDispatcher? dispatcher;
    readonly BodyHandle[] parts;

    public TowerWorld(SceneDescription scene, TowerSettings settings)
    {
        var recorder = new ContactRecorder(settings.Threads);
        var material = new PairMaterialProperties(scene.Friction, EngineDefaults.MaximumRecoveryVelocity, EngineDefaults.ContactSpring);
        dispatcher = settings.Threads > 1 ? new ThreadDispatcher(settings.Threads) : null;
        Simulation = Simulation.Create(pool, new SceneNarrowPhaseCallbacks(recorder, material), new ScenePoseIntegratorCallbacks(Gravity, 0),
            new SolveDescription(settings.Iterations, settings.Substeps)
            {
                RelaxationIterationCount = settings.Relaxations,
                LoadPath = settings.LoadPath,
            });
        BuiltScene built = SceneBuilder.Build(scene, Simulation, EngineDefaults.JointSpring, recorder);
        parts = new BodyHandle[built.BodyCount];
        var starts = new Vector3[parts.Length];
        for (int i = 0; i < parts.Length; ++i)
        {
            parts[i] = built[i].Handle;
            starts[i] = built[i].Pose.Position;
        }
        Starts = starts;
    }

    public Simulation Simulation { get; }

    /// <summary>Where the parts were at the beginning. Kinematic bodies count as parts.</summary>
    public IReadOnlyList<Vector3> Starts { get; }

    /// <summary>A part, in the order of the scene.</summary>
    public BodyReference this[int part] => Simulation.Bodies[parts[part]];

    public Vector3 Position(int part) => this[part].Pose.Position;

    public void Step(float dt) => Simulation.Timestep(dt, dispatcher);

    public void Dispose()
    {
        Simulation.Dispose();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
