using System;
using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.Engine;
using Demos.References;
using Demos.Running;
using Demos.Scenes;

namespace DemoTests.Scenes;

/// <summary>A scene of the runner on one thread, whose bodies and contacts can be looked at.</summary>
sealed class ShapeProbe : IDisposable
{
    readonly BufferPool pool = new();
    readonly DepthLog log = new();

    public ShapeProbe(SceneDescription scene, int substeps = 4)
    {
        Simulation = Simulation.Create(
            pool, new LoggingCallbacks(log, new PairMaterialProperties(scene.Friction, EngineDefaults.MaximumRecoveryVelocity, EngineDefaults.ContactSpring)),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, scene.Damping), new SolveDescription(1, substeps));
        SceneBuilder.Build(scene, Simulation, EngineDefaults.JointSpring, new ContactRecorder(1));
    }

    public Simulation Simulation { get; }

    /// <summary>Handles are given out in the order of the scene.</summary>
    public int BodyCount => Simulation.Bodies.ActiveSet.Count;

    public Double3 Position(int body) => Simulation.Bodies[new BodyHandle(body)].Pose.Position;

    public DoubleQuaternion Orientation(int body) => Simulation.Bodies[new BodyHandle(body)].Pose.Orientation;

    public double Speed(int body) => ((Double3)Simulation.Bodies[new BodyHandle(body)].Velocity.Linear).Length;

    public void Step(int count)
    {
        for (int i = 0; i < count; ++i)
            Simulation.Timestep(1 / 60f);
    }

    /// <summary>Depths of all contacts that overlap, from the least; takes one more step, because contacts are found at its start.</summary>
    public List<float> TakeDepths()
    {
        log.Depths.Clear();
        log.IsOn = true;
        Step(1);
        log.IsOn = false;
        log.Depths.Sort();
        return log.Depths;
    }

    /// <summary>Greatest and root mean square speed of all bodies.</summary>
    public (double Greatest, double MeanSquare) Speeds()
    {
        double greatest = 0, sum = 0;
        for (int i = 0; i < BodyCount; ++i)
        {
            double speed = Speed(i);
            greatest = Tally.Most(greatest, speed);
            sum += speed * speed;
        }
        return (greatest, Math.Sqrt(sum / BodyCount));
    }

    public void Dispose()
    {
        Simulation.DisposeHulls();
        Simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    sealed class DepthLog
    {
        public List<float> Depths { get; } = [];

        public bool IsOn { get; set; }
    }

    struct LoggingCallbacks(DepthLog log, PairMaterialProperties material) : INarrowPhaseCallbacks
    {
        public readonly void Initialize(Simulation simulation)
        {
        }

        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
            a.Mobility == CollidableMobility.Dynamic || b.Mobility == CollidableMobility.Dynamic;

        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial = material;
            for (int i = 0; log.IsOn && i < manifold.Count; ++i)
            {
                if (manifold.GetDepth(i) > 0)
                    log.Depths.Add(manifold.GetDepth(i));
            }
            return true;
        }

        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public readonly void Dispose()
        {
        }
    }
}
