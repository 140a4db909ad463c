using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.Accuracy;
using Demos.JointTables;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.OwnShapes;

/// <summary>What is round, and of a game's own, rocks and spins on the ground without gaining energy.</summary>
/// <remarks>
/// An ellipsoid with half axes a and b that rocks about the third touches the ground with a curvature of 1 / r, r = a^2 / b. Its centre is at b and rises by
/// (r - b) t^2 / 2 with the angle t, so it rocks with a period of 2 pi sqrt((I + m b^2) / (m g (r - b))) where it rolls. On the arms of the beginning of a step
/// one that spins at 3 rad/s without friction gained a quarter of its energy in ten seconds, and a rattleback nearly tripled it.
/// </remarks>
public class RockingEllipsoidTests
{
    const float Mass = 2, Gravity = 9.81f;

    static readonly Ellipsoid egg = new(.5f, .3f, .35f);

    static TestWorld CreateWorld(float friction, int substeps)
    {
        var world = new TestWorld(new AccuracySettings { Friction = friction, SubstepCount = substeps });
        world.Simulation.NarrowPhase.CollisionTaskRegistry
            .RegisterConvex<Ellipsoid, EllipsoidWide, EllipsoidSupport, PointFeature<EllipsoidWide, EllipsoidSupport>>();
        world.AddStatic(new Box(200, 2, 200), new RigidPose(new Vector3(0, -1, 0)));
        return world;
    }

    // On the ground, however it is turned.
    static BodyHandle AddLying(TestWorld world, in Ellipsoid shape, Quaternion orientation, BodyVelocity velocity, BodyInertia inertia)
    {
        shape.ComputeBounds(orientation, out var min, out _);
        return world.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(new Vector3(0, -min.Y, 0), orientation), velocity, inertia, world.Simulation.Shapes.Add(shape), -1));
    }

    static double Energy(TestWorld world, BodyHandle body) => BodyEnergy.Of(world.Bodies[body], Gravity);

    [Theory, InlineData(4), InlineData(16)]
    public void It_rocks_with_its_period_and_no_higher(int substeps)
    {
        const double amplitude = .1;
        using var world = CreateWorld(1, substeps);
        var body = AddLying(world, egg, Quaternion.CreateFromAxisAngle(Vector3.UnitZ, (float)amplitude), default, egg.ComputeInertia(Mass));
        double start = Energy(world, body), most = start;
        var clock = new SwingClock();
        for (int i = 1; i <= 1200; ++i)
        {
            world.Step();
            most = Math.Max(most, Energy(world, body));
            clock.Observe(i / 60.0, -Vector3.Transform(Vector3.UnitY, world.Bodies[body].Pose.Orientation).X);
        }
        double rise = egg.X * egg.X / egg.Y - egg.Y, moment = Mass * (egg.X * egg.X + egg.Y * egg.Y) / 5;
        var swing = Mass * Gravity * rise * amplitude * amplitude / 2;
        var period = 2 * Math.PI * Math.Sqrt((moment + Mass * egg.Y * egg.Y) / (Mass * Gravity * rise));
        Assert.True(
            most - start < .02 * swing && Energy(world, body) > start - .5 * swing && Math.Abs(clock.Mean() / period - 1) < .02,
            FormattableString.Invariant($"rose by {(most - start) / swing:p2}, left {(Energy(world, body) - start) / swing:p2}, {clock.Mean() / period:g4}"));
    }

    // Without friction it has nothing to lose, but for what arms that jump once in a step take.
    [Theory, InlineData(3, 4, 0), InlineData(10, 4, 0), InlineData(3, 16, 0), InlineData(3, 4, 1), InlineData(10, 4, 1)]
    public void It_spins_without_gaining(float speed, int substeps, float friction)
    {
        using var world = CreateWorld(friction, substeps);
        var orientation = Quaternion.CreateFromAxisAngle(Vector3.Normalize(new Vector3(.3f, 0, 1)), .4f);
        var body = AddLying(world, egg, orientation, new BodyVelocity(default, new Vector3(0, speed, 0)), egg.ComputeInertia(Mass));
        double start = Energy(world, body), most = start;
        for (int i = 0; i < 600; ++i)
        {
            world.Step();
            most = Math.Max(most, Energy(world, body));
        }
        Assert.InRange(most / start, 1, 1.005);
        if (friction == 0)
            Assert.InRange(Energy(world, body) / start, .9, 1.005);
    }

    /// <summary>A stone whose inertia is turned against its shape spins one way and turns round when it is spun the other way.</summary>
    [Fact]
    public void A_rattleback_turns_round_and_gains_nothing()
    {
        var shape = new Ellipsoid(.5f, .1f, .2f);
        using var world = CreateWorld(1, 4);
        var (x, z) = (Mass * (.1f * .1f + .2f * .2f) / 5, Mass * (.5f * .5f + .1f * .1f) / 5);
        var (cosine, sine) = (MathF.Cos(.1f), MathF.Sin(.1f));
        var (xx, zz, zx) = (x * cosine * cosine + z * sine * sine, x * sine * sine + z * cosine * cosine, (z - x) * sine * cosine);
        var inertia = shape.ComputeInertia(Mass);
        var determinant = xx * zz - zx * zx;
        inertia.InverseInertiaTensor.XX = zz / determinant;
        inertia.InverseInertiaTensor.ZZ = xx / determinant;
        inertia.InverseInertiaTensor.ZX = -zx / determinant;
        var body = AddLying(world, shape, Quaternion.Identity, new BodyVelocity(default, new Vector3(.02f, -3, .02f)), inertia);
        double start = Energy(world, body), most = start, spin = -3;
        for (int i = 0; i < 1200; ++i)
        {
            world.Step();
            most = Math.Max(most, Energy(world, body));
            spin = Math.Max(spin, world.Bodies[body].Velocity.Angular.Y);
        }
        Assert.True(spin > .5);
        Assert.InRange(most / start, 1, 1.01);
    }
}
