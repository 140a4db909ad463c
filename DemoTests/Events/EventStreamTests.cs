using System.Collections.Generic;
using System.Linq;
using BepuPhysics.CollisionDetection;
using Demos.Running;
using Demos.Scenes;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Events;

/// <summary>What a heap of a thousand bodies tells, all of them listened to: the same bytes for any number of threads and any width of vectors.</summary>
public sealed class EventStreamTests(ITestOutputHelper output)
{
    const string Listen = "--listen";
    const int Steps = 75;

    static SceneDescription Heap => SmallScenes.Pile("shape-pile", columns: 10, layers: 10);

    // Hashes of state and events together after each step.
    static List<(int Step, string Hash)> Run(int threads)
    {
        using var run = new SceneRun(Heap, new RunSettings { Steps = Steps, Threads = threads, HashEvery = 1, Listen = true });
        var result = run.Run();
        Assert.Equal(1000, result.Bodies);
        return [.. result.Hashes.Select(hash => (hash.Step, $"{hash.Hash:x16}"))];
    }

    [Fact]
    public void A_thousand_bodies_touch_much()
    {
        using var run = new SceneRun(Heap, new RunSettings { Listen = true });
        var (began, ended, hits, persisting) = (0, 0, 0, 0);
        for (int i = 0; i < Steps; ++i)
        {
            run.Step();
            CollisionEvents events = run.Simulation.Events;
            began += events.Began.Length;
            ended += events.Ended.Length;
            hits += events.Hits.Length;
            persisting += events.Persisting.Length;
        }
        output.WriteLine($"began {began}, ended {ended}, hits {hits}, persisting {persisting}");
        Assert.True(began > 1000 && ended > 300 && hits > 1000 && persisting > 10_000);
    }

    [Fact]
    public void Threads_do_not_change_a_byte()
    {
        var expected = Run(1);
        for (int threads = 2; threads <= 8; ++threads)
            DeterminismTests.AssertSame(expected, Run(threads), $"Events with {threads} threads");
    }

    [Fact]
    public void Lanes_do_not_change_a_byte() => new DeterminismTests(output).AssertSameForAnyLanes("heap", Heap, Steps, Listen);
}
