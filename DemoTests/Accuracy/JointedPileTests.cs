using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Accuracy;

/// <summary>Balls in joints that bounce and lie on each other: what is done for those that swing does not let these through each other, or up.</summary>
public sealed class JointedPileTests : IDisposable
{
    const float Gravity = 9.81f;

    readonly BufferPool pool = new();
    readonly List<BodyHandle> balls = [];
    Simulation simulation = null!;

    public void Dispose()
    {
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    void Create(float restitution, int substeps)
    {
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(.5f, 2, SpringSettings.Rigid))
        {
            Surface = new() { Restitution = restitution },
        };
        simulation = Simulation.Create(
            pool, callbacks, new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)), new SolveDescription(1, substeps));
        AddWall(new(0, -.5f, 0), new(200, 1, 200));
    }

    void AddWall(Vector3 position, Vector3 size) =>
        simulation.Statics.Add(new StaticDescription(position, simulation.Shapes.Add(new Box(size.X, size.Y, size.Z))));

    BodyHandle AddBall(float radius, Vector3 position)
    {
        var sphere = new Sphere(radius);
        var ball = simulation.Bodies.Add(
            BodyDescription.CreateDynamic(new RigidPose(position), sphere.ComputeInertia(1), simulation.Shapes.Add(sphere), new BodyActivityDescription(-1)));
        balls.Add(ball);
        return ball;
    }

    BodyHandle AddAnchor(Vector3 position) =>
        simulation.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(position), default, new BodyActivityDescription(-1)));

    Vector3 Position(BodyHandle body) => simulation.Bodies[body].Pose.Position;

    // Greatest energy over that at the beginning, and greatest depth of balls of one radius in each other.
    (double Energy, float Depth) Run(float seconds, float radius)
    {
        double start = Energy(), greatest = 0;
        float depth = 0;
        for (int i = 0; i < seconds * 60; ++i)
        {
            simulation.Timestep(1 / 60f);
            greatest = Math.Max(greatest, Energy() / start);
            for (int a = 0; a < balls.Count; ++a)
                for (int b = 0; b < a; ++b)
                    depth = MathF.Max(depth, 2 * radius - Vector3.Distance(Position(balls[a]), Position(balls[b])));
        }
        return (greatest, depth);
    }

    double Energy()
    {
        double energy = 0;
        foreach (var handle in balls)
        {
            var body = simulation.Bodies[handle];
            energy += (body.Velocity.Linear.LengthSquared() + body.Velocity.Angular.LengthSquared() / body.LocalInertia.InverseInertiaTensor.XX) / 2;
            energy += Gravity * body.Pose.Position.Y;
        }
        return energy;
    }

    // Where the solver was told of no overlap but next to the floor, the third layer went through the second one and threw the others out.
    [Theory]
    [InlineData(3, .3f)]
    [InlineData(8, .3f)]
    [InlineData(8, .6f)]
    public void Pairs_in_a_shaft_lie_on_each_other(int count, float restitution)
    {
        Create(restitution, 4);
        foreach (int side in new[] { -1, 1 })
        {
            AddWall(new(side * .705f, 5, 0), new(1, 20, 200));
            AddWall(new(0, 5, side * .605f), new(200, 20, 1));
        }
        for (int i = 0; i < count; ++i)
        {
            var y = .12f + i * .22f;
            var (a, b) = (AddBall(.1f, new(-.1f, y, 0)), AddBall(.1f, new(.1f, y, 0)));
            simulation.Solver.Add(
                a, b, new Weld { LocalOffset = new(.2f, 0, 0), LocalOrientation = Quaternion.Identity, SpringSettings = SpringSettings.Rigid });
        }
        var (energy, depth) = Run(10, .1f);
        Assert.InRange(energy, .9, 1.005);
        Assert.InRange(depth, -1, .03f);
    }

    // Links of a chain turn by so much within a substep that they are nowhere near the tangents of their circles.
    [Theory]
    [InlineData(.001f, 250, false, 4)]
    [InlineData(.01f, 120, false, 4)]
    [InlineData(.01f, 120, true, 1)]
    public void Chain_that_falls_gains_nothing(float rise, int count, bool hangs, int substeps)
    {
        Create(1, substeps);
        var last = hangs ? AddAnchor(new(0, 2, 0)) : default;
        for (int i = 0; i < count; ++i)
        {
            var position = hangs ? new Vector3(.11f + i * .22f, 2 + rise * i, 0) : new(i * .22f, 1 + rise * (rise < .01f ? i * 7 % 10 : i), 0);
            var ball = AddBall(.1f, position);
            if (i > 0 || hangs)
            {
                var before = Position(last);
                var point = i == 0 ? before : (before + position) * .5f;
                simulation.Solver.Add(
                    last, ball, new BallSocket { LocalOffsetA = point - before, LocalOffsetB = point - position, SpringSettings = SpringSettings.Rigid });
            }
            last = ball;
        }
        Assert.InRange(Run(5, .1f).Energy, .9, 1.02);
    }

    // Each on an arm of its own, all in one pile: they hang and yet lie on each other.
    [Theory]
    [InlineData(.3f)]
    [InlineData(.7f)]
    public void Pile_on_arms_does_not_sink(float restitution)
    {
        Create(restitution, 4);
        for (int i = 0; i < 6; ++i)
        {
            var y = .16f + i * .31f;
            simulation.Solver.Add(
                AddAnchor(new(1.2f, y, 0)), AddBall(.15f, new(0, y, 0)), new CenterDistanceConstraint(1.2f, SpringSettings.Rigid));
        }
        Assert.InRange(Run(10, .15f).Depth, -1, .03f);
    }
}
