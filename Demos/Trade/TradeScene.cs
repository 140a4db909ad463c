using System;
using System.Collections.Generic;
using Demos.Accuracy;
using Demos.Scenes;
using Demos.Trade.Cases;

namespace Demos.Trade;

/// <summary>A scene whose true answer is known, and what its error is.</summary>
/// <param name="Name">As it is asked for.</param>
/// <param name="Summary">What is in it, in a line.</param>
/// <param name="ErrorName">What the error is.</param>
/// <param name="Unit">Unit of the error; "%" for a part of one, which is then a hundredth of the figure shown.</param>
/// <param name="Turns">Whether the way in which rotation is integrated has a part in the error.</param>
/// <param name="Stands">Whether bodies rest on one another in it, so that a load path has something to hand down.</param>
/// <param name="HasJoints">Whether joints bear loads in it.</param>
/// <param name="Create">Builds it.</param>
sealed record TradeScene(
    string Name, string Summary, string ErrorName, string Unit, bool Turns, bool Stands, bool HasJoints, Func<AccuracySettings, TradeCase> Create)
{
    /// <summary>All scenes, in the order of the list.</summary>
    public static IReadOnlyList<TradeScene> All { get; } =
    [
        new("chain", "100 links of 1 kg that hang, 100 kg at the end, kicked", "mean stretch of a link", "%", false, false, true, s => new ChainCase(s)),
        new("stack", "30 cubes, 10 s", "height lost and drift", "m", false, true, false, s => new StackCase(s)),
        new("wall", "a brick wall of 16 by 10, 10 s", "height lost and drift", "m", false, true, false, s => new WallCase(s)),
        new("heavy", "a cube of 1,000 kg on one of 1 kg, 10 s", "sink", "m", false, true, false, s => new HeavyCase(s)),
        new("ragdolls", "30 ragdolls of 11 capsules fall in a heap", "mean gap of a joint", "m", false, false, true, s => new RagdollCase(s)),
        new("bridge", "40 hinged planks of 10 kg carry a box of 1,000 kg", "mean gap of a hinge", "m", false, false, true, s => new BridgeCase(s)),
        new("top", "a heavy top, 200 rad/s, 10 s", "mean angle of its axis to the true one", "rad", true, false, false, s => new TopCase(s)),
        new("bounce", "16 spheres bounce without loss", "mean error of the height, of that fallen", "%", false, false, false, s => new BounceCase(s)),
        new("steps", "10 cubes, steps of 1/30 to 1/240 s in turn", "height lost and drift", "m", false, true, false, s => new StepLengthCase(s)),
    ];

    /// <summary>The scene of that name.</summary>
    /// <exception cref="SceneException">There is none.</exception>
    public static TradeScene Find(string name)
    {
        foreach (TradeScene scene in All)
        {
            if (scene.Name == name)
                return scene;
        }
        throw new SceneException($"the trade has no scene '{name}'; it has {string.Join(", ", Names())}");
    }

    /// <summary>An error as it is shown: in the scene's unit, three digits.</summary>
    public string Show(double error) => double.IsFinite(error)
        ? FormattableString.Invariant($"{(Unit == "%" ? 100 * error : error):G3} {Unit}")
        : "broken";

    static IEnumerable<string> Names()
    {
        foreach (TradeScene scene in All)
            yield return scene.Name;
    }
}
