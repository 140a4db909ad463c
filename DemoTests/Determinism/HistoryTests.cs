using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>What was removed, one by one or all at once, changes nothing of what comes after it.</summary>
public class HistoryTests
{
    const int Steps = 30;

    public static TheoryData<int, Ingredients> Cases()
    {
        var cases = new TheoryData<int, Ingredients>();
        for (int seed = 1; seed <= 24; ++seed)
            cases.Add(seed, seed % 4 == 0 ? Ingredients.All : seed % 4 == 1 ? Ingredients.Contacts | Ingredients.Joints :
                seed % 4 == 2 ? Ingredients.Joints | Ingredients.Hub : Ingredients.Contacts);
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_cleared_simulation_gives_the_bits_of_a_new_one(int seed, Ingredients ingredients)
    {
        var scene = new RandomScene(seed, ingredients);
        using var world = new TestWorld();
        new RandomScene(seed + 1000, Ingredients.All, 40).AddTo(world);
        for (int i = 0; i < 10; ++i)
            world.Step(i % 3 == 0 ? 1 / 30f : TestWorld.Dt);
        world.Simulation.Clear();
        Assert.Equal(Fresh(scene), Run(world, scene));
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void What_was_removed_one_by_one_leaves_the_bits_of_a_new_simulation(int seed, Ingredients ingredients)
    {
        var scene = new RandomScene(seed, ingredients);
        using var world = new TestWorld();
        var churn = new Churn(world, seed);
        churn.Run(120);
        churn.RemoveAll();
        Assert.Equal(Fresh(scene), Run(world, scene));
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void Joints_that_come_and_go_between_steps_change_nothing(int seed, Ingredients ingredients)
    {
        var scene = new RandomScene(seed, ingredients);
        using var world = new TestWorld();
        var random = new Random(seed);
        var handles = scene.AddTo(world);
        var hashes = new List<ulong>();
        for (int step = 0; step < Steps; ++step)
        {
            // Also more than there are batches on one body, so that there is a fallback batch, of several types.
            var guests = new List<ConstraintHandle>();
            int count = random.Next(3) == 0 ? 80 : random.Next(12);
            for (int i = 0; i < count; ++i)
            {
                if (RandomScene.Add(world.Solver, random.Next(7), handles[0], handles[1 + random.Next(handles.Count - 1)], Vector3.One) is { } guest)
                    guests.Add(guest);
            }
            foreach (var guest in guests.OrderBy(_ => random.Next()))
                world.Solver.Remove(guest);
            world.Step();
            hashes.Add(world.Simulation.StateHash());
        }
        world.Simulation.Validate();
        Assert.Equal(Fresh(scene), hashes);
    }

    [Fact]
    public void Nine_ball_sockets_that_were_removed_change_nothing()
    {
        var scene = new RandomScene(3, Ingredients.Joints);
        using var world = new TestWorld();
        var handles = scene.AddTo(world);
        var guests = Enumerable.Range(1, 9).Select(i => RandomScene.Add(world.Solver, 0, handles[0], handles[i], Vector3.One)).ToList();
        foreach (var guest in guests)
            if (guest is { } handle)
                world.Solver.Remove(handle);
        Assert.Equal(Fresh(scene), world.HashSteps(Steps));
    }

    static List<ulong> Fresh(RandomScene scene)
    {
        using var world = new TestWorld();
        return Run(world, scene);
    }

    static List<ulong> Run(TestWorld world, RandomScene scene)
    {
        scene.AddTo(world);
        return world.HashSteps(Steps);
    }

    // Adds, removes and steps at random, with hubs and fast bodies among what comes and goes.
    sealed class Churn(TestWorld world, int seed)
    {
        readonly Random random = new(seed);
        readonly List<BodyHandle> bodies = [];
        readonly List<ConstraintHandle> joints = [];

        public void Run(int rounds)
        {
            for (int i = 0; i < rounds; ++i)
            {
                switch (random.Next(6))
                {
                    case 0 or 1:
                        bodies.Add(world.Bodies.Add(RandomScene.AnyBody(random)));
                        break;
                    case 2:
                        AddJoints(random.Next(12) == 0 ? 75 : random.Next(10));
                        break;
                    case 3:
                        if (bodies.Count > 0)
                            Remove(random.Next(bodies.Count));
                        break;
                    case 4:
                        RemoveJoints();
                        break;
                    default:
                        world.Step();
                        break;
                }
            }
        }

        // Leaves what a new simulation has: handles are handed out in the order of their values again.
        public void RemoveAll()
        {
            while (bodies.Count > 0)
                Remove(random.Next(bodies.Count));
            int values = world.Bodies.HandlePool.HighestPossiblyClaimedId + 1;
            for (int i = 0; i < values; ++i)
                bodies.Add(world.Bodies.Add(RandomScene.AnyBody(random)));
            foreach (var body in bodies.OrderByDescending(body => body.Slot))
                world.Bodies.Remove(body);
            Assert.Equal(0, world.Solver.CountConstraints());
            world.Simulation.Validate();
            // In an empty world, so that nothing is left to be drawn.
            world.Step();
        }

        void AddJoints(int count)
        {
            if (bodies.Count < 2)
                return;
            var hub = bodies[random.Next(bodies.Count)];
            for (int i = 0; i < count; ++i)
            {
                if (RandomScene.Add(world.Solver, random.Next(7), hub, bodies[random.Next(bodies.Count)], Vector3.UnitX) is { } joint)
                    joints.Add(joint);
            }
        }

        void Remove(int index)
        {
            world.Bodies.Remove(bodies[index]);
            bodies.RemoveAt(index);
            joints.RemoveAll(joint => !world.Solver.ConstraintExists(joint));
        }

        void RemoveJoints()
        {
            for (int i = joints.Count / 2; i > 0; --i)
            {
                int index = random.Next(joints.Count);
                world.Solver.Remove(joints[index]);
                joints.RemoveAt(index);
            }
        }
    }
}
