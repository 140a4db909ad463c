using System.Collections.Generic;
using System.Linq;
using BenchmarkDotNet.Attributes;
using Demos.Running;
using Demos.Scenes;

namespace Benchmarks.Scenes;

/// <summary>What a step of each scene takes.</summary>
[WarmupCount(1), IterationCount(5)]
public class SceneBenchmarks : SceneStepBenchmarks
{
    /// <summary>Names of the built-in scenes.</summary>
    public static IEnumerable<string> Names => SceneLibrary.Scenes.Select(scene => scene.Name);

    /// <summary>Name of the scene.</summary>
    [ParamsSource(nameof(Names))]
    public string Scene { get; set; } = SceneLibrary.DefaultScene;

    /// <summary>Threads that share the step.</summary>
    [Params(1, 2)]
    public int Threads { get; set; } = 1;

    private protected override SceneRun Create() => new(SceneLibrary.Load(Scene, seed: 1), new RunSettings { Threads = Threads });
}
