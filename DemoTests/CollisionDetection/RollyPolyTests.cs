using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.JointTables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>
/// A toy that rights itself, a ball of radius R whose centre of mass is at d below its middle, rocks with a period of 2 pi sqrt((I + m (R - d)^2) / (m g d)),
/// and no higher than it was let go.
/// </summary>
public class RollyPolyTests
{
    const float Mass = 2, Radius = .5f, Moment = .2f;
    const double Amplitude = .2;

    /// <summary>What it rolls on.</summary>
    public enum Ground
    {
        Box,
        HalfSpace,
        Triangles,
        LaterBody,
    }

    public static TheoryData<Ground, float, int, int> Rockers => new()
    {
        { Ground.Box, .1f, 4, 0 },
        { Ground.Box, .3f, 4, 0 },
        { Ground.Box, .3f, 16, 1 },
        { Ground.HalfSpace, .3f, 4, 0 },
        { Ground.Triangles, .3f, 4, 0 },
        { Ground.LaterBody, .3f, 4, 0 },
    };

    [Theory, MemberData(nameof(Rockers))]
    public void It_rocks_with_its_period_and_no_higher(Ground ground, float depth, int substeps, int relaxations) =>
        Rock(ground, depth, substeps, relaxations, shapes => shapes.Add(new Sphere(Radius)), Quaternion.Identity);

    // A runner: a capsule across the way that it rocks, which is as round as the ball. It rose by 3.5 times its energy within 20 s.
    [Theory, MemberData(nameof(Rockers))]
    public void So_does_a_capsule_across(Ground ground, float depth, int substeps, int relaxations) => Rock(
        ground, depth, substeps, relaxations, shapes => shapes.Add(new Capsule(Radius, 1)),
        Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2));

    static void Rock(Ground ground, float depth, int substeps, int relaxations, Func<Shapes, TypedIndex> add, Quaternion way)
    {
        using var world = new TestWorld(new AccuracySettings { Friction = 1, SubstepCount = substeps, RelaxationCount = relaxations });
        if (ground != Ground.LaterBody)
            AddGround(world, ground);
        var orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, (float)Amplitude);
        world.Pool.Take<CompoundChild>(1, out var children);
        children[0] = new(new RigidPose(new Vector3(0, depth, 0), way), add(world.Simulation.Shapes));
        var inertia = new BodyInertia { InverseMass = 1 / Mass, InverseInertiaTensor = new() { XX = 1 / Moment, YY = 1 / Moment, ZZ = 1 / Moment } };
        var pose = new RigidPose(new Vector3(0, Radius, 0) - Vector3.Transform(new Vector3(0, depth, 0), orientation), orientation);
        var toy = world.Bodies.Add(BodyDescription.CreateDynamic(pose, inertia, world.Simulation.Shapes.Add(new Compound(children)), -1));
        if (ground == Ground.LaterBody)
            AddGround(world, ground);
        double start = Energy(), most = start;
        var clock = new SwingClock();
        for (int i = 1; i <= 1200; ++i)
        {
            world.Step();
            most = Math.Max(most, Energy());
            clock.Observe(i / 60.0, -Vector3.Transform(Vector3.UnitY, world.Bodies[toy].Pose.Orientation).X);
        }
        var end = Energy();
        world.Simulation.DisposeHulls();
        double swing = Mass * 9.81 * depth * (1 - Math.Cos(Amplitude));
        double period = 2 * Math.PI * Math.Sqrt((Moment + Mass * (Radius - depth) * (Radius - depth)) / (Mass * 9.81 * depth));
        double lost = (start - end) / swing;
        Assert.True(
            most - start < .01 * swing && lost < .25 && Math.Abs(clock.Mean() / period - 1) < .02,
            FormattableString.Invariant($"rose by {(most - start) / swing:p2}, lost {lost:p2}, period {clock.Mean() / period:g4}"));

        double Energy()
        {
            ref var state = ref world.Bodies[toy].MotionState;
            return (Mass * state.Velocity.Linear.LengthSquared() + Moment * state.Velocity.Angular.LengthSquared()) / 2 +
                Mass * 9.81 * state.Pose.Position.Y;
        }
    }

    static void AddGround(TestWorld world, Ground ground)
    {
        var box = new Box(200, 2, 200);
        switch (ground)
        {
            case Ground.HalfSpace:
                world.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(new HalfSpace(Vector3.UnitY))));
                break;
            case Ground.Triangles:
                world.Pool.Take<Triangle>(2, out var triangles);
                Vector3 a = new(-20, 0, -19), b = new(20, 0, -19), c = new(20, 0, 21), d = new(-20, 0, 21);
                triangles[0] = new(a, b, c);
                triangles[1] = new(a, c, d);
                world.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(new Mesh(triangles, Vector3.One, world.Pool))));
                break;
            case Ground.LaterBody:
                world.AddStatic(box, new RigidPose(new Vector3(0, -3, 0)));
                world.AddDynamic(box, 1e6f, new RigidPose(new Vector3(0, -1, 0)));
                break;
            default:
                world.AddStatic(box, new RigidPose(new Vector3(0, -1, 0)));
                break;
        }
    }
}
