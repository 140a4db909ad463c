using System.Numerics;
using Demos.Scenes;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>A step of a scene that has settled takes no memory, managed or not, and a simulation that is disposed owes none.</summary>
/// <remarks>
/// Pools grow while a scene holds more of something than ever before: contacts come in several types, whose numbers shift until all is at
/// rest. So each scene has to come to steps that take nothing, many of them in a row: a step that always takes something never does.
/// </remarks>
public abstract class MemoryTests(int threads)
{
    const int CalmSteps = 60;
    const int MostSteps = 600;
    const string SmallWave = "small wave";

    public static TheoryData<string> Scenes
    {
        get
        {
            var data = new TheoryData<string>();
            foreach (var scene in SceneLibrary.Scenes)
            {
                // A hundred thousand bodies take minutes until they sleep: a small wave is there instead.
                if (scene.Name is "waking-wave" or "settled-city")
                    continue;
                data.Add(scene.Name);
            }
            data.Add(SmallWave);
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Steps_after_the_warm_up_take_no_memory(string name)
    {
        var scene = name switch
        {
            SmallWave => SmallScenes.Wave(),
            "tori" => SmallScenes.Tori(12),
            _ => SceneLibrary.Load(name, seed: 1),
        };
        using var world = new SceneWorld(scene, threads);
        int calm = 0, steps = 0;
        (long Managed, ulong Pools) taken = default, last = default;
        for (; steps < MostSteps && calm < CalmSteps; ++steps)
        {
            var before = (Managed: world.ManagedBytes(), Pools: world.PoolBytes);
            world.Step();
            taken = (world.ManagedBytes() - before.Managed, world.PoolBytes - before.Pools);
            calm = taken == default ? calm + 1 : 0;
            last = taken == default ? last : taken;
        }
        Assert.True(calm == CalmSteps, $"In {steps} steps no {CalmSteps} in a row took no memory; the last that did took {last}.");
        world.Simulation.Validate();
    }

    /// <summary>A first step finds all contacts at once, and tables double on their way: what that took goes back after a while.</summary>
    [Fact]
    public void What_the_first_step_needed_goes_back()
    {
        const int width = 80;
        var scene = new SceneDescription { Name = "boxes" };
        int ground = scene.AddBox(400, 1, 400), box = scene.AddBox(0.5f, 0.5f, 0.5f);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < width * width; ++i)
            scene.AddDynamic(box, 1, new Vector3(i % width - width / 2, 0.25f, i / width - width / 2) * 2);
        using var world = new SceneWorld(scene, threads);
        world.Step();
        var most = world.PoolBytes;
        for (int i = 0; i < 520; ++i)
            world.Step();
        Assert.InRange(world.PoolBytes, 1ul, most * 2 / 3);
        world.Simulation.Validate();
    }

    /// <summary>A world in which all sleep needs nothing of what its steps took, and its steps, which do nothing else, give it back.</summary>
    [Fact]
    public void What_steps_needed_goes_back_when_all_sleep()
    {
        const int width = 100;
        var scene = new SceneDescription { Name = "sleepers", Sleep = true };
        int ground = scene.AddBox(400, 1, 400), box = scene.AddBox(0.5f, 0.5f, 0.5f);
        scene.AddStatic(ground, new Vector3(0, -1, 0));
        for (int i = 0; i < width * width; ++i)
            scene.AddDynamic(box, 1, new Vector3(i % width - width / 2, 0.25f, i / width - width / 2) * 2);
        using var world = new SceneWorld(scene, threads);
        for (int i = 0; i < 100; ++i)
            world.Step();
        Assert.Equal(0, world.Simulation.Bodies.ActiveSet.Count);
        var most = world.PoolBytes;
        for (int i = 0; i < 520; ++i)
            world.Step();
        Assert.InRange(world.PoolBytes, 1ul, most * 9 / 10);
        world.Simulation.Validate();
    }
}

public class MemoryOfOneThreadTests() : MemoryTests(threads: 1);

// What the pools of a worker hold depends on what comes to it, which tests beside would make vary more.
[Collection(AloneCollection.Name)]
public class MemoryOfThreadsTests() : MemoryTests(threads: 2);
