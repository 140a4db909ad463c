using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.LoadPath;

/// <summary>What stands on a platform that a game moves and turns by its velocity, at the default setting; its top is at y = 0 to begin with.</summary>
sealed class TurningWorld : IDisposable
{
    public const float Dt = 1 / 60f;
    public const float Gravity = 9.81f;
    public const float Friction = 0.5f;

    static readonly Vector3 start = new(0, -0.5f, 0);
    readonly BufferPool pool = new();
    readonly IThreadDispatcher? dispatcher;
    readonly List<(BodyHandle Body, Vector3 Start)> boxes = [];
    readonly Func<double, BodyVelocity> velocity;

    // The velocity is that of the platform by time, s.
    public TurningWorld(Func<double, BodyVelocity> velocity, int threads = 1)
    {
        this.velocity = velocity;
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var material = new DefaultNarrowPhaseCallbacks().Material;
        material.FrictionCoefficient = Friction;
        Simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(material), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)), SolveDescription.Default);
        Platform = Simulation.Bodies.Add(
            BodyDescription.CreateKinematic(start, velocity(0), Simulation.Shapes.Add(new Box(40, 1, 40)), -1));
    }

    public Simulation Simulation { get; }

    public BodyHandle Platform { get; }

    public int Steps { get; private set; }

    /// <summary>Time at which the next step begins, s.</summary>
    public double Time => Steps * (double)Dt;

    public int Count => boxes.Count;

    /// <summary>Adds a box that moves along with the platform.</summary>
    public void Add(Vector3 position, Vector3 size, float mass = 1)
    {
        var box = new Box(size.X, size.Y, size.Z);
        var own = velocity(0);
        own.Linear += Vector3.Cross(own.Angular, position - start);
        boxes.Add((Simulation.Bodies.Add(BodyDescription.CreateDynamic(position, own, box.ComputeInertia(mass), Simulation.Shapes.Add(box), -1)), position));
    }

    /// <summary>Adds a structure by its name, at a distance from the middle of the platform.</summary>
    public TurningWorld With(string structure, float away)
    {
        switch (structure)
        {
            case "one":
                AddStack(1, away);
                break;
            case "three":
                AddStack(3, away);
                break;
            case "ten":
                AddStack(10, away);
                break;
            case "twenty":
                AddStack(20, away);
                break;
            case "heavy":
                AddStack(1, away);
                Add(new Vector3(0, 1.5f, away), Vector3.One, 100);
                break;
            case "bricks":
                AddWall(5, away);
                break;
            case "wall":
                AddWall(12, away);
                break;
        }
        return this;
    }

    void AddStack(int count, float away)
    {
        for (int i = 0; i < count; ++i)
            Add(new Vector3(0, 0.5f + i, away), Vector3.One);
    }

    // Rows of six bricks of a metre, a bit apart, with halves at the ends of every other one.
    void AddWall(int rows, float away)
    {
        const float wide = 1.05f;
        for (int row = 0; row < rows; ++row)
        {
            var y = 0.25f + row * 0.5f;
            var odd = row % 2;
            for (int i = 0; i < 6 - odd; ++i)
                Add(new Vector3((i - 2.5f + odd * 0.5f) * wide, y, away), new Vector3(1, 0.5f, 0.5f));
            for (int side = -1; odd == 1 && side <= 1; side += 2)
                Add(new Vector3(2.75f * wide * side, y, away), new Vector3(0.5f), 0.5f);
        }
    }

    public void Step()
    {
        Simulation.Bodies[Platform].Velocity = velocity(Time);
        Simulation.Timestep(Dt, dispatcher);
        ++Steps;
    }

    /// <summary>Runs on.</summary>
    /// <returns>How far any box ever was from its place on the platform, m, and by how much one was lower.</returns>
    public (double Moved, double Lost) Run(double seconds)
    {
        double moved = 0, lost = 0;
        for (var end = Steps + (int)Math.Round(seconds / Dt); Steps < end;)
        {
            Step();
            for (int i = 0; i < boxes.Count; ++i)
            {
                moved = Math.Max(moved, (Place(i) - boxes[i].Start).Length());
                lost = Math.Max(lost, boxes[i].Start.Y - Place(i).Y);
            }
        }
        return (moved, lost);
    }

    /// <summary>Goes back to a state that was saved after so many steps.</summary>
    public void Restore(SimulationSnapshot snapshot, int steps)
    {
        Simulation.Restore(snapshot);
        Steps = steps;
    }

    /// <summary>Where a box is, to who moves along with the platform.</summary>
    public Vector3 Place(int box)
    {
        ref var platform = ref Simulation.Bodies[Platform].Pose;
        return Vector3.Transform(Simulation.Bodies[boxes[box].Body].Pose.Position - platform.Position, Quaternion.Conjugate(platform.Orientation)) + start;
    }

    public void Dispose()
    {
        Simulation.Dispose();
        (dispatcher as IDisposable)?.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
