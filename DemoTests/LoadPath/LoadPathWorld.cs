using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.LoadPath;

/// <summary>A floor at y = 0 with boxes on it, as a game makes it: ready-made callbacks, four substeps, steps of a sixtieth of a second.</summary>
sealed class LoadPathWorld : IDisposable
{
    public const float Dt = 1 / 60f;
    public const float Friction = 0.5f;

    readonly BufferPool pool = new();
    readonly IThreadDispatcher? dispatcher;
    readonly List<(BodyHandle Body, Vector3 Start)> boxes = [];

    public LoadPathWorld(LoadPathMode mode, Vector3? gravity = null, int substeps = 4, int relaxations = 0, int threads = 1, float frequency = 0,
        float friction = Friction)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Gravity = gravity ?? new Vector3(0, -9.81f, 0);
        var material = new DefaultNarrowPhaseCallbacks().Material;
        material.FrictionCoefficient = friction;
        if (frequency > 0)
            material.SpringSettings = new(frequency, 1);
        Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(material), new DefaultPoseIntegratorCallbacks(Gravity),
            new SolveDescription(1, substeps) { RelaxationIterationCount = relaxations, LoadPath = mode });
        Simulation.Statics.Add(new StaticDescription(new Vector3(0, -5, 0), Simulation.Shapes.Add(new Box(400, 10, 400))));
    }

    public Simulation Simulation { get; }

    public Vector3 Gravity { get; }

    public BodyHandle Add(Vector3 position, Vector3 size, float mass, Vector3 velocity = default) =>
        Add(position, new Box(size.X, size.Y, size.Z), mass, velocity);

    public BodyHandle Add<TShape>(Vector3 position, in TShape shape, float mass, Vector3 velocity = default, Vector3 spin = default)
        where TShape : unmanaged, IConvexShape
    {
        var body = Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            position, new BodyVelocity(velocity, spin), shape.ComputeInertia(mass), Simulation.Shapes.Add(shape), -1));
        boxes.Add((body, position));
        return body;
    }

    /// <summary>Unit boxes on one another, each aside of the one below.</summary>
    public void AddStack(int count, float aside = 0)
    {
        for (int i = 0; i < count; ++i)
            Add(new Vector3(i * aside, 0.5f + i, 0), Vector3.One, 1);
    }

    public void Step() => Simulation.Timestep(Dt, dispatcher);

    public void Run(float seconds)
    {
        for (int i = 0; i < (int)MathF.Round(seconds / Dt); ++i)
            Step();
    }

    /// <summary>How far any body is from where it was put, m.</summary>
    public double Moved
    {
        get
        {
            double most = 0;
            foreach (var (body, start) in boxes)
                most = Math.Max(most, (Simulation.Bodies[body].Pose.Position - start).Length());
            return most;
        }
    }

    public Vector3 Position(BodyHandle body) => Simulation.Bodies[body].Pose.Position;

    public Vector3 Velocity(BodyHandle body) => Simulation.Bodies[body].Velocity.Linear;

    public void Dispose()
    {
        Simulation.Dispose();
        (dispatcher as IDisposable)?.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
