using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>A field of boxes that rest on a floor, enough of them that the stages are divided among threads.</summary>
sealed class FaultyWorld : IDisposable
{
    const int Side = 20;
    readonly ThreadDispatcher? dispatcher;
    readonly BufferPool pool = new();

    public FaultyWorld(Fault fault, int threads)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = Simulation.Create(pool, new FaultyContacts(fault), new WorldGravity(new AccuracySettings()), new SolveDescription(1, 4));
        var box = new Box(1, 1, 1);
        var shape = Simulation.Shapes.Add(box);
        Simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), Simulation.Shapes.Add(new Box(1000, 2, 1000))));
        for (int i = 0; i < Side * Side; ++i)
        {
            var position = new Vector3(i % Side * 1.2f - 12, .5f, i / Side * 1.2f - 12);
            Bodies.Add(Simulation.Bodies.Add(
                BodyDescription.CreateDynamic(position, box.ComputeInertia(1), shape, new BodyActivityDescription(-1))));
        }
    }

    public Simulation Simulation { get; }

    public List<BodyHandle> Bodies { get; } = [];

    public void Step() => Simulation.Timestep(1 / 60f, dispatcher);

    public void AssertAllRest()
    {
        foreach (var handle in Bodies)
        {
            var body = Simulation.Bodies[handle];
            // Rest on a rigid contact is a fraction of a millimetre deep.
            Assert.Equal(.5f, body.Pose.Position.Y, .01f);
            Assert.InRange(body.Velocity.Linear.Length(), 0, .1f);
        }
    }

    public void Dispose()
    {
        Simulation.Dispose();
        pool.AssertEmpty();
        dispatcher?.WorkerPools.AssertEmpty();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
