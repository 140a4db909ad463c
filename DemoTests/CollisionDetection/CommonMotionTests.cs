using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What moves along with a kinematic body looks as far ahead for contacts as it would at rest, unless it may meet something that does not.</summary>
public class CommonMotionTests
{
    const float Dt = 1 / 64f;

    // What it is, where, and how it moves relative to the floor.
    static readonly (Vector3 Place, Vector3 Velocity, Vector3 Spin)[] passengers =
    [
        (new(0, 0.5f, 0), default, default), (new(0, 1.5f, 0), default, default),
        (new(6, 0.5f, 3), new(2, 0, -1), new(0, 3, 1)),
        // On each other.
        (new(-8, 0.5f, 0), new(0, 0, 1), default), (new(-8, 1.6f, 0), new(0, -6, 0), new(1, 0, 0)),
    ];

    public static TheoryData<float, float, float> Velocities() =>
        new() { { 30, 0, 0 }, { 0, 0, 300 }, { 0, -7, 0 }, { 0, 20, 0 }, { -3, 5, 100 } };

    [Theory, MemberData(nameof(Velocities))]
    public void Passengers_have_the_margins_that_they_have_at_rest(float x, float y, float z)
    {
        using var still = new World();
        using var train = new World();
        still.AddFloor(default);
        train.AddFloor(new Vector3(x, y, z));
        AddPassengers(still, default);
        AddPassengers(train, new Vector3(x, y, z));
        still.Step();
        train.Step();
        // Speeds are rounded to a part in 2^24 of the greatest; a length has some roundings.
        var rounding = 8 * train.Margins().Length * new Vector3(x, y, z).Length() * Dt / (1 << 24) + 1e-7f;
        Assert.All(still.Margins().Zip(train.Margins()), margins => Assert.Equal(margins.First, margins.Second, rounding));
    }

    /// <summary>As many contacts in all steps after it has landed, however many bounds overlap at the speed of the train.</summary>
    [Theory, MemberData(nameof(Velocities))]
    public void Passengers_have_the_contacts_that_they_have_at_rest(float x, float y, float z)
    {
        using var still = new World();
        using var train = new World();
        foreach (var (world, velocity) in new[] { (still, Vector3.Zero), (train, new Vector3(x, y, z)) })
        {
            world.AddFloor(velocity);
            for (int i = 0; i < 25; ++i)
                world.Add(new Vector3(2 * (i % 5), 0.5f + 0.7f * (i % 3), 2 * (i / 5)), velocity, default);
        }
        int atRest = 0, inTrain = 0;
        for (int i = 0; i < 64; ++i)
        {
            still.Step();
            train.Step();
            // What falls is by itself for half a second, and sees those beside it.
            if (i < 40)
                continue;
            atRest += still.CountContacts();
            inTrain += train.CountContacts();
        }
        // Of what lands, a rounding may decide on the step.
        Assert.InRange(inTrain, atRest - 25, atRest + 25);
        Assert.InRange(atRest, 25 * 20, int.MaxValue);
    }

    [Fact]
    public void Who_turns_with_a_train_in_a_bend_looks_no_farther_than_at_rest()
    {
        var turn = new Vector3(0, 1.5f, 0);
        var velocity = new Vector3(30, 0, 0);
        using var still = new World();
        using var table = new World();
        still.AddFloor(default);
        table.AddFloor(velocity, turn);
        foreach (var place in new Vector3[] { new(0, 0.5f, 0), new(2, 0.5f, 1), new(2, 1.5f, 1), new(-7, 0.5f, 4) })
        {
            still.Add(place, default, default);
            table.Add(place, velocity + Vector3.Cross(turn, place), turn);
        }
        still.Step();
        table.Step();
        Assert.All(still.Margins().Zip(table.Margins()), margins => Assert.Equal(margins.First, margins.Second, 1e-5f));
    }

    /// <summary>
    /// The lowest of a column that falls along with a platform that it touches will be stopped by the ground within the step, and by it all others: they look
    /// as far ahead as without the platform, as soon as the ground is in reach, and not before.
    /// </summary>
    [Theory, InlineData(0.1f, false), InlineData(3f, true)]
    public void Who_may_meet_the_ground_looks_ahead_by_all_that_he_moves(float gap, bool movesAlong)
    {
        var fall = new Vector3(0, -10, 0);
        float[] Margins(bool hasPlatform)
        {
            using var world = new World();
            world.AddGround(new Box(30, 1, 30), new Vector3(0, -0.5f, 0));
            if (hasPlatform)
                world.AddPlatform(new Vector3(0.995f, 20, 0), new Vector3(1, 30, 1), fall);
            for (int i = 0; i < 6; ++i)
                world.Add(new Vector3(0, 0.5f + gap + 1.05f * i, 0), fall, default);
            world.Step();
            return world.Margins();
        }

        var alone = Margins(false);
        Assert.All(alone, margin => Assert.InRange(margin, 10 * Dt, 11 * Dt));
        if (movesAlong)
            Assert.All(Margins(true), margin => Assert.InRange(margin, 0, World.Gravity * Dt * Dt * 1.001f));
        else
            Assert.Equal(alone, Margins(true));
    }

    /// <summary>What meets nobody that moves along has the margins that it has where there is no such body in the world, to the last bit.</summary>
    [Fact]
    public void Who_is_by_himself_knows_nothing_of_platforms()
    {
        float[] Margins(bool hasPlatform)
        {
            using var world = new World();
            for (int i = 0; i < 6; ++i)
                world.Add(new Vector3(0, 30 + 1.05f * i, 0), new Vector3(0, -10, i), default);
            if (hasPlatform)
                world.AddPlatform(new Vector3(100, 30, 0), new Vector3(1, 30, 1), new Vector3(0, -10, 0));
            world.Step();
            return world.Margins()[..6];
        }

        Assert.Equal(Margins(false), Margins(true));
    }

    /// <summary>Of a landscape only the triangles that are near are in the way, and a sensor is in nobody's.</summary>
    [Theory, InlineData(-3, false, true), InlineData(-0.1f, false, false), InlineData(-0.1f, true, true)]
    public void Only_what_can_stop_a_passenger_counts(float height, bool isSensor, bool movesAlong)
    {
        using var world = new World();
        var velocity = new Vector3(30, 0, 0);
        world.AddFloor(velocity);
        world.Add(new Vector3(0, 0.5f, 25), velocity, default);
        world.Add(new Vector3(0, 0.5f, 0), velocity, default);
        // A slope that is as high as the train goes somewhere, far away from it.
        world.AddSlope(height, isSensor);
        world.Step();
        Assert.InRange(world.Margins()[0], 0, movesAlong ? 0.01f : 1);
        if (!movesAlong)
            Assert.InRange(world.Margins()[0], 29 * Dt, 31 * Dt);
        Assert.InRange(world.Margins()[1], 0, 0.01f);
    }

    [Fact]
    public void Threads_and_restoring_do_not_change_a_bit()
    {
        static World Create(int threads)
        {
            var world = new World(threads);
            world.AddFloor(new Vector3(20, 0, 5));
            for (int i = 0; i < 1500; ++i)
                world.Add(new Vector3(1.2f * (i % 10), 1 + 1.1f * (i / 100), 1.2f * (i / 10 % 10)), new Vector3(20, 0, 5), new Vector3(i % 7, i % 3, 0));
            return world;
        }

        using var one = Create(1);
        one.Run(8);
        using var snapshotPool = new BufferPool();
        using var snapshot = new SimulationSnapshot(snapshotPool);
        one.Simulation.Save(snapshot);
        one.Run(8);
        var expected = one.Simulation.StateHash();
        one.Simulation.Restore(snapshot);
        one.Run(8);
        Assert.Equal(expected, one.Simulation.StateHash());
        using var many = Create(3);
        many.Run(16);
        Assert.Equal(expected, many.Simulation.StateHash());
    }

    [Fact]
    public void A_step_makes_no_garbage()
    {
        using var world = new World();
        world.AddFloor(new Vector3(20, 0, 5));
        AddPassengers(world, new Vector3(20, 0, 5));
        world.Run(30);
        Assert.Equal(0, Garbage.Of(() => world.Run(30)));
    }

    /// <summary>Bodies that come and go between prediction and detection belong to nobody's surroundings.</summary>
    [Fact]
    public void Bodies_may_come_and_go_before_detection()
    {
        using var world = new World();
        world.AddFloor(new Vector3(20, 0, 5));
        AddPassengers(world, new Vector3(20, 0, 5));
        world.Run(3);
        world.Simulation.PredictBoundingBoxes(Dt);
        world.RemoveFirst();
        world.Add(new Vector3(0, 3, 0), new Vector3(20, 0, 5), default);
        world.Simulation.CollisionDetection(Dt);
        world.Simulation.Solve(Dt);
        world.Simulation.Validate();
        world.Run(3);
    }

    static void AddPassengers(World world, Vector3 velocity)
    {
        foreach (var (place, own, spin) in passengers)
            world.Add(place, own + velocity, spin);
    }

    sealed class World : IDisposable
    {
        public const float Gravity = 9.81f;
        readonly BufferPool pool = new();
        readonly IThreadDispatcher? dispatcher;
        readonly List<BodyHandle> bodies = [];
        TypedIndex slope;

        public World(int threads = 1)
        {
            dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
            Simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)),
                SolveDescription.Default);
        }

        public Simulation Simulation { get; }

        /// <summary>Adds a floor whose top is at y = 0.</summary>
        public void AddFloor(Vector3 velocity, Vector3 turn = default) => Simulation.Bodies.Add(BodyDescription.CreateKinematic(
            new Vector3(0, -0.25f, 0), new BodyVelocity(velocity, turn), Simulation.Shapes.Add(new Box(60, 0.5f, 60)), -1));

        public void AddPlatform(Vector3 place, Vector3 size, Vector3 velocity) => Simulation.Bodies.Add(BodyDescription.CreateKinematic(
            place, new BodyVelocity(velocity), Simulation.Shapes.Add(new Box(size.X, size.Y, size.Z)), -1));

        public void AddGround(Box box, Vector3 place) => Simulation.Statics.Add(new StaticDescription(place, Simulation.Shapes.Add(box)));

        public void AddSlope(float height, bool isSensor)
        {
            pool.Take<Triangle>(2, out var triangles);
            triangles[0] = new(new(-50, height, 20), new(50, height, 20), new(-50, height + 0.5f, 40));
            triangles[1] = new(new(-50, height, -400), new(50, height, -400), new(-50, 50, -500));
            slope = Simulation.Shapes.Add(new Mesh(triangles, Vector3.One, pool));
            var handle = Simulation.Statics.Add(new StaticDescription(Vector3.Zero, slope));
            if (isSensor)
                Simulation.Events.SetSensor(new CollidableReference(handle), true);
        }

        /// <summary>Adds a unit box.</summary>
        public void Add(Vector3 place, Vector3 velocity, Vector3 spin)
        {
            var box = new Box(1, 1, 1);
            bodies.Add(Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                place, new BodyVelocity(velocity, spin), box.ComputeInertia(1), Simulation.Shapes.Add(box), -1)));
        }

        public void RemoveFirst()
        {
            Simulation.Bodies.Remove(bodies[0]);
            bodies.RemoveAt(0);
        }

        public void Step() => Simulation.Timestep(Dt, dispatcher);

        public void Run(int steps)
        {
            for (int i = 0; i < steps; ++i)
                Step();
        }

        public float[] Margins() => [.. bodies.Select(body => Simulation.Bodies[body].Collidable.SpeculativeMargin)];

        public int CountContacts() => bodies.Sum(body => Simulation.Bodies[body].Constraints.Count);

        public void Dispose()
        {
            Simulation.Statics.Clear();
            if (slope.Exists)
                Simulation.Shapes.RemoveAndDispose(slope, pool);
            Simulation.Dispose();
            (dispatcher as IDisposable)?.Dispose();
            pool.AssertEmpty();
            pool.Clear();
        }
    }
}
