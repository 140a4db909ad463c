using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace DemoTests.Governor;

/// <summary>A stack of boxes and a hanging chain, on and to which a load is put and from which it is taken again.</summary>
sealed class GovernorWorld : IDisposable
{
    public const float Dt = 1 / 60f;

    readonly BufferPool pool = new();
    readonly ThreadDispatcher? dispatcher;
    readonly List<BodyHandle> boxes = [];
    BodyHandle? load;

    // By sweeps alone unless said otherwise: with the load path contacts at rest have no error that substeps could lessen.
    public GovernorWorld(SubstepGovernor? governor, int substeps = 4, int threads = 1, SpringSettings springs = default,
        LoadPathMode loadPath = LoadPathMode.Off)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var material = new DefaultNarrowPhaseCallbacks().Material;
        material.SpringSettings = springs;
        Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(material),
            new DefaultPoseIntegratorCallbacks(new Vector3(0, -9.81f, 0)), new SolveDescription(1, substeps) { Governor = governor, LoadPath = loadPath });
        Simulation.Statics.Add(new StaticDescription(new Vector3(0, -5, 0), Simulation.Shapes.Add(new Box(400, 10, 400))));
    }

    public Simulation Simulation { get; }

    public Solver Solver => Simulation.Solver;

    /// <summary>Substeps of all steps.</summary>
    public long Cost { get; private set; }

    /// <summary>Unit boxes of 1 kg on one another.</summary>
    public void AddStack(int count, float x = 0)
    {
        for (int i = 0; i < count; ++i)
            boxes.Add(AddBox(new Vector3(x, 0.5f + i, 0), 1));
    }

    /// <summary>Links of 1 kg that hang on a point, side by side, each half a metre long.</summary>
    public void AddChain(int count, SpringSettings springs = default)
    {
        var shape = Simulation.Shapes.Add(new Box(0.1f, 0.4f, 0.1f));
        var above = Simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(0, 50, 0), shape, -1));
        for (int i = 0; i < count; ++i)
        {
            var link = Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new Vector3(0, 49.5f - i * 0.5f, 0), new Box(0.1f, 0.4f, 0.1f).ComputeInertia(1), shape, -1));
            Simulation.Solver.Add(above, link, new BallSocket
            {
                LocalOffsetA = new Vector3(0, -0.25f, 0),
                LocalOffsetB = new Vector3(0, 0.25f, 0),
                SpringSettings = springs,
            });
            above = link;
            boxes.Add(link);
        }
    }

    /// <summary>Puts a load on the top of the stack, without any speed.</summary>
    public void PutLoad(float mass)
    {
        var top = Simulation.Bodies[boxes[^1]].Pose.Position;
        load = AddBox(top + Vector3.UnitY, mass);
    }

    /// <summary>Hangs a load on the last link.</summary>
    public void HangLoad(float mass)
    {
        var last = Simulation.Bodies[boxes[^1]].Pose.Position;
        load = AddBox(last - new Vector3(0, 0.75f, 0), mass);
        Simulation.Solver.Add(boxes[^1], load.Value, new BallSocket { LocalOffsetA = new Vector3(0, -0.25f, 0), LocalOffsetB = new Vector3(0, 0.5f, 0) });
    }

    public void TakeLoad() => Simulation.Bodies.Remove(load!.Value);

    public void Step(float dt = Dt)
    {
        Simulation.Timestep(dt, dispatcher);
        Cost += Solver.LastSubstepCount;
    }

    /// <summary>Greatest speed of a body, m/s: in a direction, and across the vertical.</summary>
    public (float Up, float Aside) GreatestSpeeds()
    {
        (float Up, float Aside) most = default;
        foreach (var box in boxes)
        {
            var velocity = Simulation.Bodies[box].Velocity.Linear;
            most = (MathF.Max(most.Up, velocity.Y), MathF.Max(most.Aside, new Vector2(velocity.X, velocity.Z).Length()));
        }
        return most;
    }

    public float Height => Simulation.Bodies[boxes[^1]].Pose.Position.Y;

    /// <summary>How far a box of the stack is from the axis, m.</summary>
    public float Drift
    {
        get
        {
            var most = 0f;
            foreach (var box in boxes)
            {
                var position = Simulation.Bodies[box].Pose.Position;
                most = MathF.Max(most, new Vector2(position.X, position.Z).Length());
            }
            return most;
        }
    }

    /// <summary>Greatest distance between the points that a joint holds together, m; for a world with nothing but a chain and its load.</summary>
    public float GreatestGap()
    {
        var above = new Vector3(0, 49.75f, 0);
        var most = 0f;
        foreach (var link in boxes)
        {
            var pose = Simulation.Bodies[link].Pose;
            most = MathF.Max(most, (pose.Position + Vector3.Transform(new Vector3(0, 0.25f, 0), pose.Orientation) - above).Length());
            above = pose.Position + Vector3.Transform(new Vector3(0, -0.25f, 0), pose.Orientation);
        }
        var hung = Simulation.Bodies[load!.Value].Pose;
        return MathF.Max(most, (hung.Position + Vector3.Transform(new Vector3(0, 0.5f, 0), hung.Orientation) - above).Length());
    }

    /// <summary>All bodies, bit for bit.</summary>
    public ulong Hash()
    {
        var hash = new StateHash();
        foreach (var box in boxes)
        {
            hash.Add(Simulation.Bodies[box].Pose.Position);
            hash.Add(Simulation.Bodies[box].Pose.Orientation);
            hash.Add(Simulation.Bodies[box].Velocity.Linear);
            hash.Add(Simulation.Bodies[box].Velocity.Angular);
        }
        return hash.Value;
    }

    BodyHandle AddBox(Vector3 position, float mass)
    {
        var box = new Box(1, 1, 1);
        return Simulation.Bodies.Add(BodyDescription.CreateDynamic(position, box.ComputeInertia(mass), Simulation.Shapes.Add(box), -1));
    }

    public void Dispose()
    {
        Simulation.Dispose();
        dispatcher?.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
