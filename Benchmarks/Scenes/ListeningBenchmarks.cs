using System.Numerics;
using BenchmarkDotNet.Attributes;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.Running;
using Demos.Scenes;

namespace Benchmarks.Scenes;

/// <summary>What events and layers cost: nobody asks for them, somebody does who meets nothing, or everybody listens to everything.</summary>
/// <remarks>The state after the steps that are measured is the same for all.</remarks>
[WarmupCount(2), IterationCount(15)]
public class ListeningBenchmarks : SceneStepBenchmarks
{
    /// <summary>Who asks.</summary>
    public enum Audience
    {
        /// <summary>Nobody: the tables of events and layers do not exist.</summary>
        Nobody,
        /// <summary>A static far away listens to everything, and has layers that meet all others.</summary>
        Elsewhere,
        /// <summary>All bodies listen to everything.</summary>
        All,
    }

    /// <summary>Who asks.</summary>
    [Params(Audience.Nobody, Audience.Elsewhere, Audience.All)]
    public Audience Asks { get; set; }

    /// <summary>Name of the scene.</summary>
    [Params("pyramids", "shape-pile")]
    public string Scene { get; set; } = "pyramids";

    private protected override SceneRun Create()
    {
        var run = new SceneRun(SceneLibrary.Load(Scene, seed: 1), new RunSettings { Listen = Asks == Audience.All });
        if (Asks == Audience.Elsewhere)
            ListenElsewhere(run.Simulation);
        return run;
    }

    static void ListenElsewhere(Simulation simulation)
    {
        var shape = simulation.Shapes.Add(new Sphere(1));
        var far = simulation.Statics.Add(new StaticDescription(new(0, 1e5f, 0), Quaternion.Identity, shape));
        simulation.Events.Listen(far, EventMask.All);
        simulation.Layers[far] = new CollisionLayers(1, 1);
    }
}
