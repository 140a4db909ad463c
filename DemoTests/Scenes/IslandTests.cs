using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Islands against a walk along the constraints of each body.</summary>
public class IslandTests
{
    [Theory]
    [InlineData(11)]
    [InlineData(12)]
    [InlineData(13)]
    public void Islands_are_the_bodies_that_constraints_connect(int seed)
    {
        using var scramble = new Scramble(seed, threads: 1, sizes: null);
        var counts = new HashSet<int>();
        for (int round = 0; round < 200; ++round)
        {
            scramble.Round();
            var expected = Walk(scramble.Simulation);
            Assert.Equal(expected, Find(scramble.Simulation));
            counts.Add(expected.Count);
        }
        Assert.True(counts.Count > 5, "The scene has hardly changed.");
    }

    /// <summary>After each single edit, with part of the bodies asleep: those that sleep as one island, and those that would.</summary>
    [Fact]
    public void After_each_of_a_thousand_edits_islands_are_what_a_walk_finds()
    {
        using var scramble = new Scramble(seed: 31, threads: 1, sizes: null, sleeps: true);
        var (most, asleep, awake) = (0, 0, 0);
        for (int edit = 0; edit < 1000; ++edit)
        {
            // Long enough without one, now and then, for what rests to sleep.
            for (int step = edit % 20 == 0 ? 12 : edit % 2; step > 0; --step)
                scramble.Step();
            scramble.Change();
            var expected = Walk(scramble);
            var active = Find(scramble.Simulation);
            var sleeping = FindSleeping(scramble);
            Assert.Equal(expected, active.Concat(sleeping).OrderBy(island => scramble.Bodies.First(body => body.Value == island[0]).Slot));
            most = Math.Max(most, expected.Max(island => island.Length));
            asleep += sleeping.Count;
            awake += active.Count;
        }
        Assert.True(most > 5 && asleep > 500 && awake > 5000, $"at most {most} bodies in an island; {asleep} asleep, {awake} awake");
    }

    // The bodies that sleep, by the island that each was put into.
    static List<int[]> FindSleeping(Scramble scramble)
    {
        var bodies = scramble.Simulation.Bodies;
        return [.. scramble.Bodies
            .Where(body => bodies.IsAsleep(body.Slot) && !bodies[body].Kinematic)
            .GroupBy(body => bodies.Asleep.Islands[bodies.Locations[body.Slot].Index])
            .Select(island => island.OrderBy(body => body.Slot).Select(body => body.Value).ToArray())];
    }

    // By the joints that the scramble knows of and the contacts that each body has, wherever it is.
    static List<int[]> Walk(Scramble scramble)
    {
        var bodies = scramble.Simulation.Bodies;
        var joined = scramble.Bodies.ToDictionary(body => body, _ => new List<BodyHandle>());
        foreach (var (a, b) in scramble.Joined)
        {
            joined[a].Add(b);
            joined[b].Add(a);
        }
        return Walk(scramble.Bodies.Where(body => !bodies[body].Kinematic), body =>
        {
            var open = new Queue<BodyHandle>(joined[body]);
            var neighbours = new Neighbours { Found = open };
            bodies.EnumerateConnectedBodies(body, ref neighbours);
            return open;
        });
    }

    [Fact]
    public void Neither_statics_nor_kinematics_connect()
    {
        using var world = new TestWorld();
        var post = world.AddKinematic(new Sphere(.1f), new RigidPose(new Vector3(0, 5, 0)));
        var arms = Enumerable.Range(0, 4).Select(i => world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(i, 3, 0)))).ToArray();
        foreach (var arm in arms)
            world.Solver.Add(post, arm, new BallSocket { LocalOffsetB = Vector3.UnitY, SpringSettings = new(30, 1) });
        Assert.Equal(4, Find(world.Simulation).Count);

        var bridge = world.Solver.Add(arms[3], arms[1], new BallSocket { SpringSettings = new(30, 1) });

        Assert.Equal(
            [[arms[0].Value], [arms[1].Value, arms[3].Value], [arms[2].Value]], Find(world.Simulation));
        world.Solver.Remove(bridge);
        world.Bodies[post].SetLocalInertia(new Sphere(.1f).ComputeInertia(1));
        Assert.Single(Find(world.Simulation));
    }

    [Fact]
    public void A_world_without_bodies_has_no_island()
    {
        using var world = new TestWorld();
        Assert.Empty(Find(world.Simulation));
    }

    // Values of the bodies' handles, island after island, as if all of them might sleep.
    static List<int[]> Find(Simulation simulation)
    {
        ref var set = ref simulation.Bodies.ActiveSet;
        simulation.BufferPool.Take<RestKind>(System.Math.Max(1, set.Count), out var kinds);
        for (int i = 0; i < set.Count; ++i)
            kinds[i] = Bodies.IsKinematic(set.LocalInertias[i]) ? RestKind.Fixed : RestKind.Rests;
        var islands = new IslandSearch(simulation.Bodies, simulation.Solver, kinds, simulation.BufferPool);
        simulation.BufferPool.Return(ref kinds);
        var found = new List<int[]>();
        for (int i = 0; i < islands.Count; ++i)
            found.Add([.. islands.SlotsOf(i).ToArray().Select(slot => simulation.Bodies.HandleAt(slot).Value)]);
        islands.Dispose(simulation.BufferPool);
        return found;
    }

    static List<int[]> Walk(Simulation simulation)
    {
        var bodies = simulation.Bodies;
        var all = Enumerable.Range(0, bodies.ActiveSet.Count).Select(i => bodies.ActiveSet.IndexToHandle[i]);
        return Walk(all.Where(body => !bodies[body].Kinematic), body =>
        {
            var neighbours = new Neighbours { Found = new() };
            bodies.EnumerateConnectedBodies(body, ref neighbours);
            return neighbours.Found;
        });
    }

    // Depth first; a neighbour that is none of the bodies ends the way.
    static List<int[]> Walk(IEnumerable<BodyHandle> bodies, Func<BodyHandle, IEnumerable<BodyHandle>> neighboursOf)
    {
        var left = new SortedDictionary<int, BodyHandle>(bodies.ToDictionary(body => body.Slot));
        var islands = new List<int[]>();
        while (left.Count > 0)
        {
            var island = new SortedDictionary<int, BodyHandle>();
            var open = new Stack<BodyHandle>([left.First().Value]);
            while (open.TryPop(out var body))
            {
                if (!left.Remove(body.Slot))
                    continue;
                island.Add(body.Slot, body);
                foreach (var neighbour in neighboursOf(body))
                    open.Push(neighbour);
            }
            islands.Add([.. island.Values.Select(body => body.Value)]);
        }
        return islands;
    }

    struct Neighbours : IForEach<BodyHandle>
    {
        public Queue<BodyHandle> Found;

        public readonly void LoopBody(BodyHandle body) => Found.Enqueue(body);
    }
}
