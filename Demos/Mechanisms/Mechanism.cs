using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace Demos.Mechanisms;

/// <summary>A machine of joints in a world of its own, driven step by step, and what must be true of it.</summary>
abstract class Mechanism : IDisposable
{
    readonly JointGaps pins;
    double startEnergy;

    protected Mechanism(AccuracySettings settings)
    {
        World = new AccuracyWorld(settings);
        pins = new JointGaps(World);
    }

    /// <summary>Steps of a run.</summary>
    public abstract int StepCount { get; }

    /// <summary>Steps that the machine takes to run evenly, after being switched on from rest; what holds it together is not watched in them.</summary>
    public virtual int StartingSteps => 0;

    /// <summary>What must be true after a run.</summary>
    public abstract IEnumerable<Finding> Findings { get; }

    protected AccuracyWorld World { get; }

    protected Solver Solver => World.Simulation.Solver;

    /// <summary>Greatest gap of a hinge so far, m.</summary>
    protected double WorstGap => pins.Worst;

    /// <summary>Greatest energy so far above that of the beginning, J.</summary>
    protected double EnergyGained { get; private set; }

    /// <summary>Greatest kinetic energy so far, J.</summary>
    protected double GreatestMotion { get; private set; }

    /// <summary>Takes all steps.</summary>
    public void Run()
    {
        startEnergy = Energy(out _);
        for (int i = 0; i < StepCount; ++i)
        {
            Drive(i);
            World.Step(World.Settings.Dt);
            if (i >= StartingSteps)
                pins.Observe();
            EnergyGained = Tally.Most(EnergyGained, Energy(out double kinetic) - startEnergy);
            GreatestMotion = Tally.Most(GreatestMotion, kinetic);
            Observe(i);
        }
    }

    /// <summary>Sets motors before a step.</summary>
    protected virtual void Drive(int step)
    {
    }

    /// <summary>Looks at the machine after a step.</summary>
    protected virtual void Observe(int step)
    {
    }

    /// <summary>Where a point of a body is.</summary>
    protected Double3 Point(BodyHandle body, Vector3 offset) => World.Point(body, offset);

    /// <summary>Adds a hinge about Z of both bodies, and watches its gap.</summary>
    protected void AddHinge(BodyHandle a, BodyHandle b, Vector3 offsetA, Vector3 offsetB)
    {
        Solver.Add(a, b, new Hinge { LocalOffsetA = offsetA, LocalHingeAxisA = Vector3.UnitZ, LocalOffsetB = offsetB, LocalHingeAxisB = Vector3.UnitZ });
        pins.Add(a, b, offsetA, offsetB);
    }

    /// <summary>Adds a bar in the plane of X and Y from one point to another, along its local X.</summary>
    protected BodyHandle AddBar(Vector2 from, Vector2 to, float mass, float width = .1f)
    {
        double angle = Math.Atan2(to.Y - from.Y, to.X - from.X);
        var orientation = new Quaternion(0, 0, (float)Math.Sin(angle / 2), (float)Math.Cos(angle / 2));
        return World.AddDynamic(new Box((to - from).Length(), width, width), mass, new RigidPose(new Vector3((from + to) / 2, 0), orientation));
    }

    double Energy(out double kinetic)
    {
        double total = 0;
        kinetic = 0;
        foreach (BodyHandle body in World.Dynamics)
        {
            BodyInertia inertia = World.Bodies[body].LocalInertia;
            double mass = 1.0 / inertia.InverseMass;
            var tensor = inertia.InverseInertiaTensor;
            double energy = World.Energy(body, mass, new Double3(1.0 / tensor.XX, 1.0 / tensor.YY, 1.0 / tensor.ZZ));
            total += energy;
            kinetic += energy + mass * Double3.Dot(World.Settings.Gravity, World.Position(body));
        }
        return total;
    }

    public void Dispose() => World.Dispose();
}
