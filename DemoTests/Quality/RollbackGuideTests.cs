using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The code of Docs/Guides/Rollback.md does what the page says.</summary>
public sealed class RollbackGuideTests
{
    const int Steps = 90, Late = 7;

    [Fact]
    public void A_client_that_learns_late_ends_where_the_server_is()
    {
        using var pool = new BufferPool();
        using var server = new SceneWorld(SmallScenes.Pyramids(1, 6), threads: 1);
        using var client = new SceneWorld(SmallScenes.Pyramids(1, 6), threads: 2);
        for (int frame = 0; frame < Steps; ++frame)
        {
            Push(server.Simulation, frame);
            server.Step();
        }
        var known = -1;
        var foreseenWrongly = 0;
        var rollback = new DocSamples.Rollback(client.Simulation, pool, Late + 1, frame =>
        {
            if (frame <= known)
                Push(client.Simulation, frame);
            else
                ++foreseenWrongly;
        });
        while (rollback.Frame < Steps)
        {
            rollback.Step();
            known = rollback.Frame - Late;
            if (known >= 0)
                rollback.CorrectFrom(known);
        }
        for (known = Steps - Late + 1; known < Steps; ++known)
            rollback.CorrectFrom(known);
        Assert.Equal(Steps, rollback.Frame);
        Assert.True(foreseenWrongly >= Steps, $"It was told of all inputs but {foreseenWrongly} in time.");
        Assert.Equal(server.Simulation.StateHash(), client.Simulation.StateHash());
    }

    // What somebody else does to a world: another body each frame, in another direction.
    static void Push(Simulation simulation, int frame)
    {
        var body = simulation.Bodies[simulation.Bodies.ActiveSet.IndexToHandle[frame * 7 % simulation.Bodies.ActiveSet.Count]];
        body.ApplyLinearImpulse(new Vector3(MathF.Sin(frame), 0, 1));
    }

    [Fact]
    public void Frames_of_a_ring_are_gone_back_to_in_any_order()
    {
        const int frames = 25;
        using var pool = new BufferPool();
        using var world = new SceneWorld(SmallScenes.Pile("shape-pile", 3, 3), threads: 2);
        var ring = new List<SimulationSnapshot>();
        var hashes = new List<ulong>();
        for (int frame = 0; frame < frames; ++frame)
        {
            ring.Add(new SimulationSnapshot(pool));
            world.Simulation.Save(ring[frame]);
            hashes.Add(world.Simulation.StateHash());
            world.Step();
        }
        var random = new Random(11);
        for (int jump = 0; jump < 100; ++jump)
        {
            var frame = random.Next(frames - 1);
            world.Simulation.Restore(ring[frame]);
            Assert.Equal(hashes[frame], world.Simulation.StateHash());
            world.Step();
            Assert.Equal(hashes[frame + 1], world.Simulation.StateHash());
            // What was gone on to is saved as what was there.
            if (jump % 3 == 0)
                world.Simulation.Save(ring[frame + 1]);
        }
        ring.ForEach(snapshot => snapshot.Dispose());
    }

    [Fact]
    public void A_snapshot_that_was_written_is_read()
    {
        using var pool = new BufferPool();
        using var world = new SceneWorld(SmallScenes.Pyramids(1, 3), threads: 1);
        using SimulationSnapshot saved = new(pool), read = new(pool);
        world.Simulation.Save(saved);
        var expected = world.HashSteps(3);
        read.ReadFrom(DocSamples.Write(saved));
        world.Simulation.Restore(read);
        Assert.Equal(expected, world.HashSteps(3));
    }
}
