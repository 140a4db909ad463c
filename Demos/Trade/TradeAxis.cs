using System;
using System.Collections.Generic;
using System.Globalization;
using BepuPhysics;
using Demos.Accuracy;
using Demos.Engine;
using Demos.Running;
using Demos.Scenes;

namespace Demos.Trade;

/// <summary>
/// One dial of the sweep. All that the sweep knows about a dial is its entry in <see cref="All"/>: the option, the label, the values that are tried and
/// what a value does. A dial more is an entry more.
/// </summary>
/// <param name="Name">Word of the option and of the files.</param>
/// <param name="Description">What it sets.</param>
/// <param name="Values">What is tried in a scene where nobody says what.</param>
/// <param name="Label">How a value is written in a setting's label; empty for nothing.</param>
/// <param name="Apply">Sets it; null where a value is none.</param>
sealed record TradeAxis(
    string Name, string Description, Func<TradeScene, string[]> Values, Func<string, string> Label, Func<AccuracySettings, string, AccuracySettings?> Apply)
{
    /// <summary>What leaves a dial as the engine has it.</summary>
    public const string Default = "default";

    /// <summary>Joints one after the other.</summary>
    public const string Swept = "swept";

    const int MostSweeps = 1024;

    static readonly AngularIntegrationMode[] modes = [AngularIntegrationMode.Nonconserving, AngularIntegrationMode.ConserveMomentum,
        AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque];

    static readonly string[] modeWords = ["plain", "momentum", "gyroscopic"];

    // In the order of LoadPathChoice.
    static readonly string[] loadPathWords = ["off", "needed", "always"];

    // One after the other, or all of a structure at once. In the order of DirectJointsChoice.
    static readonly string[] jointWords = [Swept, "direct", "needed"];

    /// <summary>All dials, the first changing slowest.</summary>
    public static IReadOnlyList<TradeAxis> All { get; } =
    [
        new("mode", $"How rotation is integrated: {string.Join(", ", modeWords)} or {Default}.", scene => scene.Turns ? modeWords : EngineTraits.TradedModes,
            value => value == Default ? "" : value,
            (settings, value) => value == Default ? settings
                : Array.IndexOf(modeWords, value) is >= 0 and int index ? settings with { AngularMode = modes[index] } : null),
        new("spring", $"Frequency in Hz of contacts and joints, rigid (as stiff as a substep holds), swept (as all its sweeps do) or {Default}.",
            _ => EngineTraits.TradedSprings,
            value => value == Default ? "" : value,
            (settings, value) => value switch
            {
                Default => settings,
                "rigid" => settings with { Stiff = true },
                "swept" => settings with { Stiff = true, SpringFollowsSweeps = true },
                _ => float.TryParse(value, NumberStyles.Float, CultureInfo.InvariantCulture, out float hertz) && hertz is > 0 and <= 1e4f
                    ? settings with { SpringFrequency = hertz } : null,
            }),
        new("load-path", $"Whether loads are handed down to the ground in one go: {string.Join(", ", loadPathWords)}.",
            scene => scene.Stands && EngineTraits.HasLoadPath ? loadPathWords : [loadPathWords[(int)EngineDefaults.LoadPath]],
            value => value == loadPathWords[(int)EngineDefaults.LoadPath] ? "" : $"load {value}",
            (settings, value) => Array.IndexOf(loadPathWords, value) is >= 0 and int index && (index == 0 || EngineTraits.HasLoadPath)
                ? settings with { LoadPath = (LoadPathChoice)index } : null),
        new("joints", $"How joints are solved: {string.Join(", ", jointWords)}.",
            scene => scene.HasJoints && EngineTraits.HasDirectJoints ? jointWords : [jointWords[0]],
            value => value == jointWords[0] ? "" : value,
            (settings, value) => Array.IndexOf(jointWords, value) is >= 0 and int index && (index == 0 || EngineTraits.HasDirectJoints)
                ? settings with { DirectJoints = (DirectJointsChoice)index } : null),
        new("relaxations", "Relaxation sweeps per substep.", _ => EngineTraits.HasRelaxation ? ["0", "1"] : ["0"],
            value => value == "0" ? "" : $"r{value}",
            (settings, value) => Count(value, 0) is int count && (count == 0 || EngineTraits.HasRelaxation)
                ? settings with { RelaxationCount = count } : null),
        new("iterations", "Velocity iterations per substep.", _ => ["1", "2", "4"], value => $"i{value}",
            (settings, value) => Count(value, 1) is int count ? settings with { VelocityIterationCount = count } : null),
        new("substeps", "Substeps per step.", _ => ["1", "2", "4", "8", "16", "32"], value => $"s{value}",
            (settings, value) => Count(value, 1) is int count ? settings with { SubstepCount = count } : null),
    ];

    /// <summary>The settings that a place in the space of dials stands for; a dial that is not named stays at its default.</summary>
    /// <exception cref="SceneException">There is no such dial, or it has no such value.</exception>
    public static AccuracySettings Settings(IReadOnlyDictionary<string, string> place)
    {
        var settings = new AccuracySettings();
        foreach ((string name, string value) in place)
        {
            TradeAxis axis = Find(name);
            settings = axis.Apply(settings, value) ?? throw new SceneException($"--{name} cannot be '{value}'");
        }
        return settings;
    }

    /// <summary>How a place is called in tables and plots: s4 i1 r1.</summary>
    public static string LabelOf(IReadOnlyDictionary<string, string> place)
    {
        var words = new List<string>();
        for (int i = All.Count - 1; i >= 0; --i)
        {
            if (place.TryGetValue(All[i].Name, out string? value) && All[i].Label(value) is { Length: > 0 } label)
                words.Add(label);
        }
        return string.Join(' ', words);
    }

    static TradeAxis Find(string name)
    {
        foreach (TradeAxis axis in All)
        {
            if (axis.Name == name)
                return axis;
        }
        throw new SceneException($"there is no dial '{name}'");
    }

    static int? Count(string value, int least) =>
        int.TryParse(value, NumberStyles.None, CultureInfo.InvariantCulture, out int count) && count >= least && count <= MostSweeps ? count : null;
}
