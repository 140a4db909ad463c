using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What comes down fast on a rigid surface is stopped there, as a rigid body without a bounce is.</summary>
public class LandingTests
{
    const float Dt = TestWorld.Dt;

    static TestWorld Create(AccuracySettings settings)
    {
        var world = new TestWorld(settings);
        world.Solver.StopsImpacts = true;
        return world;
    }

    public enum Faller { Cube, Board, Plate, Cylinder, Sphere, Capsule }

    // Half of its height, and the body; all are 1 m long or so at a size of 1.
    static (float HalfHeight, BodyHandle Body) Add(TestWorld world, Faller faller, float size, RigidPose pose, BodyVelocity velocity)
    {
        var half = size * faller switch { Faller.Board => .25f, Faller.Plate => .05f, Faller.Capsule => .3f, _ => .5f };
        pose.Position.Y += half;
        return (half, faller switch
        {
            Faller.Cube => world.AddDynamic(new Box(size, size, size), 1, pose, velocity),
            Faller.Board => world.AddDynamic(new Box(2 * size, .5f * size, size), 1, pose, velocity),
            Faller.Plate => world.AddDynamic(new Box(size, .1f * size, size), 1, pose, velocity),
            Faller.Cylinder => world.AddDynamic(new Cylinder(.5f * size, size), 1, pose, velocity),
            Faller.Sphere => world.AddDynamic(new Sphere(half), 1, pose, velocity),
            _ => world.AddDynamic(new Capsule(half, size), 1, pose with { Orientation = Lying * pose.Orientation }, velocity),
        });
    }

    static readonly Quaternion Lying = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);

    public static TheoryData<Faller, float, float, int> Falls
    {
        get
        {
            var data = new TheoryData<Faller, float, float, int>();
            foreach (var faller in Enum.GetValues<Faller>())
            {
                foreach (var speed in new[] { 1f, 3, 10, 30 })
                    data.Add(faller, speed, 1, 4);
                data.Add(faller, 10, 1, 16);
                data.Add(faller, 1, .01f, 4);
                data.Add(faller, 100, 100, 4);
            }
            return data;
        }
    }

    /// <summary>
    /// What falls flat lies there, wherever in a step it meets the floor: it leaves with no speed, does not turn, and sinks in no deeper
    /// than it rests.
    /// </summary>
    [Theory, MemberData(nameof(Falls))]
    public void What_falls_flat_stays_where_it_falls(Faller faller, float speed, float size, int substeps)
    {
        var random = new Random(7);
        for (int i = 0; i < 8; ++i)
        {
            using var world = Create(new AccuracySettings { SubstepCount = substeps });
            world.AddStatic(new Box(100 * size, size, 100 * size), new RigidPose(new Vector3(0, -.5f * size, 0)));
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, 6 * random.NextSingle());
            var place = new Vector3(0, speed * Dt * (1 + random.NextSingle()), 0);
            var pose = new RigidPose(place, faller == Faller.Capsule ? Quaternion.Identity : turn);
            var (half, handle) = Add(world, faller, size, pose, new BodyVelocity(new Vector3(0, -speed, 0)));
            var body = world.Bodies[handle];
            var (up, spin, least) = (0f, 0f, float.MaxValue);
            for (int j = 0; j < 30; ++j)
            {
                world.Step();
                if (j < 3)
                    continue;
                up = MathF.Max(up, body.Velocity.Linear.Y);
                spin = MathF.Max(spin, body.Velocity.Angular.Length());
                least = MathF.Min(least, body.Pose.Position.Y - half);
            }
            // What gravity gives in a substep is no less than rounding.
            var slow = .002f * speed + 9.81f * Dt / substeps;
            Assert.InRange(up, 0, slow);
            Assert.InRange(spin * size, 0, slow);
            Assert.InRange(least, -.002f * size - 2 * 9.81f * Dt * Dt / (substeps * substeps), .002f * size);
        }
    }

    /// <summary>Two equal bodies that meet face-on go on together, and one that something unstoppable hits goes on with it.</summary>
    [Theory, InlineData(1), InlineData(5), InlineData(20)]
    public void What_is_hit_face_on_goes_on_with_what_hits_it(float speed)
    {
        for (int i = 0; i < 8; ++i)
        {
            foreach (var byKinematic in new[] { false, true })
            {
                using var world = Create(new AccuracySettings { Gravity = default });
                var cube = new Box(1, 1, 1);
                var hit = world.Bodies[world.AddDynamic(cube, 1, new RigidPose(default(Vector3)))];
                var start = new RigidPose(new Vector3(-1 - speed * Dt * (1 + i / 8f), 0, 0));
                var hitting = world.Bodies[byKinematic ? world.AddKinematic(cube, start) : world.AddDynamic(cube, 1, start)];
                hitting.Velocity.Linear.X = speed;
                world.Step(8);
                var expected = byKinematic ? speed : speed / 2;
                Assert.InRange(hit.Velocity.Linear.X, .995f * expected, 1.005f * expected);
                Assert.InRange(hitting.Velocity.Linear.X, .995f * expected, 1.005f * expected);
                Assert.InRange(hit.Velocity.Angular.Length(), 0, 2e-3f * speed);
            }
        }
    }

    // A rod that falls level and comes on a post by one end. Its end stops there: J = m v / (1 + x^2 / k^2), so it turns by v x / (x^2 +
    // k^2), and its centre goes on with v x^2 / (x^2 + k^2).
    [Theory, InlineData(2), InlineData(8)]
    public void A_rod_that_falls_on_its_end_turns_about_it(float speed)
    {
        const float length = 2, thickness = .1f, width = .2f;
        const float overlap = .1f;
        for (int i = 0; i < 8; ++i)
        {
            using var world = Create(new AccuracySettings { Gravity = default, Friction = 0 });
            world.AddStatic(new Box(1, 1, 1), new RigidPose(new Vector3(length / 2 + .5f - overlap, -.5f - thickness / 2, 0)));
            var start = new RigidPose(new Vector3(0, speed * Dt * (1 + i / 8f), 0));
            var rod = world.Bodies[world.AddDynamic(
                new Box(length, thickness, width), 1, start, new BodyVelocity(new Vector3(0, -speed, 0)))];
            // Nothing turns it when it has left the post.
            world.Step(5);
            var turned = MathF.Abs(rod.Velocity.Angular.Z);
            var squaredRadius = (length * length + thickness * thickness) / 12;
            // Contacts are the corners of what lies on each other: the inner ones stop it first, and then its end goes up.
            var arm = length / 2 - overlap;
            Assert.InRange(turned, .97f * speed * arm / (arm * arm + squaredRadius), 1.03f * speed * arm / (arm * arm + squaredRadius));
        }
    }

    // A ball that comes down on a floor aside is slowed by friction by mu v as long as it slides, by two sevenths if that is less, and
    // then rolls.
    [Theory, InlineData(.1f), InlineData(.3f), InlineData(.9f)]
    public void Friction_of_an_impact_is_that_of_its_impulse(float friction)
    {
        const float down = 5, aside = 4, radius = .5f;
        var slowed = MathF.Min(friction * down, aside * 2 / 7);
        for (int i = 0; i < 8; ++i)
        {
            using var world = Create(new AccuracySettings { Gravity = default, Friction = friction });
            world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -.5f, 0)));
            var start = new RigidPose(new Vector3(0, radius + down * Dt * (1 + i / 8f), 0));
            var ball = world.Bodies[world.AddDynamic(new Sphere(radius), 1, start, new BodyVelocity(new Vector3(aside, -down, 0)))];
            world.Step(6);
            Assert.InRange(ball.Velocity.Linear.X, aside - slowed - .01f * aside, aside - slowed + .01f * aside);
            Assert.InRange(ball.Velocity.Angular.Z, -2.5f * slowed / radius - .1f, -2.5f * slowed / radius + .1f);
        }
    }

    /// <summary>A limit of recovery, of nothing too, is none of what stops: what lands needs no recovery.</summary>
    [Theory, InlineData(0), InlineData(1e-3f), InlineData(float.MaxValue)]
    public void What_recovers_slowly_lands_all_the_same(float recovery)
    {
        const float speed = 10;
        for (int i = 0; i < 8; ++i)
        {
            using var world = Create(new AccuracySettings { MaximumRecoveryVelocity = recovery });
            world.AddStatic(new Box(100, 1, 100), new RigidPose(new Vector3(0, -.5f, 0)));
            var tilt = Quaternion.CreateFromAxisAngle(Vector3.UnitX, .003f * (i - 4));
            var pose = new RigidPose(new Vector3(0, .5f + speed * Dt * (1 + i / 8f), 0), tilt);
            var cube = world.Bodies[world.AddDynamic(new Box(1, 1, 1), 1, pose, new BodyVelocity(new Vector3(0, -speed, 0)))];
            for (int j = 0; j < 30; ++j)
            {
                world.Step();
                Assert.InRange(cube.Pose.Position.Y, .5f - 3e-3f, float.MaxValue);
            }
        }
    }

    /// <summary>What falls on tiles and slides over them hands on no impulse of its impact: those that come into the patch would give it once more.</summary>
    [Fact]
    public void Nothing_is_thrown_up_by_the_next_tile()
    {
        const float tile = .3f, speed = 10;
        const int count = 12;
        var sum = 0f;
        for (int i = 0; i < 16; ++i)
        {
            using var world = Create(new AccuracySettings { Friction = .3f });
            for (int x = -count; x < count; ++x)
            {
                for (int z = -count; z < count; ++z)
                    world.AddStatic(new Box(tile, 1, tile), new RigidPose(new Vector3(x * tile, -.5f, z * tile)));
            }
            var pose = new RigidPose(
                new Vector3(i / 50f, .5f + speed * Dt * (1 + i / 16f), i / 90f), Quaternion.CreateFromAxisAngle(Vector3.UnitY, i));
            var cube = world.Bodies[world.AddDynamic(new Box(1, 1, 1), 1, pose, new BodyVelocity(new Vector3(5, -speed, 1.5f)))];
            var up = 0f;
            for (int j = 0; j < 12; ++j)
            {
                world.Step();
                up = j > 1 ? MathF.Max(up, cube.Velocity.Linear.Y) : 0;
            }
            sum += up / speed;
        }
        Assert.InRange(sum / 16, 0, .025f);
    }
}
