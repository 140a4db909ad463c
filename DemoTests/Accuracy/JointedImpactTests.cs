using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What hangs in joints is hit as a whole: by the impact of least energy that leaves all joints as they are.</summary>
public class JointedImpactTests(ITestOutputHelper output)
{
    const float BallRadius = .1f;

    /// <summary>What is hit.</summary>
    public enum Structure
    {
        PlankOnKinematic,
        DoorNearHinge,
        DoorAtEnd,
        DoublePendulumAbove,
        DoublePendulumBelow,
        ChainOfTen,
        BarOfFour,
        Doll,
    }

    public static TheoryData<Structure, float, float> Structures()
    {
        var data = new TheoryData<Structure, float, float>();
        foreach (var structure in Enum.GetValues<Structure>())
            foreach (float restitution in new[] { 0, .5f, 1 })
                foreach (int rate in new[] { 30, 60, 240 })
                    data.Add(structure, restitution, 1f / rate);
        return data;
    }

    [Theory, MemberData(nameof(Structures))]
    public void Structure_is_hit_as_a_whole(Structure structure, float restitution, float dt)
    {
        using var world = new JointedImpactWorld(restitution, dt);
        var (target, point, normal) = Build(world, structure);
        var (ball, others, turn) = Hit(world, target, point, normal, 4, 1, dt);
        output.WriteLine($"ball {ball:g3}, others {others:g3} of the speed, turned by {turn:g3}");
        // What does not leave is pushed on by what turns.
        Assert.InRange(ball, 0, restitution > 0 ? 1e-5 : 1e-3 + turn * turn);
        // What has turned when the step ends is not where it was hit, and its velocity has turned as far.
        Assert.InRange(others, 0, 1e-3 + turn);
    }

    static (int Target, Vector3 Point, Vector3 Normal) Build(JointedImpactWorld world, Structure structure)
    {
        var up = Vector3.UnitY;
        switch (structure)
        {
            case Structure.PlankOnKinematic:
                world.Add(new Box(2, .2f, 2), 1, new RigidPose(Vector3.Zero));
                world.Weld(world.AddAnchor(new(-1, 0, 0)), 0);
                return (0, new(.3f, .1f, 0), up);
            case Structure.DoorNearHinge or Structure.DoorAtEnd:
                world.Add(new Box(1, .1f, .3f), 2, new RigidPose(new Vector3(.5f, 0, 0)));
                world.Hinge(world.AddAnchor(default), 0, default, Vector3.UnitZ);
                return (0, new(structure == Structure.DoorAtEnd ? .9f : .2f, .05f, 0), up);
            case Structure.DoublePendulumAbove or Structure.DoublePendulumBelow:
                world.Add(new Box(.2f, .8f, .2f), 1, new RigidPose(new Vector3(0, -.5f, 0)));
                world.Add(new Box(.2f, .8f, .2f), 2, new RigidPose(new Vector3(0, -1.5f, 0)), collides: false);
                world.Hinge(world.AddAnchor(default), 0, default, Vector3.UnitZ);
                world.Hinge(0, 1, -up, Vector3.UnitZ);
                if (structure == Structure.DoublePendulumAbove)
                    return (0, new(.1f, -.7f, 0), Vector3.UnitX);
                world.Add(new Box(.2f, .8f, .2f), 2, new RigidPose(new Vector3(0, -2.5f, 0)));
                world.Socket(1, 3, -2 * up);
                return (3, new(.1f, -2.6f, 0), Vector3.UnitX);
            case Structure.ChainOfTen:
                for (int i = 0; i < 10; ++i)
                {
                    world.Add(new Box(.1f, .3f, .1f), 1, new RigidPose(new Vector3(0, -.4f * i, 0)), collides: i == 3);
                    if (i > 0)
                        world.Socket(i - 1, i, new(0, -.4f * i + .2f, 0));
                }
                world.Socket(world.AddAnchor(new(0, .2f, 0)), 0, new(0, .2f, 0));
                return (3, new(.05f, -1.25f, 0), Vector3.UnitX);
            case Structure.BarOfFour:
                // Neighbours touch each other all the while.
                for (int i = 0; i < 4; ++i)
                {
                    world.Add(new Box(.5f, .2f, .2f), 1, new RigidPose(new Vector3(i * .5f, 0, 0)));
                    if (i > 0)
                        world.Weld(i - 1, i);
                }
                return (3, new(1.5f, .1f, 0), up);
            default:
                world.Add(new Box(.4f, .6f, .2f), 30, new RigidPose(Vector3.Zero), collides: false);
                world.Add(new Box(.2f, .2f, .2f), 5, new RigidPose(new Vector3(0, .45f, 0)), collides: false);
                world.Socket(0, 1, new(0, .32f, 0));
                for (int side = -1; side <= 1; side += 2)
                {
                    int upper = world.Add(new Box(.4f, .1f, .1f), 3, new RigidPose(new Vector3(side * .45f, .25f, 0)), collides: false);
                    int lower = world.Add(new Box(.4f, .1f, .1f), 2, new RigidPose(new Vector3(side * .9f, .25f, 0)), collides: side > 0);
                    world.Socket(0, upper, new(side * .22f, .25f, 0));
                    world.Hinge(upper, lower, new(side * .67f, .25f, 0), Vector3.UnitZ);
                    int leg = world.Add(new Box(.15f, .8f, .15f), 8, new RigidPose(new Vector3(side * .12f, -.75f, 0)), collides: false);
                    world.Socket(0, leg, new(side * .12f, -.32f, 0));
                }
                return (6, new(.95f, .3f, 0), up);
        }
    }

    // Throws a ball at a place; how wrong its velocity and those of the others are after the hit, of its speed, and how far any of these turns in a step.
    static (double Ball, double Others, double Turn) Hit(JointedImpactWorld world, int target, Vector3 point, Vector3 normal, float speed, float mass, float dt)
    {
        var velocity = normal * -speed;
        int ball = world.Add(new Sphere(BallRadius), mass, new RigidPose(point + normal * BallRadius - velocity * (3.3f * dt)), velocity);
        var expected = world.Expect(ball, target, point, normal);
        double before = world.Energy();
        for (int i = 0; i < 6 && world[ball].Velocity.Linear == velocity; ++i)
            world.Step();
        Assert.True(world.Energy() <= before * (1 + 1e-5), $"energy {before} became {world.Energy()}");
        double turn = 0;
        for (int i = 0; i < world.Count; ++i)
            turn = Math.Max(turn, new Double3(expected[i][3], expected[i][4], expected[i][5]).Length * dt);
        return (world.Difference(ball, expected[ball], 0) / speed, world.Difference(expected, ball, .3) / speed, turn);
    }

    [Theory]
    [InlineData(0, 60)]
    [InlineData(.5f, 240)]
    [InlineData(1, 240)]
    [InlineData(1, 60)]
    public void Any_tree_is_hit_as_a_whole(float restitution, int rate)
    {
        double worstBall = 0, worstRest = 0;
        for (int seed = 0; seed < 100; ++seed)
        {
            var (ball, rest, _) = HitRandom(seed, restitution, 1f / rate, hasLoops: false);
            (worstBall, worstRest) = (Math.Max(worstBall, ball), Math.Max(worstRest, rest));
        }
        output.WriteLine($"ball {worstBall:g3}, others {worstRest:g3} of the speed");
        Assert.InRange(worstBall, 0, restitution > 0 ? 1e-5 : 5e-3);
        Assert.InRange(worstRest, 0, 6.0 / rate);
    }

    [Theory]
    [InlineData(.5f)]
    [InlineData(1)]
    public void Loops_are_hit_nearly_as_a_whole(float restitution)
    {
        var balls = new List<double>();
        for (int seed = 0; seed < 100; ++seed)
            balls.Add(HitRandom(seed, restitution, 1 / 240f, hasLoops: true).Ball);
        balls.Sort();
        output.WriteLine($"ball: median {balls[50]:g3}, 90 % {balls[90]:g3}, worst {balls[99]:g3} of the speed");
        Assert.InRange(balls[50], 0, 1e-3);
        Assert.InRange(balls[90], 0, .02);
    }

    static (double Ball, double Others, double Turn) HitRandom(int seed, float restitution, float dt, bool hasLoops)
    {
        var random = new Random(seed);
        using var world = new JointedImpactWorld(restitution, dt);
        int count = 2 + random.Next(7), target = random.Next(count);
        Vector3 size = default;
        for (int i = 0; i < count; ++i)
        {
            var position = i == 0 ? default : world[random.Next(i)].Pose.Position + Direction(random) * (.4f + .6f * random.NextSingle());
            var box = new Box(.2f + random.NextSingle(), .2f + random.NextSingle(), .2f + random.NextSingle());
            if (i == target)
                size = new(box.Width, box.Height, box.Length);
            // Only the one that is hit has a shape: neighbours overlap.
            world.Add(box, .5f + 4 * random.NextSingle(), new RigidPose(position, Turned(random)), collides: i == target);
            if (i > 0)
                Join(world, random, random.Next(i), i);
        }
        if (random.Next(2) == 0)
            Join(world, random, world.AddAnchor(Direction(random) * .5f), 0);
        if (hasLoops)
        {
            world.Socket(0, count - 1, Direction(random));
            var point = world[count - 1].Pose.Position + Direction(random) * .4f;
            world.Socket(world.AddAnchor(point), count - 1, point);
        }
        var face = random.Next(3) switch { 0 => Vector3.UnitX, 1 => Vector3.UnitY, _ => Vector3.UnitZ };
        var place = new Vector3(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f) * size * .8f;
        place += (size / 2 - place) * face;
        var pose = world[target].Pose;
        return Hit(
            world, target, pose.Position + QuaternionEx.Transform(place, pose.Orientation), QuaternionEx.Transform(face, pose.Orientation),
            1 + 4 * random.NextSingle(), MathF.Pow(10, 2 * random.NextSingle() - 1), dt);
    }

    static void Join(JointedImpactWorld world, Random random, int a, int b)
    {
        var point = (world[a].Pose.Position + world[b].Pose.Position) / 2 + Direction(random) * .1f;
        switch (random.Next(3))
        {
            case 0:
                world.Socket(a, b, point);
                break;
            case 1:
                world.Hinge(a, b, point, Direction(random));
                break;
            default:
                world.Weld(a, b);
                break;
        }
    }

    static Quaternion Turned(Random random) => Quaternion.Normalize(
        new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f));

    static Vector3 Direction(Random random) => QuaternionEx.Transform(Vector3.UnitX, Turned(random));

    [Theory]
    [InlineData(60)]
    [InlineData(120)]
    public void Balls_on_rods_swing_as_a_cradle(int rate)
    {
        const float angle = .5f, diameter = .2f;
        using var world = new JointedImpactWorld(1, 1f / rate, gravity: 9.81f);
        for (int i = 0; i < 5; ++i)
        {
            var pivot = new Vector3(i * diameter, 1, 0);
            var arm = i == 0 ? new Vector3(-MathF.Sin(angle), -MathF.Cos(angle), 0) : -Vector3.UnitY;
            // Those at rest have to see each other before the blow is there.
            world.Add(new Sphere(diameter / 2), 1, new RigidPose(pivot + arm), margin: .1f);
        }
        for (int i = 0; i < 5; ++i)
        {
            var pivot = new Vector3(i * diameter, 1, 0);
            world.Socket(world.AddAnchor(pivot), i, pivot);
        }
        double highest = 0;
        // Half a period, and a little more.
        for (int i = 0; i < rate * 6 / 5; ++i)
        {
            world.Step();
            highest = Math.Max(highest, world[4].Pose.Position.Y);
            for (int ball = 1; ball < 4; ++ball)
                Assert.InRange(world[ball].Pose.Position.Y, -1e-3f, 1e-3f);
        }
        Assert.InRange(highest / (1 - Math.Cos(angle)), .99, 1.001);
    }

    // Each leg is a body.
    [Theory]
    [InlineData(.5f)]
    [InlineData(1)]
    public void Table_that_falls_on_its_legs_stays_level(float restitution)
    {
        using var world = new JointedImpactWorld(restitution, 1 / 60f, friction: .5f);
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), world.Simulation.Shapes.Add(new Box(10, 1, 10))));
        var down = new Vector3(0, -3, 0);
        world.Add(new Box(2, .1f, 1), 5, new RigidPose(new Vector3(0, 1.35f, 0)), down);
        for (int i = 0; i < 4; ++i)
        {
            var place = new Vector3(i % 2 * 1.8f - .9f, .8f, i / 2 * .8f - .4f);
            world.Weld(0, world.Add(new Box(.1f, 1, .1f), 1, new RigidPose(place), down));
        }
        for (int i = 0; i < 20; ++i)
            world.Step();
        for (int i = 0; i < world.Count; ++i)
        {
            Assert.InRange(world[i].Velocity.Linear.Y, 3 * restitution * .998f, 3 * restitution * 1.002f);
            Assert.InRange(world[i].Velocity.Angular.Length(), 0, 5e-3f);
        }
    }

    [Theory]
    [InlineData(.5f, 0)]
    [InlineData(1, 0)]
    [InlineData(1, .5f)]
    public void Nothing_gains_energy(float restitution, float friction)
    {
        for (int seed = 0; seed < 20; ++seed)
        {
            using var world = JointedImpactCrowd.Create(seed, restitution, friction);
            double start = world.Energy();
            for (int step = 0; step < 120; ++step)
            {
                world.Step();
                Assert.True(world.Energy() <= start * (1 + 1e-3), $"seed {seed}, step {step}: {world.Energy() / start} of the energy");
            }
        }
    }

    [Theory]
    [InlineData(2)]
    [InlineData(5)]
    public void Threads_change_nothing(int threads)
    {
        var expected = Run(null);
        using var dispatcher = new ThreadDispatcher(threads);
        Assert.Equal(expected, Run(dispatcher));

        static List<Vector3> Run(IThreadDispatcher? dispatcher)
        {
            using var world = JointedImpactCrowd.Create(1, .9f, .3f);
            for (int i = 0; i < 90; ++i)
                world.Step(dispatcher);
            var motion = new List<Vector3>();
            for (int i = 0; i < world.Count; ++i)
                motion.AddRange([world[i].Velocity.Linear, world[i].Velocity.Angular, world[i].Pose.Position]);
            return motion;
        }
    }

    // The blow is (1 + e) m v.
    [Theory]
    [InlineData(5.9f, true)]
    [InlineData(6.1f, false)]
    public void Blow_breaks_joint(float threshold, bool breaks)
    {
        using var world = new JointedImpactWorld(.5f, 1 / 60f);
        world.Add(new Box(2, .2f, 2), 1, new RigidPose(Vector3.Zero));
        var weld = world.Weld(world.AddAnchor(new(-1, 0, 0)), 0);
        world.Simulation.Solver.SetBreakThreshold(weld, new() { Impulse = threshold, AngularImpulse = float.PositiveInfinity });
        world.Add(new Sphere(.2f), 1, new RigidPose(new Vector3(0, .6f, 0)), new Vector3(0, -4, 0));
        bool broke = false;
        for (int i = 0; i < 20; ++i)
        {
            world.Step();
            broke |= world.Simulation.Solver.BrokenConstraints.Length > 0;
        }
        Assert.Equal(breaks, broke);
    }
}
