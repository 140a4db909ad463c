using System;
using System.Collections.Generic;
using System.IO;
using System.Text.Json;

namespace Benchmarks.Compare;

/// <summary>What a comparison reads from the JSON of a run.</summary>
sealed class RunFigures
{
    /// <summary>The stages of a step, in their order.</summary>
    public static readonly string[] StageNames = ["sleep", "predict", "broad", "narrow", "flush", "solve", "settle"];

    public required string Engine { get; init; }

    public required string Scene { get; init; }

    /// <summary>Floats in a vector, as the program found them.</summary>
    public required int Lanes { get; init; }

    /// <summary>Milliseconds per step.</summary>
    public required double Median { get; init; }

    /// <summary>Mean milliseconds of each stage; null where the engine does not say.</summary>
    public required double?[] Stages { get; init; }

    /// <summary>Metres; null in a scene without contacts.</summary>
    public double? MaximumPenetration { get; init; }

    /// <summary>Metres; null in a scene without joints.</summary>
    public double? RmsJointError { get; init; }

    public required int Moved { get; init; }

    public required string Hash { get; init; }

    /// <summary>Reads what a program has written.</summary>
    public static RunFigures Read(string path)
    {
        using JsonDocument document = JsonDocument.Parse(File.ReadAllBytes(path));
        JsonElement root = document.RootElement;
        JsonElement stages = root.GetProperty("stages");
        return new RunFigures
        {
            Engine = root.GetProperty("engine").GetString()!,
            Scene = root.GetProperty("scene").GetString()!,
            Lanes = root.GetProperty("lanes").GetInt32(),
            Median = root.GetProperty("ms").GetProperty("median").GetDouble(),
            Stages = Array.ConvertAll(StageNames, name => Number(stages, name)),
            MaximumPenetration = Number(root, "maxPenetration"),
            RmsJointError = Number(root, "rmsJointError"),
            Moved = root.GetProperty("moved").GetInt32(),
            Hash = root.GetProperty("hash").GetString()!,
        };
    }

    /// <summary>The middle of some numbers, or null when there are none.</summary>
    public static double? MedianOf(IEnumerable<double?> numbers)
    {
        var sorted = new List<double>();
        foreach (double? number in numbers)
        {
            if (number is double known)
                sorted.Add(known);
        }
        if (sorted.Count == 0)
            return null;
        sorted.Sort();
        int middle = sorted.Count / 2;
        return sorted.Count % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
    }

    static double? Number(JsonElement owner, string name)
    {
        JsonElement value = owner.GetProperty(name);
        return value.ValueKind == JsonValueKind.Number ? value.GetDouble() : null;
    }
}
