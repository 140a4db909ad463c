using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.References;
using DemoTests.Quality;
using DemoTests.Scenes;
using DemoTests.Support;
using DemoTests.Trees;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Robustness;

/// <summary>Another origin changes where things are said to be, and nothing of what they do.</summary>
public class ShiftOriginTests(ITestOutputHelper output)
{
    // What a coordinate within a kilometre may be rounded by.
    const double Rounding = 1.0 / (1 << 14);

    static readonly Vector3[] shifts = [new(64, -32, 128), new(-3.7f, 11.1f, 0.3f), new(700, 0, -600), new(-760.3f, 20.9f, 471.7f)];

    /// <summary>A world with some of all there is: what rests, sleeps, moves, is carried, hangs, and is held in a place.</summary>
    sealed class World : IDisposable
    {
        readonly BufferPool pool = new();
        readonly ThreadDispatcher? dispatcher;
        readonly List<BodyHandle> bodies = [];

        public World(int threads = 1)
        {
            dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
            Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), SolveDescription.Default);
            AddTerrain();
            var box = Simulation.Shapes.Add(new Box(1, 1, 1));
            Simulation.Statics.Add(new StaticDescription(new Vector3(10, -0.5f, 0), Simulation.Shapes.Add(new Box(10, 1, 10))));
            for (int i = 0; i < 8; ++i)
                Add(new Vector3(8, 0.5f + i, 0), box);
            for (int i = 0; i < 3; ++i)
                Add(new Vector3(12, 0.5f + i, 2), box, sleepThreshold: 0.01f);
            Stack = bodies[0];
            Sleeper = bodies[^1];
            AddCompound();
            Platform = Simulation.Bodies.Add(BodyDescription.CreateKinematic(
                new Vector3(0, 3, -12), new BodyVelocity(new Vector3(0.5f, 0.25f, 0)), Simulation.Shapes.Add(new Box(3, 0.5f, 3)), -1));
            bodies.Add(Platform);
            Add(new Vector3(0, 3.75f, -12), box, new Vector3(0.5f, 0.25f, 0));
            var post = Simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(-10, 8, 0), Simulation.Shapes.Add(new Sphere(0.1f)), -1));
            bodies.Add(post);
            var bob = Add(new Vector3(-8, 8, 0), Simulation.Shapes.Add(new Sphere(0.3f)));
            Simulation.Solver.Add(post, bob, new BallSocket { LocalOffsetB = new Vector3(-2, 0, 0) });
            Held = Add(new Vector3(-5, 6, 5), Simulation.Shapes.Add(new Sphere(0.3f)));
            Grip = Simulation.Solver.Add(Held, new OneBodyLinearServo
            {
                Target = new Vector3(-5, 6, 5),
                ServoSettings = ServoSettings.Default,
            });
        }

        public Simulation Simulation { get; }

        public BodyHandle Stack { get; }

        public BodyHandle Sleeper { get; }

        public BodyHandle Platform { get; }

        public BodyHandle Held { get; }

        public ConstraintHandle Grip { get; }

        public Double3 Origin { get; private set; }

        public int Count => bodies.Count;

        BodyHandle Add(Vector3 position, TypedIndex shape, Vector3 velocity = default, float sleepThreshold = -1)
        {
            var body = Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                position, new BodyVelocity(velocity), new Box(1, 1, 1).ComputeInertia(1), shape, sleepThreshold));
            bodies.Add(body);
            return body;
        }

        void AddTerrain()
        {
            const int width = 12;
            pool.Take<Triangle>(2 * width * width, out var triangles);
            static Vector3 Corner(int x, int z) => new(2 * x - 30, 0.3f * MathF.Sin(x) * MathF.Cos(z) - 1, 2 * z - width);
            for (int i = 0; i < width * width; ++i)
            {
                var (x, z) = (i % width, i / width);
                triangles[2 * i] = new(Corner(x, z), Corner(x + 1, z), Corner(x, z + 1));
                triangles[2 * i + 1] = new(Corner(x + 1, z), Corner(x + 1, z + 1), Corner(x, z + 1));
            }
            Simulation.Statics.Add(new StaticDescription(Vector3.Zero, Simulation.Shapes.Add(new Mesh(triangles, Vector3.One, pool))));
            for (int i = 0; i < 5; ++i)
                Add(new Vector3(-20 + 2 * i, 1, 0), Simulation.Shapes.Add(new Box(1, 0.5f, 1)));
        }

        void AddCompound()
        {
            using var builder = new CompoundBuilder(pool, Simulation.Shapes, 2);
            builder.Add(new Box(2, 0.5f, 0.5f), RigidPose.Identity, 1);
            builder.Add(new Box(0.5f, 1, 0.5f), new RigidPose(new Vector3(0.7f, 0.75f, 0)), 1);
            builder.BuildDynamicCompound(out var children, out var inertia, out _);
            bodies.Add(Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new Vector3(10, 1, -3), inertia, Simulation.Shapes.Add(new Compound(children)), -1)));
        }

        public void Step(int count)
        {
            for (int i = 0; i < count; ++i)
                Simulation.Timestep(1 / 60f, dispatcher);
        }

        public void Shift(Vector3 shift)
        {
            Simulation.ShiftOrigin(shift);
            Origin += shift;
        }

        // Floats could not hold it.
        public Double3 Place(int body) => Simulation.Bodies[bodies[body]].Pose.Position + Origin;

        public double ImpulseOn(BodyHandle body)
        {
            var sum = default(SumOfImpulses);
            foreach (var constraint in Simulation.Bodies[body].Constraints)
                Simulation.Solver.EnumerateAccumulatedImpulses(constraint.ConnectingConstraintHandle, ref sum);
            return sum.Sum;
        }

        struct SumOfImpulses : IForEach<float>
        {
            public double Sum;

            public void LoopBody(float impulse) => Sum += Math.Abs(impulse);
        }

        public void Dispose()
        {
            Simulation.Dispose();
            dispatcher?.Dispose();
            pool.Clear();
        }
    }

    [Theory, InlineData(1), InlineData(3)]
    public void All_goes_on_as_without(int threads)
    {
        using World still = new(), shifted = new(threads);
        still.Step(120);
        shifted.Step(120);
        foreach (var shift in shifts)
        {
            shifted.Shift(shift);
            shifted.Simulation.Validate();
            still.Step(30);
            shifted.Step(30);
            shifted.Simulation.Validate();
            Assert.Equal(still.Simulation.Bodies.ActiveSet.Count, shifted.Simulation.Bodies.ActiveSet.Count);
            double most = 0;
            for (int i = 0; i < still.Count; ++i)
                most = Math.Max(most, (still.Place(i) - shifted.Place(i)).Length);
            output.WriteLine($"{shift}: {most:e2} m");
            // Who swings and who is carried adds up what its places are rounded by.
            Assert.InRange(most, 0, 20 * Rounding);
        }
    }

    [Fact]
    public void What_rests_keeps_its_impulses_and_what_sleeps_sleeps()
    {
        using var world = new World();
        world.Simulation.Events.Listen(world.Stack, EventMask.Begin | EventMask.End);
        world.Step(180);
        Assert.False(world.Simulation.Bodies[world.Sleeper].Awake);
        var before = world.ImpulseOn(world.Stack);
        foreach (var shift in shifts)
        {
            world.Shift(shift);
            Assert.Equal(before, world.ImpulseOn(world.Stack));
            world.Step(1);
            Assert.InRange(world.ImpulseOn(world.Stack) / before, 0.99, 1.01);
            Assert.False(world.Simulation.Bodies[world.Sleeper].Awake);
            Assert.True(world.Simulation.Events.Began.IsEmpty && world.Simulation.Events.Ended.IsEmpty);
            world.Step(10);
            before = world.ImpulseOn(world.Stack);
        }
    }

    static TestWorld WithoutGravity() => new(new AccuracySettings { Gravity = default });

    /// <summary>Far away a body that moves by less than its position can tell has moved once the origin comes near.</summary>
    [Theory, InlineData(0.01f), InlineData(-0.003f)]
    public void Nothing_that_a_body_has_moved_is_lost(float speed)
    {
        using var world = WithoutGravity();
        var far = new Vector3(1e6f, -3e5f, 2e6f);
        var body = world.Bodies[world.AddDynamic(new Sphere(1), 1, far, new BodyVelocity(new Vector3(speed)))];
        world.Step(60);
        Assert.Equal(far.X, body.Pose.Position.X);
        world.Simulation.ShiftOrigin(far);
        // There and back: what rounding takes on the way is kept as well.
        world.Simulation.ShiftOrigin(-far);
        world.Simulation.ShiftOrigin(far);
        Assert.InRange((body.Pose.Position - new Vector3(speed)).Length(), 0, 1e-5 * Math.Abs(speed));
        world.Step();
        Assert.InRange((body.Pose.Position - new Vector3(speed) * (61f / 60)).Length(), 0, 1e-5 * Math.Abs(speed));
    }

    [Fact]
    public void Rays_hit_at_once_and_servos_hold_where_they_held()
    {
        using var world = new World();
        world.Step(60);
        var shift = shifts[3];
        world.Shift(shift);
        foreach (var (place, height) in new[] { (new Vector3(8, 20, 0), 8f), (new Vector3(12, 20, 2), 3), (new Vector3(6, 20, 4), 0) })
        {
            var hit = new Lowest();
            world.Simulation.RayCast(place - shift, -Vector3.UnitY, 100, ref hit);
            Assert.Equal(height, 20 - hit.T, 1e-3f);
        }
        world.Simulation.Solver.GetDescription(world.Grip, out OneBodyLinearServo servo);
        Assert.Equal(new Vector3(-5, 6, 5) - shift, servo.Target);
        world.Step(60);
        Assert.InRange((world.Simulation.Bodies[world.Held].Pose.Position - servo.Target).Length(), 0, 2e-3);
    }

    struct Lowest : IRayHitHandler
    {
        public float T;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            T = maximumT = t;
    }

    [Fact]
    public void What_was_put_elsewhere_is_still_known_to_have_been()
    {
        using var world = new World();
        world.Step(10);
        var platform = world.Simulation.Bodies[world.Platform];
        world.Simulation.ShiftOrigin(shifts[0]);
        var (before, after) = (world.Simulation.Bodies.GetInterpolatedPose(world.Platform, 0).Position, platform.Pose.Position);
        Assert.InRange((after - before - new Vector3(0.5f, 0.25f, 0) / 60).Length(), 0, Rounding);
        platform.Pose.Position.X += 5;
        world.Simulation.ShiftOrigin(shifts[1]);
        Assert.Equal(platform.Pose.Position, world.Simulation.Bodies.GetInterpolatedPose(world.Platform, 0).Position);
    }

    /// <summary>The world of Docs/Guides/LargeWorlds.md: a rocket of 900 m/s flies 90 km and is where it should be, to rounding near the origin.</summary>
    [Fact]
    public void A_world_that_follows_its_player_is_exact_far_away()
    {
        using var world = WithoutGravity();
        var rocket = world.Bodies[world.AddDynamic(new Sphere(1), 1, Vector3.Zero, new BodyVelocity(new Vector3(900, 0, 0.01f)))];
        var follower = new DocSamples.LargeWorld(world.Simulation);
        const int steps = 6000;
        for (int i = 0; i < steps; ++i)
        {
            world.Step();
            follower.Follow(rocket.Pose.Position);
        }
        var place = rocket.Pose.Position;
        // Float seconds are a sixtieth to seven digits; the ways of substeps are rounded, too, by half of 1e-6 m in a step.
        var time = steps * (double)(1 / 60f);
        Assert.Equal(900 * time, follower.X + place.X, steps * 5e-7);
        Assert.Equal(0.01f * time, follower.Z + place.Z, 1e-6);
    }

    [Fact]
    public void A_shift_makes_no_garbage()
    {
        using var world = new World();
        world.Step(10);
        Assert.Equal(0, Garbage.Of(() => world.Simulation.ShiftOrigin(Vector3.One)));
    }

    [Theory]
    [InlineData(float.NaN, 0), InlineData(0, float.PositiveInfinity), InlineData(-2e9f, 0), InlineData(-9.999999e8f, 500)]
    public void What_cannot_be_is_refused_and_changes_nothing(float x, float y)
    {
        using var world = new World();
        world.Simulation.Bodies[world.Held].Pose.Position = new Vector3(600, 0, 0);
        var before = world.Simulation.StateHash();
        Assert.Throws<ArgumentException>("shift", () => world.Simulation.ShiftOrigin(new Vector3(x, y, 0)));
        Assert.Equal(before, world.Simulation.StateHash());
    }

    /// <summary>Boxes of trees contain what they contained, and are no larger than by a last bit.</summary>
    [Fact]
    public void Boxes_are_rounded_outwards()
    {
        var random = new Random(5);
        float Next(float most) => most * (2 * random.NextSingle() - 1);
        var boxes = Enumerable.Range(0, 300).Select(_ => new Vector3(Next(100), Next(1e4f), Next(1))).Select(
            min => new BoundingBox(min, min + new Vector3(random.NextSingle(), 1e-3f, 10)));
        using var model = new TreeModel(boxes);
        for (int round = 0; round < 20; ++round)
        {
            var before = Enumerable.Range(0, model.Boxes.Count).Select(leaf => BoundsOf(model, leaf)).ToArray();
            var shift = new Vector3(Next(1000), Next(1e5f), Next(0.1f));
            model.Tree.ShiftOrigin(shift);
            for (int leaf = 0; leaf < before.Length; ++leaf)
            {
                var after = BoundsOf(model, leaf);
                for (int axis = 0; axis < 3; ++axis)
                {
                    var (min, max) = ((double)before[leaf].Min[axis] - shift[axis], (double)before[leaf].Max[axis] - shift[axis]);
                    Assert.InRange(min, after.Min[axis], MathF.BitIncrement(after.Min[axis]));
                    Assert.InRange(max, MathF.BitDecrement(after.Max[axis]), after.Max[axis]);
                }
            }
            model.Tree.Validate();
        }
    }

    static unsafe BoundingBox BoundsOf(TreeModel model, int leaf)
    {
        model.Tree.GetBoundsPointers(leaf, out var min, out var max);
        return new(*min, *max);
    }
}
