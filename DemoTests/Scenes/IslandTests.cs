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
        var islands = new IslandSearch(simulation.Bodies, simulation.Solver, kinds, int.MaxValue, simulation.BufferPool);
        simulation.BufferPool.Return(ref kinds);
        var found = new List<int[]>();
        for (int i = 0; i < islands.Count; ++i)
            found.Add([.. islands.SlotsOf(i).ToArray().Select(slot => simulation.Bodies.HandleAt(slot).Value)]);
        islands.Dispose(simulation.BufferPool);
        return found;
    }

    static List<int[]> Walk(Simulation simulation)
    {
        var left = new SortedDictionary<int, BodyHandle>();
        for (int i = 0; i < simulation.Bodies.ActiveSet.Count; ++i)
        {
            var handle = simulation.Bodies.ActiveSet.IndexToHandle[i];
            if (!simulation.Bodies[handle].Kinematic)
                left.Add(handle.Slot, handle);
        }
        var islands = new List<int[]>();
        while (left.Count > 0)
        {
            var island = new SortedDictionary<int, BodyHandle>();
            var open = new Queue<BodyHandle>([left.First().Value]);
            while (open.TryDequeue(out var body))
            {
                if (!left.Remove(body.Slot))
                    continue;
                island.Add(body.Slot, body);
                var neighbours = new Neighbours { Found = open };
                simulation.Bodies.EnumerateConnectedBodies(body, ref neighbours);
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
