using System.Collections.Generic;
using System.IO;
using System.Text.Json;
using Demos.Towers.Trials;

namespace Demos.Towers;

/// <summary>Writes what structures did as a JSON array.</summary>
static class TowerJson
{
    /// <summary>Writes the file in one go, so that no half of it is left behind.</summary>
    public static void Write(string path, TowerSettings settings, IEnumerable<TowerResult> results, IEnumerable<(Trial Trial, double Figure)> trials)
    {
        using var memory = new MemoryStream();
        using (var json = new Utf8JsonWriter(memory, new JsonWriterOptions { Indented = true }))
        {
            json.WriteStartObject();
            json.WriteNumber("seconds", settings.Seconds);
            json.WriteNumber("dt", settings.StepDuration);
            json.WriteString("steps", settings.Steps.ToString());
            json.WriteNumber("substeps", settings.Substeps);
            json.WriteNumber("iterations", settings.Iterations);
            json.WriteNumber("relaxations", settings.Relaxations);
            json.WriteString("loadPath", settings.LoadPath.ToString());
            json.WriteNumber("offset", settings.Offset);
            json.WriteNumber("seed", settings.Seed);
            json.WriteNumber("push", settings.Push);
            json.WriteStartArray("structures");
            foreach (TowerResult result in results)
                WriteResult(json, result);
            json.WriteEndArray();
            json.WriteStartArray("trials");
            foreach ((Trial trial, double figure) in trials)
            {
                json.WriteStartObject();
                json.WriteString("name", trial.Name);
                json.WriteString("unit", trial.Unit);
                WriteFinite(json, "figure", figure);
                json.WriteNumber("truth", trial.Truth);
                json.WriteEndObject();
            }
            json.WriteEndArray();
            json.WriteEndObject();
        }
        File.WriteAllBytes(path, memory.ToArray());
    }

    static void WriteResult(Utf8JsonWriter json, TowerResult result)
    {
        json.WriteStartObject();
        json.WriteString("name", result.Structure);
        json.WriteNumber("parts", result.Parts);
        json.WriteBoolean("stands", result.Stands);
        if (result.FellAt is float time)
            json.WriteNumber("fellAt", time);
        else
            json.WriteNull("fellAt");
        WriteFinite(json, "heightLost", result.HeightLost);
        WriteFinite(json, "lean", result.Lean);
        WriteFinite(json, "msPerStep", result.MillisecondsPerStep);
        json.WriteEndObject();
    }

    // JSON has no word for what is not finite.
    static void WriteFinite(Utf8JsonWriter json, string name, double value)
    {
        if (double.IsFinite(value))
            json.WriteNumber(name, value);
        else
            json.WriteNull(name);
    }
}
