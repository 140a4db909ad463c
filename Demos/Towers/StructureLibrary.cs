using System;
using System.Collections.Generic;
using System.Linq;
using Demos.Scenes;
using Demos.Towers.Structures;
using Demos.Towers.Trials;

namespace Demos.Towers;

/// <summary>All structures, by name.</summary>
static class StructureLibrary
{
    /// <summary>In the order of the list.</summary>
    public static IReadOnlyList<Structure> All { get; } =
    [
        .. Stacks.All(),
        .. Walls.All(),
        .. Houses.All(),
        .. Arches.All(),
        new("great-pyramid", "one pyramid of 5,050 boxes", () => SceneLibrary.Load("great-pyramid", 1)) { IsSmall = false },
    ];

    /// <summary>What must slip or tip over, in the order of the list.</summary>
    public static IReadOnlyList<Trial> Trials { get; } = [.. TippingPlatform.All(), .. OverTheEdge.All()];

    /// <summary>Chooses structures and trials: all small ones without a name, else those that are named, or whose names begin so before a "*".</summary>
    /// <exception cref="SceneException">There is none of that name.</exception>
    public static (IReadOnlyList<Structure> Structures, IReadOnlyList<Trial> Trials) Choose(IReadOnlyList<string> names)
    {
        if (names.Count == 0)
            return ([.. All.Where(structure => structure.IsSmall)], Trials);
        var structures = new List<Structure>();
        var trials = new List<Trial>();
        foreach (string name in names)
        {
            int before = structures.Count + trials.Count;
            structures.AddRange(All.Where(structure => Means(name, structure.Name)));
            trials.AddRange(Trials.Where(trial => Means(name, trial.Name)));
            if (structures.Count + trials.Count == before)
                throw new SceneException($"there is nothing named '{name}'; 'towers --list' shows what there is");
        }
        return (structures, trials);
    }

    static bool Means(string wanted, string name) =>
        wanted.EndsWith('*') ? name.StartsWith(wanted[..^1], StringComparison.Ordinal) : name == wanted;
}
