using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>Short stacks of boxes, each with a ball that is joined to it, all out of reach of each other; to a box of one a mishap happens.</summary>
sealed class MishapWorld : IDisposable
{
    const int Side = 12;
    const int CulpritStack = 77;
    readonly Mishap mishap;
    readonly ThreadDispatcher? dispatcher;
    readonly BufferPool pool = new();
    // Those that neither are the culprit nor touch it nor are joined to it.
    readonly List<BodyHandle> others = [];

    // No moment of a mishap.
    const MishapMoment Never = (MishapMoment)(-1);

    public MishapWorld(Mishap mishap, int threads, int relaxations = 0, float restitution = 0)
    {
        this.mishap = mishap;
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var timestepper = new DefaultTimestepper();
        timestepper.BeforeCollisionDetection += (_, _) => mishap.Pass(MishapMoment.BeforeCollisionDetection);
        timestepper.CollisionsDetected += (_, _) => mishap.Pass(MishapMoment.CollisionsDetected);
        timestepper.ConstraintsSolved += (_, _) => mishap.Pass(MishapMoment.StepEnds);
        Simulation = Simulation.Create(
            pool, new FaultyContacts(new Fault { Armed = true, Restitution = restitution }), new MishapGravity(mishap),
            new SolveDescription(1, Mishap.Substeps) { RelaxationIterationCount = relaxations }, timestepper);
        Simulation.Solver.SubstepStarted += substep =>
            mishap.Pass(substep == 0 ? MishapMoment.FirstSubstepStarts : substep == 2 ? MishapMoment.LaterSubstepStarts : Never);
        Simulation.Solver.SubstepEnded += substep =>
            mishap.Pass(substep == 1 ? MishapMoment.SubstepEnds : substep == Mishap.Substeps - 1 ? MishapMoment.LastSubstepEnds : Never);
        AddBodies();
    }

    public Simulation Simulation { get; }

    public BodyHandle Culprit { get; private set; }

    /// <summary>A box on the culprit, and a ball that is joined to it.</summary>
    public (BodyHandle Above, BodyHandle Joined) Neighbours { get; private set; }

    void AddBodies()
    {
        var box = new Box(1, 1, 1.2f);
        var shape = Simulation.Shapes.Add(box);
        var ball = new Sphere(.3f);
        var ballShape = Simulation.Shapes.Add(ball);
        Simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), Simulation.Shapes.Add(new Box(1000, 2, 1000))));
        for (int stack = 0; stack < Side * Side; ++stack)
        {
            var place = new Vector3(stack % Side * 5 - 30, 0, stack / Side * 5 - 30);
            var first = Add(place + new Vector3(0, .5f, 0), box.ComputeInertia(1 + stack % 3), shape);
            var above = Add(place + new Vector3(.1f, 1.52f, 0), box.ComputeInertia(1), shape);
            var joined = Add(place + new Vector3(1.2f, .8f, .1f), ball.ComputeInertia(.5f), ballShape);
            Simulation.Bodies[joined].Velocity.Linear = new Vector3(0, 1, .1f * stack);
            Simulation.Solver.Add(
                first, joined, new BallSocket { LocalOffsetA = new Vector3(.8f, .3f, .1f), LocalOffsetB = new Vector3(-.4f, 0, 0) });
            if (stack == CulpritStack)
                (Culprit, Neighbours) = (first, (above, joined));
            else
                others.AddRange([first, above, joined]);
        }
        mishap.Target = Simulation.Bodies[Culprit];
    }

    BodyHandle Add(Vector3 position, BodyInertia inertia, TypedIndex shape) =>
        Simulation.Bodies.Add(BodyDescription.CreateDynamic(position, inertia, shape, new BodyActivityDescription(-1)));

    public void Step()
    {
        mishap.Pass(MishapMoment.BetweenSteps);
        Simulation.Timestep(1 / 60f, dispatcher);
    }

    public void Step(int count)
    {
        for (int i = 0; i < count; ++i)
            Step();
    }

    /// <summary>Bits of the bodies that have nothing to do with the culprit.</summary>
    public byte[] OtherBits()
    {
        List<byte> bits = [];
        foreach (var handle in others)
            bits.AddRange(MemoryMarshal.AsBytes([Simulation.Bodies[handle].MotionState]));
        return [.. bits];
    }

    public void AssertSound()
    {
        Simulation.Validate();
        // Greater than anything here can be, and far from what float bears.
        foreach (var handle in (BodyHandle[])[.. others, Culprit, Neighbours.Above, Neighbours.Joined])
        {
            var body = Simulation.Bodies[handle];
            Assert.InRange(body.Pose.Position.Length(), 0, 100);
            Assert.InRange(body.Velocity.Linear.Length() + body.Velocity.Angular.Length(), 0, 100);
            Assert.Equal(1, body.Pose.Orientation.Length(), 1e-4f);
            var bounds = body.BoundingBox;
            Assert.InRange((bounds.Max - bounds.Min).Length(), .1f, 100);
        }
    }

    public void Dispose()
    {
        Simulation.Dispose();
        pool.AssertEmpty();
        dispatcher?.WorkerPools.AssertEmpty();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
