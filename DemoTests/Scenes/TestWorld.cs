using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Accuracy;

namespace DemoTests.Scenes;

/// <summary>A simulation with a pool and, for more than one thread, a dispatcher of its own; all pools must be empty at its end.</summary>
sealed class TestWorld : IDisposable
{
    public const float Dt = 1 / 60f;

    public TestWorld(AccuracySettings? settings = null, int threads = 1, SimulationAllocationSizes? sizes = null,
        Shapes? shapes = null, ITimestepper? timestepper = null, PairMaterialProperties? material = null, float restitution = 0,
        int fallbackBatchThreshold = SolveDescription.DefaultFallbackBatchThreshold)
    {
        settings ??= new AccuracySettings();
        Dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = Simulation.Create(
            Pool,
            new WorldContacts(
                material ?? new PairMaterialProperties(settings.Friction, settings.MaximumRecoveryVelocity, default), settings.Contacts, restitution),
            new WorldGravity(settings), EngineTraits.Solve(settings) with { FallbackBatchThreshold = fallbackBatchThreshold }, timestepper, sizes, shapes);
    }

    public BufferPool Pool { get; } = new();

    public ThreadDispatcher? Dispatcher { get; }

    public Simulation Simulation { get; }

    public Bodies Bodies => Simulation.Bodies;

    public Statics Statics => Simulation.Statics;

    public Solver Solver => Simulation.Solver;

    public BodyHandle AddDynamic<TShape>(in TShape shape, float mass, RigidPose pose, BodyVelocity velocity = default)
        where TShape : unmanaged, IConvexShape =>
        Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(mass), Simulation.Shapes.Add(shape), new BodyActivityDescription(-1)));

    /// <summary>Adds a body that is marked as continuous, and never sleeps by itself.</summary>
    public BodyHandle AddMarked<TShape>(in TShape shape, float mass, RigidPose pose, BodyVelocity velocity) where TShape : unmanaged, IConvexShape =>
        Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(mass),
            new CollidableDescription(Simulation.Shapes.Add(shape), ContinuousDetection.Continuous()), new BodyActivityDescription(-1)));

    public BodyHandle AddKinematic<TShape>(in TShape shape, RigidPose pose) where TShape : unmanaged, IConvexShape =>
        Bodies.Add(BodyDescription.CreateKinematic(pose, Simulation.Shapes.Add(shape), new BodyActivityDescription(-1)));

    public StaticHandle AddStatic<TShape>(in TShape shape, RigidPose pose) where TShape : unmanaged, IConvexShape =>
        Statics.Add(new StaticDescription(pose, Simulation.Shapes.Add(shape)));

    public void Step(float dt = Dt) => Simulation.Timestep(dt, Dispatcher);

    public void Step(int count)
    {
        for (int i = 0; i < count; ++i)
            Step();
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

    public static Vector3 Scatter(Random random, float extent) =>
        new((random.NextSingle() - .5f) * extent, (random.NextSingle() - .5f) * extent, (random.NextSingle() - .5f) * extent);

    public static Quaternion Turn(Random random)
    {
        var q = new Quaternion(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f);
        return q.Length() < .01f ? Quaternion.Identity : Quaternion.Normalize(q);
    }

    public void Dispose()
    {
        Simulation.Dispose();
        Pool.AssertEmpty();
        Dispatcher?.WorkerPools.AssertEmpty();
        Dispatcher?.Dispose();
        Pool.Clear();
    }
}
