using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Text.Json.Serialization;
using Demos.Towers.Trials;

namespace Demos.Towers;

/// <summary>What structures did, as a file has it.</summary>
sealed record TowerJson(
    float Seconds, float Dt, string Steps, int Substeps, int Iterations, int Relaxations, string LoadPath, float Offset, int Seed, float Push,
    TowerResultJson[] Structures, TowerTrialJson[] Trials)
{
    /// <summary>Writes the file in one go, so that no half of it is left behind.</summary>
    public static void Write(string path, TowerSettings settings, IEnumerable<TowerResult> results, IEnumerable<(Trial Trial, double Figure)> trials)
    {
        var json = new TowerJson(
            settings.Seconds, settings.StepDuration, settings.Steps.ToString(), settings.Substeps, settings.Iterations, settings.Relaxations,
            settings.LoadPath.ToString(), settings.Offset, settings.Seed, settings.Push,
            [.. results.Select(result => new TowerResultJson(
                result.Structure, result.Parts, result.Stands, result.FellAt, Finite(result.HeightLost), Finite(result.Lean),
                Finite(result.MillisecondsPerStep)))],
            [.. trials.Select(trial => new TowerTrialJson(trial.Trial.Name, trial.Trial.Unit, Finite(trial.Figure), trial.Trial.Truth))]);
        File.WriteAllBytes(path, JsonSerializer.SerializeToUtf8Bytes(json, TowerJsonContext.Default.TowerJson));
    }

    // JSON has no word for what is not finite.
    static double? Finite(double value) => double.IsFinite(value) ? value : null;
}

/// <summary>What one structure did: lengths in metres, times in seconds.</summary>
sealed record TowerResultJson(string Name, int Parts, bool Stands, float? FellAt, double? HeightLost, double? Lean, double? MsPerStep);

/// <summary>What a trial measured.</summary>
sealed record TowerTrialJson(string Name, string Unit, double? Figure, double Truth);

/// <summary>Writes towers without looking at types while it runs.</summary>
[JsonSourceGenerationOptions(PropertyNamingPolicy = JsonKnownNamingPolicy.CamelCase, WriteIndented = true)]
[JsonSerializable(typeof(TowerJson))]
sealed partial class TowerJsonContext : JsonSerializerContext;
