using System;
using System.Collections.Generic;
using System.Linq;
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
        float friction = Friction, float maximumRecoveryVelocity = 2)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Gravity = gravity ?? new Vector3(0, -9.81f, 0);
        var material = new DefaultNarrowPhaseCallbacks().Material;
        material.FrictionCoefficient = friction;
        material.MaximumRecoveryVelocity = maximumRecoveryVelocity;
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

    /// <summary>A wall of bricks of 1 by .5 by .5 m, each over the gap between two below, with halves at the ends of every other row.</summary>
    /// <param name="rows">Number of rows.</param>
    /// <param name="bricks">Number of whole bricks of a row.</param>
    /// <param name="velocity">Of all of it, m/s.</param>
    /// <param name="aside">How far each row is aside of the one below, across the wall, m.</param>
    public void AddWall(int rows, int bricks, Vector3 velocity = default, float aside = 0)
    {
        for (int row = 0; row < rows; ++row)
        {
            var odd = row % 2;
            for (int i = 0; i < bricks - odd; ++i)
                Add(new Vector3(i + odd * 0.5f, 0.25f + row * 0.5f, row * aside), new Vector3(1, 0.5f, 0.5f), 1, velocity);
            for (int end = 0; odd == 1 && end < 2; ++end)
                Add(new Vector3(end * (bricks - 0.5f) - 0.25f, 0.25f + row * 0.5f, row * aside), new Vector3(0.5f), 0.5f, velocity);
        }
    }

    /// <summary>Storeys of four posts of .2 by 1 by .2 m and a slab of 2 by .2 by 1 m and 5 kg.</summary>
    public void AddPosts(int storeys, Vector3 velocity)
    {
        for (int storey = 0; storey < storeys; ++storey)
        {
            for (int post = 0; post < 4; ++post)
                Add(new Vector3(post % 2 * 1.6f - 0.8f, 1.2f * storey + 0.5f, post / 2 * 0.8f - 0.4f), new Vector3(0.2f, 1, 0.2f), 1, velocity);
            Add(new Vector3(0, 1.2f * storey + 1.1f, 0), new Vector3(2, 0.2f, 1), 5, velocity);
        }
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

    /// <summary>How much lower any body is than where it was put, m.</summary>
    public double Lowered => boxes.Max(box => box.Start.Y - Simulation.Bodies[box.Body].Pose.Position.Y);

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
