using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace Demos.Governing;

/// <summary>What is loaded and unloaded in turns.</summary>
enum AlternatingKind
{
    /// <summary>Hanging chains of eight links of 1 kg.</summary>
    Chain,
    /// <summary>Stacks of four boxes of 1 kg, by sweeps alone: with the load path they need no more substeps under a load.</summary>
    Stack,
}

/// <summary>Chains or stacks side by side that bear twenty times the mass of a part for five seconds, and nothing for five.</summary>
sealed class AlternatingWorld : IDisposable
{
    const float Dt = 1 / 60f;
    const int Links = 8, Boxes = 4, Phases = 4, StepsBefore = 120, StepsPerPhase = 300;
    // Of each phase: a load that comes at once sinks in before the count has grown.
    const int StepsUnjudged = 60;
    const float Load = 20;
    const float Apart = 4;
    const float Above = 50;

    static readonly Box link = new(.1f, .4f, .1f);
    static readonly Box box = new(1, 1, 1);

    readonly AlternatingKind kind;
    readonly BufferPool pool = new();
    readonly Simulation simulation;
    readonly List<BodyHandle> lasts = [];
    readonly List<BodyHandle> loads = [];

    public AlternatingWorld(AlternatingKind kind, int copies, int substeps, SubstepGovernor? governor)
    {
        this.kind = kind;
        simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -9.81f, 0)),
            new SolveDescription(1, substeps) { Governor = governor, LoadPath = kind == AlternatingKind.Stack ? LoadPathMode.Off : LoadPathMode.WhereNeeded });
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -5, 0), simulation.Shapes.Add(new Box(Apart * (copies + 100), 10, 400))));
        for (int i = 0; i < copies; ++i)
            lasts.Add(kind == AlternatingKind.Chain ? AddChain(i * Apart) : AddStack(i * Apart));
    }

    /// <summary>Greatest error from a second after each change on, m; only of a world with a governor.</summary>
    public float Error { get; private set; }

    /// <summary>Mean number of substeps of a step.</summary>
    public double Substeps { get; private set; }

    /// <summary>Mean time of a step on the processor, ms.</summary>
    public double Milliseconds { get; private set; }

    /// <summary>Puts loads on and takes them off.</summary>
    public void Run()
    {
        for (int i = 0; i < StepsBefore; ++i)
            simulation.Timestep(Dt);
        // Of the processor: others may want it, too.
        TimeSpan before = Environment.CpuUsage.TotalTime;
        long substeps = 0;
        for (int phase = 0; phase < Phases; ++phase)
        {
            ChangeLoads(phase % 2 == 0);
            for (int i = 0; i < StepsPerPhase; ++i)
            {
                simulation.Timestep(Dt);
                substeps += simulation.Solver.LastSubstepCount;
                if (i >= StepsUnjudged)
                    Error = float.Max(Error, simulation.Solver.LastConstraintError);
            }
        }
        Substeps = (double)substeps / (Phases * StepsPerPhase);
        Milliseconds = (Environment.CpuUsage.TotalTime - before).TotalMilliseconds / (Phases * StepsPerPhase);
    }

    void ChangeLoads(bool on)
    {
        foreach (BodyHandle load in loads)
            simulation.Bodies.Remove(load);
        loads.Clear();
        foreach (BodyHandle last in lasts)
        {
            if (!on)
                break;
            Vector3 place = simulation.Bodies[last].Pose.Position;
            BodyHandle load = Add(box, place + (kind == AlternatingKind.Chain ? new Vector3(0, -.75f, 0) : Vector3.UnitY), Load);
            if (kind == AlternatingKind.Chain)
                simulation.Solver.Add(last, load, new BallSocket { LocalOffsetA = new Vector3(0, -.25f, 0), LocalOffsetB = new Vector3(0, .5f, 0) });
            loads.Add(load);
        }
    }

    BodyHandle AddChain(float x)
    {
        BodyHandle above = simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(x, Above, 0), simulation.Shapes.Add(link), -1));
        for (int i = 1; i <= Links; ++i)
        {
            BodyHandle next = Add(link, new Vector3(x, Above - i * .5f, 0), 1);
            simulation.Solver.Add(above, next, new BallSocket { LocalOffsetA = new Vector3(0, -.25f, 0), LocalOffsetB = new Vector3(0, .25f, 0) });
            above = next;
        }
        return above;
    }

    BodyHandle AddStack(float x)
    {
        BodyHandle last = default;
        for (int i = 0; i < Boxes; ++i)
            last = Add(box, new Vector3(x, i + .5f, 0), 1);
        return last;
    }

    BodyHandle Add(Box shape, Vector3 position, float mass) =>
        simulation.Bodies.Add(BodyDescription.CreateDynamic(position, shape.ComputeInertia(mass), simulation.Shapes.Add(shape), -1));

    public void Dispose()
    {
        simulation.Dispose();
        pool.Clear();
    }
}
