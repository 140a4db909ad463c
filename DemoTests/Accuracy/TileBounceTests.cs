using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What meets several things at once bounces as off one: a floor of tiles is a floor, and what is symmetric stays so.</summary>
public class TileBounceTests(ITestOutputHelper output)
{
    const float Half = .25f;
    const float Height = 2;
    static readonly float[] coefficients = [.25f, .5f, .9f, 1];

    public static TheoryData<TileKind, int> Floors()
    {
        var data = new TheoryData<TileKind, int>();
        foreach (var kind in Enum.GetValues<TileKind>())
            foreach (int count in new[] { 1, 2, 4, 9 })
                data.Add(kind, count);
        return data;
    }

    [Theory, MemberData(nameof(Floors))]
    public void Flat_drop_leaves_with_its_share_of_the_speed(TileKind kind, int count)
    {
        double worst = 0, spin = 0;
        foreach (string shape in new[] { "box", "sphere", "table" })
            foreach (float restitution in coefficients)
                foreach (float friction in new[] { 0, .5f })
                    foreach (int relaxations in new[] { 0, 1 })
                    {
                        var settings = new AccuracySettings { Restitution = restitution, Friction = friction, RelaxationCount = relaxations };
                        // The middle one of nine lies under the middle of the box, the others under its rim.
                        using var tiles = new TileWorld(settings, kind, count, count == 9 ? .5f : 2);
                        var world = tiles.World;
                        var body = AddBody(tiles, shape);
                        // Away from the floor, so that a body has all of its bounce.
                        for (bool rises = false; !(rises && world.Position(body).Y > Half + .05);)
                        {
                            world.Step(settings.Dt);
                            rises |= world.LinearVelocity(body).Y > 0;
                            Assert.True(world.Time < 2, $"{shape}, e = {restitution}: does not come back");
                        }
                        double wanted = restitution * Math.Sqrt(2 * 9.81 * Height);
                        worst = Math.Max(worst, Math.Abs(LeavingSpeed(world, body) / wanted - 1));
                        spin = Math.Max(spin, world.AngularVelocity(body).Length);
                    }
        output.WriteLine($"speed wrong by {worst:g3} of itself, spin {spin:g3} rad/s");
        Assert.InRange(worst, 0, .01);
        Assert.InRange(spin, 0, 1e-4);
    }

    // Backwards from a height by the parabola on which positions lie: their velocity is that of the bodies less half a substep of gravity.
    static double LeavingSpeed(AccuracyWorld world, BodyHandle body)
    {
        double speed = world.LinearVelocity(body).Y - 9.81 * world.Settings.SubstepDuration / 2;
        return Math.Sqrt(speed * speed + 2 * 9.81 * (world.Position(body).Y - Half));
    }

    static BodyHandle AddBody(TileWorld tiles, string shape)
    {
        var pose = new RigidPose(new Vector3(0, Half + Height, 0));
        if (shape == "sphere")
            return tiles.World.AddDynamic(new Sphere(Half), 1, pose);
        if (shape == "box")
            return tiles.World.AddDynamic(new Box(1.4f, 2 * Half, 1.1f), 1, pose);
        // Four legs: a manifold for each, also on one floor.
        var legs = tiles.AddCompound(new Box(.1f, 2 * Half, .1f), [new(-.6f, 0, -.4f), new(.6f, 0, -.4f), new(-.6f, 0, .4f), new(.6f, 0, .4f)]);
        var inertia = new Box(1.3f, 2 * Half, .9f).ComputeInertia(1);
        return tiles.World.Bodies.Add(
            BodyDescription.CreateDynamic(pose, inertia, new CollidableDescription(legs), new BodyActivityDescription(-1)));
    }

    // Whatever the order in which corners meet tiles.
    [Theory, MemberData(nameof(Floors))]
    public void Tumbling_box_gains_nothing(TileKind kind, int count)
    {
        var random = new Random(41);
        double most = 0;
        for (int i = 0; i < 64; ++i)
        {
            var settings = new AccuracySettings { Restitution = coefficients[i % 4], Friction = i % 8 < 4 ? 0 : .5f };
            using var tiles = new TileWorld(settings, kind, count, 6);
            var world = tiles.World;
            // From nearly flat to half a turn.
            float tilt = MathF.Pow(10, -3 + 3.5f * random.NextSingle());
            var axis = Vector3.Normalize(new Vector3(random.NextSingle() - .5f, .2f, random.NextSingle() - .5f));
            var box = new Box(1.4f, 2 * Half, 1.1f);
            var place = new Vector3(random.NextSingle() - .5f, 1 + 2 * random.NextSingle(), random.NextSingle() - .5f);
            var velocity = new BodyVelocity(new Vector3(random.NextSingle() - .5f, -2, 0), new Vector3(random.NextSingle() - .5f));
            var body = world.AddDynamic(box, 1, new RigidPose(place, Quaternion.CreateFromAxisAngle(axis, tilt)), velocity);
            var inertia = TorqueFreeBody.BoxInertia(1, 1.4, 2 * Half, 1.1);
            double start = Energy(world, body, inertia);
            world.Run(1.5, () => most = Math.Max(most, Energy(world, body, inertia) / start - 1));
        }
        output.WriteLine($"{most:g3} gained");
        // Rounding of 90 steps.
        Assert.InRange(most, 0, 1e-5);
    }

    static double Energy(AccuracyWorld world, BodyHandle body, Double3 inertia)
    {
        double along = world.LinearVelocity(body).Y;
        double onParabola = along - 9.81 * world.Settings.SubstepDuration / 2;
        return world.Energy(body, 1, inertia) + (onParabola * onParabola - along * along) / 2;
    }

    public static IEnumerable<object[]> Efforts() =>
        from effort in ImpactWorld.Efforts()
        where effort.VelocityIterationCount == 1
        select new object[] { effort.SubstepCount, effort.RelaxationCount };

    [Theory, MemberData(nameof(Efforts))]
    public void Ball_between_two_alike_leaves_straight(int substeps, int relaxations)
    {
        var settings = new AccuracySettings { SubstepCount = substeps, RelaxationCount = relaxations, Restitution = 1, Friction = 0, Gravity = default };
        using var world = new ImpactWorld(settings);
        var ball = new Sphere(.5f);
        // In steps of a millimetre, so that normals are those of the impact.
        const float apart = .505f;
        world.Add(ball, 1, new RigidPose(new Vector3(-apart, 0, 0)));
        world.Add(ball, 1, new RigidPose(new Vector3(apart, 0, 0)));
        world.Add(ball, 1, new RigidPose(new Vector3(0, .9f, 0)), new Vector3(0, -.06f, 0));
        world.World.Run(2);
        // Two impulses J along normals (-+a, h): the approach u h is turned round by 2 h J h of the ball and J of each of the others.
        double h = Math.Sqrt(1 - apart * apart), u = .06;
        double impulse = 2 * u * h / (1 + 2 * h * h);
        AssertNear(new Double3(-impulse * apart, -impulse * h, 0), world.Velocity(0));
        AssertNear(new Double3(impulse * apart, -impulse * h, 0), world.Velocity(1));
        AssertNear(new Double3(0, 2 * impulse * h - u, 0), world.Velocity(2));

        void AssertNear(Double3 wanted, Double3 velocity)
        {
            output.WriteLine($"{velocity}, wanted {wanted}");
            Assert.InRange((velocity - wanted).Length / u, 0, 2e-3);
        }
    }
}
