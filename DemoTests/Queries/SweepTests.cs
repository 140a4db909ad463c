using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Sweeps of which the answer is known in closed form, and those that are refused.</summary>
public sealed class SweepTests : IDisposable
{
    // Of the size of the smaller shape: what counts as touching.
    const float Touching = 1e-5f;

    readonly TestWorld world = new(new AccuracySettings { Contacts = ContactScope.None });

    public void Dispose() => world.Dispose();

    List<SweptHit> Sweep<TShape>(in TShape shape, in RigidPose pose, in BodyVelocity velocity, float maximumT = 1) where TShape : unmanaged, IConvexShape
    {
        var hits = new List<SweptHit>();
        var handler = new SweepHits(hits);
        world.Simulation.Sweep(shape, pose, velocity, maximumT, world.Pool, ref handler);
        return hits;
    }

    List<SweptHit> SweepExactly<TShape>(in TShape shape, in RigidPose pose, in BodyVelocity velocity, float minimumProgression, float convergenceThreshold,
        int maximumIterationCount, float maximumT = 1) where TShape : unmanaged, IConvexShape
    {
        var hits = new List<SweptHit>();
        var handler = new SweepHits(hits);
        world.Simulation.Sweep(
            shape, pose, velocity, maximumT, world.Pool, ref handler, minimumProgression, convergenceThreshold, maximumIterationCount);
        return hits;
    }

    static void AssertNear(Vector3 expected, Vector3 actual, float tolerance) =>
        Assert.True(Vector3.Distance(expected, actual) <= tolerance, $"{actual}, not {expected}");

    [Fact]
    public void A_sphere_hits_a_sphere_when_the_distance_of_their_centres_is_their_radii()
    {
        world.AddStatic(new Sphere(1), new Vector3(10, 1.2f, 0));

        var hit = Assert.Single(Sweep(new Sphere(.5f), RigidPose.Identity, new Vector3(20, 0, 0)));

        // (10 - 20 t)^2 + 1.2^2 = 1.5^2
        var t = (10 - .9f) / 20;
        Assert.InRange(hit.T, t - Touching, t);
        AssertNear(new(-.6f, -.8f, 0), hit.Normal, 1e-4f);
        AssertNear(new(10 - .6f, 1.2f - .8f, 0), hit.Place, 1e-4f);
    }

    [Theory]
    [InlineData(1e-3f)]
    [InlineData(1)]
    [InlineData(1e4f)]
    public void A_box_hits_the_ground_with_its_lowest_corner(float size)
    {
        world.AddStatic(new HalfSpace(Vector3.UnitY), RigidPose.Identity);
        var turn = Quaternion.Normalize(new Quaternion(.3f, .2f, -.4f, 1));

        var hit = Assert.Single(Sweep(new Box(size, 2 * size, 3 * size), new RigidPose(new(0, 10 * size, 0), turn), new Vector3(size, -16 * size, 0)));

        var lowest = 0f;
        for (int i = 0; i < 8; ++i)
            lowest = MathF.Max(lowest, -Vector3.Transform(new Vector3((i & 1) - .5f, (i & 2) - 1, .75f * (i & 4) - 1.5f) * size, turn).Y);
        var t = (10 * size - lowest) / (16 * size);
        Assert.InRange(hit.T, t - 1e-5f, t + 1e-6f);
        AssertNear(Vector3.UnitY, hit.Normal, 1e-6f);
        Assert.InRange(hit.Place.Y, -1e-5f * size, 1e-5f * size);
    }

    [Theory]
    [InlineData(.1f)]
    [InlineData(3)]
    [InlineData(400)]
    public void A_rod_that_turns_hits_the_ground_with_its_end(float speed)
    {
        // Half as long as 1, at a height of .6: its end is down when the sine of the angle is .6 less the radius.
        world.AddStatic(new Box(20, 1, 20), new RigidPose(new(0, -.5f, 0)));
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);

        var hit = Assert.Single(Sweep(
            new Capsule(.05f, 2), new RigidPose(new(0, .6f, 0), lying), new BodyVelocity(default, new(0, 0, speed)), 10 / speed));

        var angle = MathF.Asin(.55f);
        Assert.InRange(hit.T * speed, angle - 2e-5f, angle + 1e-6f);
        Assert.InRange(MathF.Abs(hit.Place.X), MathF.Sqrt(1 - .55f * .55f) - 1e-3f, MathF.Sqrt(1 - .55f * .55f) + 1e-3f);
    }

    [Fact]
    public void A_wheel_rolls_along_the_ground_without_a_hit_however_fast()
    {
        world.AddStatic(new Box(2000, 1, 20), new RigidPose(new(900, -.5f, 0)));
        var upright = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);

        Assert.Empty(Sweep(new Cylinder(.5f, .2f), new RigidPose(new(0, .501f, 0), upright), new BodyVelocity(new(100, 0, 0), new(0, 0, -1000))));
        Assert.Empty(Sweep(new Cylinder(.5f, .2f), new RigidPose(new(0, .501f, 0)), new BodyVelocity(new(100, .01f, 0), new(0, 30, 0))));
    }

    [Fact]
    public void What_starts_in_something_hits_at_zero()
    {
        world.AddStatic(new Box(2, 2, 2), RigidPose.Identity);

        Assert.True(Assert.Single(Sweep(new Sphere(.5f), new RigidPose(new(1.4f, 0, 0)), new Vector3(5, 0, 0))).Overlaps);
        Assert.True(Assert.Single(Sweep(new Box(.1f, .1f, .1f), new RigidPose(new(.1f, 0, 0)), default)).Overlaps);
        Assert.Empty(Sweep(new Box(.1f, .1f, .1f), new RigidPose(new(1.06f, 0, 0)), default));
        Assert.Empty(Sweep(new Box(.1f, .1f, .1f), new RigidPose(new(1.06f, 0, 0)), new Vector3(-1, 0, 0), 0));
    }

    [Fact]
    public void What_touches_and_leaves_or_slides_hits_nothing()
    {
        world.AddStatic(new Box(20, 2, 20), RigidPose.Identity);
        // A few millionths above, as a hit leaves it.
        var pose = new RigidPose(new(0, 1.5f + 2e-6f, 0));

        Assert.Empty(Sweep(new Sphere(.5f), pose, new Vector3(0, 1, 0)));
        Assert.Empty(Sweep(new Sphere(.5f), pose, new Vector3(5, 0, 0)));
        Assert.Empty(Sweep(new Box(1, 1, 1), pose, new Vector3(5, 1e-3f, 2)));
        Assert.Empty(Sweep(new Box(1, 1, 1), pose, new BodyVelocity(new(5, 0, 2), new(0, 3, 0))));
        Assert.InRange(Assert.Single(Sweep(new Box(1, 1, 1), pose, new Vector3(5, -1, 2))).T, 0, 2e-6f);
    }

    [Fact]
    public void A_shape_that_was_moved_to_its_hit_can_be_swept_on_along_what_it_hit()
    {
        world.AddStatic(new Box(20, 2, 20), RigidPose.Identity);
        world.AddStatic(new Box(2, 20, 20), new RigidPose(new(6, 0, 0)));
        var random = new Random(3);
        for (int i = 0; i < 100; ++i)
        {
            var pose = new RigidPose(new(random.NextSingle(), 2 + random.NextSingle(), random.NextSingle()), TestWorld.Turn(random));
            var velocity = new Vector3(random.NextSingle() + 1, -4, 0);
            var box = new Box(.5f, .7f, .3f);
            var hit = Assert.Single(Sweep(box, pose, velocity));
            pose.Position += velocity * hit.T;
            var next = Sweep(box, pose, velocity - hit.Normal * Vector3.Dot(velocity, hit.Normal), 10);
            Assert.InRange(Assert.Single(next).Normal.X, -1, -.999f);
        }
    }

    [Fact]
    public void Triangles_are_hit_from_their_fronts()
    {
        // From above, A, B and C follow each other clockwise.
        var triangle = new Triangle(new(-1, 0, -1), new(1, 0, -1), new(0, 0, 1));
        Assert.True(Vector3.Cross(triangle.C - triangle.A, triangle.B - triangle.A).Y > 0);
        var one = world.AddStatic(triangle, RigidPose.Identity);
        var two = world.AddStatic(triangle with { TwoSided = true }, new RigidPose(new(10, 0, 0)));

        foreach (var (x, target) in new[] { (0, one), (10, two) })
        {
            Assert.Equal(target, Assert.Single(Sweep(new Sphere(.2f), new RigidPose(new(x, 2, 0)), new Vector3(0, -4, 0))).Collidable.StaticHandle);
            var backHits = Sweep(new Sphere(.2f), new RigidPose(new(x, -2, 0)), new Vector3(0, 4, 0));
            Assert.Equal(target == two ? 1 : 0, backHits.Count);
            // Through it already: it counts for the side on which the middle is.
            Assert.Single(Sweep(new Sphere(.2f), new RigidPose(new(x, .1f, 0)), default));
            Assert.Equal(target == two ? 1 : 0, Sweep(new Sphere(.2f), new RigidPose(new(x, -.1f, 0)), default).Count);
            // Along its plane, at an edge.
            Assert.Single(Sweep(new Sphere(.2f), new RigidPose(new(x, 0, -4)), new Vector3(0, 0, 4)));
        }
    }

    [Fact]
    public void What_is_inside_of_a_solid_mesh_hits_it_at_zero()
    {
        var triangles = new List<Triangle>();
        foreach (var axis in new[] { 0, 1, 2 })
        {
            foreach (var side in new[] { -1f, 1f })
            {
                Vector3 Corner(float u, float v) => axis switch { 0 => new(side, u, v), 1 => new(v, side, u), _ => new(u, v, side) };
                Vector3 a = Corner(-1, -1), b = Corner(1, -1), c = Corner(1, 1), d = Corner(-1, 1);
                if (side < 0)
                    (b, d) = (d, b);
                triangles.AddRange([new(a, c, b), new(a, d, c)]);
            }
        }
        var mesh = new Mesh(triangles.ToArray().AsSpan(), Vector3.One, world.Pool) { Solid = true };
        world.Statics.Add(new StaticDescription(new RigidPose(new(3, 0, 0)), world.Simulation.Shapes.Add(mesh)));

        Assert.True(Assert.Single(Sweep(new Sphere(.1f), new RigidPose(new(3.2f, 0, 0)), new Vector3(9, 0, 0))).Overlaps);
        var hit = Assert.Single(Sweep(new Sphere(.1f), RigidPose.Identity, new Vector3(9, .1f, 0)));
        AssertNear(-Vector3.UnitX, hit.Normal, 1e-5f);
        Assert.InRange(hit.T, 1.9f / 9 - 1e-5f, 1.9f / 9);
        mesh.Dispose(world.Pool);
    }

    [Fact]
    public void Everything_stands_still_for_a_sweep()
    {
        var body = world.AddDynamic(new Sphere(1), 1, new RigidPose(new(5, 0, 0)), new BodyVelocity(new(100, 0, 0), new(0, 50, 0)));

        var hit = Assert.Single(Sweep(new Sphere(1), RigidPose.Identity, new Vector3(6, 0, 0)));

        Assert.Equal(body, hit.Collidable.BodyHandle);
        Assert.InRange(hit.T, .5f - Touching, .5f);
    }

    [Fact]
    public void A_sweep_may_go_on_for_ever()
    {
        world.AddStatic(new Sphere(1), new RigidPose(new(1e6f, .3f, 0)));

        var hit = Assert.Single(Sweep(new Box(1, 1, 1), RigidPose.Identity, new Vector3(1, 0, 0), float.PositiveInfinity));
        Assert.InRange(hit.T, 1e6f - 1.6f, 1e6f - 1.4f);
        Assert.Empty(Sweep(new Box(1, 1, 1), RigidPose.Identity, new BodyVelocity(new(-1, 0, 0), new(1, 2, 3)), float.PositiveInfinity));
    }

    [Fact]
    public void What_spins_fast_and_comes_slowly_hits_with_what_its_turn_makes_of_it()
    {
        world.AddStatic(new Box(1, 9, 9), new RigidPose(new(3, 0, 0)));
        var radius = MathF.Sqrt(.5f);

        foreach (var tilt in new[] { 0, .3f })
        {
            var hit = Assert.Single(Sweep(new Box(1, 1, 1), RigidPose.Identity, new BodyVelocity(new(.01f, tilt * .01f, 0), new(0, 100, 0)),
                float.PositiveInfinity));
            // At the latest when the wall is as near as a corner comes, at the earliest a turn before: .06 s, less than a millimetre.
            Assert.InRange(hit.T, (2.5f - radius) / .01f - .1f, (2.5f - radius) / .01f + .1f);
        }
        var beside = new RigidPose(new(2.5f - radius - 1e-3f, 0, 0));
        Assert.Empty(Sweep(new Box(1, 1, 1), beside, new BodyVelocity(default, new(0, 100, 0)), float.PositiveInfinity));
    }

    [Fact]
    public void Layers_choose_what_a_sweep_meets()
    {
        var near = world.AddStatic(new Sphere(1), new RigidPose(new(4, 0, 0)));
        var far = world.AddStatic(new Sphere(1), new RigidPose(new(8, 0, 0)));
        world.Simulation.Layers[near] = new CollisionLayers(1, uint.MaxValue);
        var hits = new List<SweptHit>();
        var handler = new SweepHits(hits);

        world.Simulation.Sweep(new Sphere(.5f), RigidPose.Identity, new Vector3(10, 0, 0), 1,
            new CollisionLayers(uint.MaxValue, ~1u), world.Pool, ref handler);

        Assert.Equal(far, Assert.Single(hits).Collidable.StaticHandle);
    }

    [Fact]
    public void The_parameters_of_accuracy_do_what_they_say()
    {
        world.AddStatic(new Box(.1f, 4, 4), new RigidPose(new(5, 0, 0)));
        var start = RigidPose.Identity;
        var fast = new Vector3(10, 0, 0);
        var exact = Assert.Single(Sweep(new Sphere(.5f), start, fast)).T;

        Assert.Equal(exact, Assert.Single(SweepExactly(new Sphere(.5f), start, fast, 0, 0, 1024)).T);
        // One round looks at the start alone.
        Assert.Empty(SweepExactly(new Sphere(.5f), start with { Position = new(4.2f, 0, 0) }, fast, 0, 0, 1));
        // A round of a fifth of a second begins before the wall, and ends in it or behind it.
        var rounded = SweepExactly(new Sphere(.5f), start, new Vector3(10, 1, 0), .02f, 0, 100);
        Assert.InRange(Assert.Single(rounded).T, exact - .021f, exact + 1e-6f);
        // Corners and faces, which have no distance once they overlap.
        var box = new Box(.6f, .6f, .6f);
        var exactBox = Assert.Single(Sweep(box, start, fast)).T;
        var roundedBox = Assert.Single(SweepExactly(box, start, new BodyVelocity(fast, new(0, .1f, 0)), .02f, 0, 100));
        Assert.InRange(roundedBox.T, exactBox - .025f, exactBox + 1e-3f);
        Assert.InRange(roundedBox.Normal.X, -1, -.99f);
        // A tenth of a second of the way counts as touching.
        Assert.InRange(Assert.Single(SweepExactly(new Sphere(.5f), start, fast, 0, .1f, 1024)).T, exact - .1f, exact);
        // What some divide by a speed of zero.
        Assert.Empty(SweepExactly(new Sphere(.5f), start, default, float.PositiveInfinity, float.PositiveInfinity, 25));
        Assert.Single(SweepExactly(new Sphere(.5f), start, fast, 0, float.PositiveInfinity, 25));
    }

    [Theory]
    [InlineData(float.NaN)]
    [InlineData(-1)]
    public void A_length_that_is_none_is_refused(float length) => AssertRefused<ArgumentOutOfRangeException>(
        "maximumT", handler => world.Simulation.Sweep(new Sphere(1), RigidPose.Identity, default, length, world.Pool, ref handler));

    [Fact]
    public void Bad_input_is_refused_by_name()
    {
        var good = RigidPose.Identity;
        var simulation = world.Simulation;
        AssertRefused<ArgumentException>("position", h => simulation.Sweep(new Sphere(1), new RigidPose(new(float.NaN, 0, 0)), default, 1, world.Pool, ref h));
        AssertRefused<ArgumentException>("orientation", h => simulation.Sweep(new Sphere(1), new RigidPose(default, default), default, 1, world.Pool, ref h));
        AssertRefused<ArgumentException>(
            "linear velocity", h => simulation.Sweep(new Sphere(1), good, new Vector3(float.PositiveInfinity, 0, 0), 1, world.Pool, ref h));
        AssertRefused<ArgumentException>(
            "angular velocity", h => simulation.Sweep(new Sphere(1), good, new BodyVelocity(default, new(0, float.NaN, 0)), 1, world.Pool, ref h));
        AssertRefused<ArgumentNullException>("pool", h => simulation.Sweep(new Sphere(1), good, default, 1, null!, ref h));
        AssertRefused<ArgumentException>("Radius", h => simulation.Sweep(new Sphere(0), good, default, 1, world.Pool, ref h));
        AssertRefused<ArgumentException>("HalfSpace", h => simulation.Sweep(new HalfSpace(Vector3.UnitY), good, default, 1, world.Pool, ref h));
        AssertRefused<ArgumentException>("Data", h => simulation.Sweep(default(ConvexHull), good, default, 1, world.Pool, ref h));
        AssertRefused<ArgumentException>("minimumProgression", h => simulation.Sweep(new Sphere(1), good, default, 1, world.Pool, ref h, float.NaN, 0, 1));
        AssertRefused<ArgumentException>("convergenceThreshold", h => simulation.Sweep(new Sphere(1), good, default, 1, world.Pool, ref h, 0, -1, 1));
        AssertRefused<ArgumentException>("maximumIterationCount", h => simulation.Sweep(new Sphere(1), good, default, 1, world.Pool, ref h, 0, 0, 0));
    }

    void AssertRefused<TException>(string word, Action<SweepHits> sweep) where TException : ArgumentException
    {
        var hits = new List<SweptHit>();
        world.AddStatic(new Sphere(1), RigidPose.Identity);
        var hash = world.Simulation.StateHash();
        var refusal = Assert.ThrowsAny<TException>(() => sweep(new SweepHits(hits)));
        Assert.Contains(word, refusal.Message + refusal.ParamName, StringComparison.Ordinal);
        Assert.Empty(hits);
        Assert.Equal(hash, world.Simulation.StateHash());
        // The world can be asked, and changed, as before.
        Assert.NotEmpty(Sweep(new Sphere(1), RigidPose.Identity, default));
        world.Step();
    }

    struct Thrower : ISweepHitHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => throw new NotSupportedException();

        public readonly void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable) { }

        public readonly void OnHitAtZeroT(ref float maximumT, CollidableReference collidable) { }
    }

    [Fact]
    public void A_handler_that_throws_leaves_no_memory_behind()
    {
        world.Pool.Take<CompoundChild>(2, out var children);
        children[0] = children[1] = new(RigidPose.Identity, world.Simulation.Shapes.Add(new Sphere(1)));
        world.Statics.Add(new StaticDescription(new RigidPose(new(3, 0, 0)), world.Simulation.Shapes.Add(new Compound(children))));
        var handler = new Thrower();
        Assert.Throws<NotSupportedException>(() => world.Simulation.Sweep(new Sphere(1), RigidPose.Identity, new Vector3(5, 0, 0), 1, world.Pool, ref handler));
        world.Step();
        // The end of the world looks whether everything came back but these.
        world.Pool.Return(ref children);
    }
}
