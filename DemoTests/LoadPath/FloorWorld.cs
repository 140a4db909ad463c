using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What stands on a platform that a game moves and turns by its velocity, at the default setting; its top is at y = 0 to begin with.</summary>
sealed class FloorWorld : IDisposable
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
    public FloorWorld(Func<double, Vector3> velocity, SolveDescription? solve = null, int threads = 1)
        : this(time => new BodyVelocity(velocity(time)), solve, threads)
    {
    }

    public FloorWorld(Func<double, BodyVelocity> velocity, SolveDescription? solve = null, int threads = 1)
    {
        this.velocity = velocity;
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var material = new DefaultNarrowPhaseCallbacks().Material;
        material.FrictionCoefficient = Friction;
        Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(material), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)),
            solve ?? SolveDescription.Default);
        Platform = AddPlatform(start, new Vector3(40, 1, 40), velocity(0));
    }

    public Simulation Simulation { get; }

    public BodyHandle Platform { get; }

    public int Steps { get; private set; }

    /// <summary>Time at which the next step begins, s.</summary>
    public double Time => Steps / 60.0;

    public BodyHandle AddPlatform(Vector3 position, Vector3 size, BodyVelocity velocity) =>
        Simulation.Bodies.Add(BodyDescription.CreateKinematic(position, velocity, Simulation.Shapes.Add(new Box(size.X, size.Y, size.Z)), -1));

    /// <summary>Adds a box that moves along with the platform.</summary>
    public BodyHandle Add(Vector3 position, Vector3 size, float mass = 1)
    {
        var box = new Box(size.X, size.Y, size.Z);
        var own = velocity(0);
        own.Linear += Vector3.Cross(own.Angular, position - start);
        var body = Simulation.Bodies.Add(BodyDescription.CreateDynamic(position, own, box.ComputeInertia(mass), Simulation.Shapes.Add(box), -1));
        boxes.Add((body, position));
        return body;
    }

    /// <summary>Unit boxes on one another, each aside of the one below.</summary>
    public void AddStack(int count, float aside = 0, float away = 0)
    {
        for (int i = 0; i < count; ++i)
            Add(new Vector3(i * aside, 0.5f + i, away), Vector3.One);
    }

    /// <summary>Adds a structure by its name, at rest to the platform and at a distance from its middle.</summary>
    public FloorWorld With(string structure, float away = 0)
    {
        switch (structure)
        {
            case "one":
                AddStack(1, away: away);
                break;
            case "three":
                AddStack(3, away: away);
                break;
            case "ten":
                AddStack(10, away: away);
                break;
            case "twenty":
                AddStack(20, away: away);
                break;
            case "fifty":
                AddStack(50, away: away);
                break;
            case "heavy":
                AddStack(1, away: away);
                Add(new Vector3(0, 1.5f, away), Vector3.One, 100);
                break;
            case "wall":
                AddWall(12, 10, 1, away);
                break;
            case "low wall with gaps":
                AddWall(5, 6, 1.05f, away);
                break;
            case "wall with gaps":
                AddWall(12, 6, 1.05f, away);
                break;
            default:
                throw new ArgumentException("There is no such structure.", nameof(structure));
        }
        return this;
    }

    // Bricks of a metre, one in so many metres, with halves at the ends of every other row.
    void AddWall(int rows, int bricks, float pitch, float away)
    {
        for (int row = 0; row < rows; ++row)
        {
            var y = 0.25f + row * 0.5f;
            var odd = row % 2;
            for (int i = 0; i < bricks - odd; ++i)
                Add(new Vector3((i - (bricks - 1) * 0.5f + odd * 0.5f) * pitch, y, away), new Vector3(1, 0.5f, 0.5f));
            for (int side = -1; odd == 1 && side <= 1; side += 2)
                Add(new Vector3((bricks * 0.5f - 0.25f) * pitch * side, y, away), new Vector3(0.5f), 0.5f);
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
            moved = Math.Max(moved, Moved);
            for (int i = 0; i < boxes.Count; ++i)
                lost = Math.Max(lost, boxes[i].Start.Y - Place(i).Y);
        }
        return (moved, lost);
    }

    // Goes back to a state that was saved after so many steps.
    void Restore(SimulationSnapshot snapshot, int steps)
    {
        Simulation.Restore(snapshot);
        Steps = steps;
    }

    /// <summary>How far any box is from its place on the platform, m.</summary>
    public double Moved
    {
        get
        {
            double most = 0;
            for (int i = 0; i < boxes.Count; ++i)
                most = Math.Max(most, (Place(i) - boxes[i].Start).Length());
            return most;
        }
    }

    public int Count => boxes.Count;

    /// <summary>Where a box is, to who moves along with the platform.</summary>
    public Vector3 Place(int box)
    {
        ref var platform = ref Simulation.Bodies[Platform].Pose;
        return Vector3.Transform(Simulation.Bodies[boxes[box].Body].Pose.Position - platform.Position, Quaternion.Conjugate(platform.Orientation)) + start;
    }

    /// <summary>How fast a box is, relative to the platform.</summary>
    public Vector3 Speed(int box) => Simulation.Bodies[boxes[box].Body].Velocity.Linear - Simulation.Bodies[Platform].Velocity.Linear;

    /// <summary>What the platform bears in the last substep of a step, of the one stack that is on it, N.</summary>
    public double Load
    {
        get
        {
            var sum = default(SumOfNormals);
            foreach (var constraint in Simulation.Bodies[Platform].Constraints)
                Simulation.Solver.EnumerateAccumulatedImpulses(constraint.ConnectingConstraintHandle, ref sum);
            return sum.Normals * Simulation.Solver.LastSubstepCount / Dt;
        }
    }

    /// <summary>That threads, and going back to a snapshot of the middle, change no bit of a run.</summary>
    public static void AssertIsRepeatable(Func<int, FloorWorld> create, double seconds)
    {
        using var one = create(1);
        one.Run(seconds / 2);
        using var snapshotPool = new BufferPool();
        using var snapshot = new SimulationSnapshot(snapshotPool);
        one.Simulation.Save(snapshot);
        var steps = one.Steps;
        one.Run(seconds / 2);
        var expected = one.Simulation.StateHash();
        one.Restore(snapshot, steps);
        one.Run(seconds / 2);
        Assert.Equal(expected, one.Simulation.StateHash());
        foreach (var threads in new[] { 2, 3 })
        {
            using var many = create(threads);
            many.Run(seconds);
            Assert.Equal(expected, many.Simulation.StateHash());
        }
    }

    // The first four of a box's impulses.
    struct SumOfNormals : IForEach<float>
    {
        public double Normals;
        int count;

        public void LoopBody(float impulse) => Normals += count++ < 4 ? impulse : 0;
    }

    public void Dispose()
    {
        Simulation.Dispose();
        (dispatcher as IDisposable)?.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
