using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.LoadPath;

/// <summary>What stands on a platform that a game moves by its velocity, at the default setting; the top of the platform is at y = 0 to begin with.</summary>
sealed class LiftWorld : IDisposable
{
    public const float Dt = 1 / 60f;
    public const float Gravity = 9.81f;
    public const float Friction = 0.5f;

    static readonly Vector3 start = new(0, -0.5f, 0);
    readonly BufferPool pool = new();
    readonly IThreadDispatcher? dispatcher;
    readonly List<(BodyHandle Body, Vector3 Start)> boxes = [];
    readonly Func<double, Vector3> velocity;

    // The velocity is that of the platform by time, s.
    public LiftWorld(Func<double, Vector3> velocity, SolveDescription? solve = null, int threads = 1)
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

    public BodyHandle AddPlatform(Vector3 position, Vector3 size, Vector3 velocity) => Simulation.Bodies.Add(BodyDescription.CreateKinematic(
        position, new BodyVelocity(velocity), Simulation.Shapes.Add(new Box(size.X, size.Y, size.Z)), -1));

    /// <summary>Adds a box that moves along with the platform.</summary>
    public BodyHandle Add(Vector3 position, Vector3 size, float mass = 1)
    {
        var box = new Box(size.X, size.Y, size.Z);
        var body = Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            position, new BodyVelocity(velocity(0)), box.ComputeInertia(mass), Simulation.Shapes.Add(box), -1));
        boxes.Add((body, position));
        return body;
    }

    /// <summary>Unit boxes on one another, each aside of the one below.</summary>
    public void AddStack(int count, float aside = 0)
    {
        for (int i = 0; i < count; ++i)
            Add(new Vector3(i * aside, 0.5f + i, 0), Vector3.One);
    }

    /// <summary>Adds a structure by its name, at rest to the platform.</summary>
    public LiftWorld With(string structure)
    {
        switch (structure)
        {
            case "twenty":
                AddStack(20);
                break;
            case "fifty":
                AddStack(50);
                break;
            case "heavy":
                AddStack(1);
                Add(new Vector3(0, 1.5f, 0), Vector3.One, 100);
                break;
            case "wall":
                AddWall();
                break;
        }
        return this;
    }

    // Twelve rows of ten bricks of a metre, with halves at the ends of every other one.
    void AddWall()
    {
        for (int row = 0; row < 12; ++row)
        {
            var y = 0.25f + row * 0.5f;
            var odd = row % 2;
            for (int i = 0; i < 10 - odd; ++i)
                Add(new Vector3(i - 4.5f + odd * 0.5f, y, 0), new Vector3(1, 0.5f, 0.5f));
            for (int side = -1; odd == 1 && side <= 1; side += 2)
                Add(new Vector3(4.75f * side, y, 0), new Vector3(0.5f), 0.5f);
        }
    }

    public void Step()
    {
        Simulation.Bodies[Platform].Velocity.Linear = velocity(Time);
        Simulation.Timestep(Dt, dispatcher);
        ++Steps;
    }

    /// <summary>Runs on.</summary>
    /// <returns>How far any box ever was from its place on the platform, m.</returns>
    public double Run(double seconds)
    {
        double most = 0;
        for (var end = Steps + (int)Math.Round(seconds / Dt); Steps < end;)
        {
            Step();
            most = Math.Max(most, Moved);
        }
        return most;
    }

    /// <summary>Goes back to a state that was saved after so many steps.</summary>
    public void Restore(SimulationSnapshot snapshot, int steps)
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

    /// <summary>Where a box is, relative to the platform.</summary>
    public Vector3 Place(int box) => Simulation.Bodies[boxes[box].Body].Pose.Position - Simulation.Bodies[Platform].Pose.Position + start;

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
