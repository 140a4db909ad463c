using System;
using System.Linq;
using System.Numerics;
using System.Reflection;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace Demos.Pages;

/// <summary>Boxes without gravity and the example of a joint between them.</summary>
sealed class JointStage : IDisposable
{
    /// <summary>Where the bodies stand, m; unturned.</summary>
    public static readonly Vector3[] Places = [new(0, 0, 0), new(1.5f, 0, 0), new(0.75f, 1.5f, 0), new(0.75f, 0.4f, -1.5f)];
    /// <summary>Edges of the boxes, m.</summary>
    public static readonly Vector3 Size = new(0.8f, 0.4f, 0.4f);

    readonly BufferPool pool = new();

    /// <summary>Places the bodies and adds the joint.</summary>
    /// <param name="facts">Type of the joint.</param>
    /// <param name="onlyMoving">The body that can move, while the others are kinematic; below zero where all can.</param>
    public JointStage(JointFacts facts, int onlyMoving = -1)
    {
        Simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 4));
        var box = new Box(Size.X, Size.Y, Size.Z);
        var shape = Simulation.Shapes.Add(box);
        Bodies = [.. Places.Take(facts.BodyCount).Select((place, i) => Simulation.Bodies.Add(onlyMoving >= 0 && i != onlyMoving
            ? BodyDescription.CreateKinematic(place, shape, -1)
            : BodyDescription.CreateDynamic(place, box.ComputeInertia(1), shape, -1)))];
        Joint = (ConstraintHandle)ExampleOf(facts).Invoke(null, [Simulation, .. Bodies.Cast<object>()])!;
    }

    public Simulation Simulation { get; }

    /// <summary>The bodies in the order of the joint.</summary>
    public BodyHandle[] Bodies { get; }

    public ConstraintHandle Joint { get; }

    static MethodInfo ExampleOf(JointFacts facts) => typeof(JointExamples).GetMethod(facts.Name)
        ?? throw new InvalidOperationException($"{facts.Name} has no example in {nameof(JointExamples)}: write one, its page and its picture need it.");

    /// <summary>What the example says of the joint, as the solver has it.</summary>
    public object Describe(JointFacts facts)
    {
        object?[] arguments = [Joint, null];
        typeof(Solver).GetMethod(nameof(Solver.GetDescription))!.MakeGenericMethod(facts.Description).Invoke(Simulation.Solver, arguments);
        return arguments[1]!;
    }

    public void Dispose()
    {
        Simulation.Dispose();
        pool.Dispose();
    }
}
