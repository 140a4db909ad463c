using System;
using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Events and layers in scenes that have no use for them, and in scenes where everybody listens.</summary>
[Collection(AloneCollection.Name)]
public class UnusedListenersTests
{
    const string Pyramids = "pyramids";
    const string ShapePile = "shape-pile";

    static SceneDescription Load(string name) => name == Pyramids ? SmallScenes.Pyramids(4, 8) : SmallScenes.Pile(name, 6, 4);

    static void ForAll(Simulation simulation, Action<CollidableReference> action)
    {
        for (int i = 0; i < simulation.Bodies.ActiveSet.Count; ++i)
            action(simulation.Bodies[simulation.Bodies.ActiveSet.IndexToHandle[i]].CollidableReference);
        for (int i = 0; i < simulation.Statics.Count; ++i)
            action(simulation.Statics[simulation.Statics.IndexToHandle[i]].CollidableReference);
    }

    // Hashes, and bytes of the pools, after each step.
    static (List<ulong> Hashes, List<ulong> PoolBytes) Run(string name, int threads, Action<Simulation> prepare)
    {
        using var world = new SceneWorld(Load(name), threads);
        prepare(world.Simulation);
        var (hashes, bytes) = (new List<ulong>(), new List<ulong>());
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            hashes.Add(world.Simulation.StateHash());
            bytes.Add(world.PoolBytes);
        }
        Assert.True(world.Simulation.NarrowPhase.PairCount > 50);
        return (hashes, bytes);
    }

    /// <summary>Asking, and telling what holds anyway, is no use: not a byte is taken for it.</summary>
    [Theory, InlineData(Pyramids, 1), InlineData(Pyramids, 2), InlineData(ShapePile, 1), InlineData(ShapePile, 2)]
    public void Who_neither_listens_nor_has_layers_takes_no_memory(string name, int threads)
    {
        var expected = Run(name, threads, _ => { });
        var actual = Run(name, threads, simulation =>
        {
            ForAll(simulation, collidable =>
            {
                Assert.Equal(EventMask.None, simulation.Events.GetMask(collidable));
                Assert.False(simulation.Events.IsSensor(collidable));
                Assert.Equal(CollisionLayers.Everything, simulation.Layers[collidable]);
                simulation.Events.Listen(collidable, EventMask.None);
                simulation.Events.SetSensor(collidable, false);
                simulation.Layers[collidable] = CollisionLayers.Everything;
            });
            Assert.False(simulation.Events.IsUsed || simulation.Layers.IsUsed);
        });
        Assert.Equal(expected.Hashes, actual.Hashes);
        // Which worker takes a block first is up to chance where there are several.
        if (threads == 1)
            Assert.Equal(expected.PoolBytes, actual.PoolBytes);
    }

    /// <summary>Listening, and layers that all meet all others, change nothing in the world.</summary>
    [Theory, InlineData(Pyramids), InlineData(ShapePile)]
    public void Who_listens_and_has_layers_that_leave_nobody_out_is_in_the_same_world(string name)
    {
        var expected = Run(name, 1, _ => { });
        var actual = Run(name, 1, simulation => ForAll(simulation, collidable =>
        {
            simulation.Events.Listen(collidable, EventMask.All);
            simulation.Layers[collidable] = new CollisionLayers(1, 1);
        }));
        Assert.Equal(expected.Hashes, actual.Hashes);
        Assert.NotEqual(expected.PoolBytes, actual.PoolBytes);
    }

    [Theory, InlineData(Pyramids, 1), InlineData(Pyramids, 2), InlineData(ShapePile, 1), InlineData(ShapePile, 2)]
    public void Steps_in_which_all_listen_make_no_garbage(string name, int threads)
    {
        using var world = new SceneWorld(Load(name), threads);
        var events = world.Simulation.Events;
        ForAll(world.Simulation, collidable => events.Listen(collidable, EventMask.All));
        // While lists grow they do so in pools, but code that runs for the first time may take managed memory. The piles have to come down, too.
        int calm = 0, steps = 0;
        long told = 0;
        for (; steps < 150 || (steps < 300 && calm < 60); ++steps)
        {
            var before = world.ManagedBytes();
            world.Step();
            calm = world.ManagedBytes() == before ? calm + 1 : 0;
            told += events.Began.Length + events.Persisting.Length;
        }
        Assert.True(calm >= 60, $"In {steps} steps no 60 in a row made no garbage.");
        Assert.True(told > 100 * steps, $"{told} events in {steps} steps");
    }
}
