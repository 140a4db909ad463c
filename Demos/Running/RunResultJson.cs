using System.Globalization;
using System.IO;
using System.Text.Json;

namespace Demos.Running;

/// <summary>Writes a run as the JSON object that every program that runs scenes writes.</summary>
public static class RunResultJson
{
    /// <summary>Writes the file in one go, so that no half of it is left behind.</summary>
    public static void Write(string path, RunResult result)
    {
        using var memory = new MemoryStream();
        Write(memory, result);
        File.WriteAllBytes(path, memory.ToArray());
    }

    /// <summary>Writes the object to a stream.</summary>
    public static void Write(Stream stream, RunResult result)
    {
        using var json = new Utf8JsonWriter(stream, new JsonWriterOptions { Indented = true });
        json.WriteStartObject();
        json.WriteString("engine", result.Engine);
        json.WriteString("scene", result.Scene);
        json.WriteNumber("steps", result.Steps);
        if (result.IsStopped)
            json.WriteNumber("stepsAsked", result.StepsAsked);
        json.WriteNumber("dt", result.StepDuration);
        json.WriteNumber("substeps", result.Substeps);
        json.WriteNumber("iterations", result.Iterations);
        // What other engines do not have is there only where it was asked for.
        if (result.Relaxations > 0)
            json.WriteNumber("relaxations", result.Relaxations);
        json.WriteNumber("threads", result.Threads);
        json.WriteNumber("lanes", result.Lanes);
        json.WriteNumber("seed", result.Seed);
        WriteTimes(json, result);
        WriteCounts(json, result);
        Number(json, "maxPenetration", result.MaximumPenetration);
        Number(json, "maxJointError", result.MaximumJointError);
        Number(json, "rmsJointError", result.RmsJointError);
        Number(json, "kineticEnergy", result.KineticEnergy);
        Number(json, "potentialEnergy", result.PotentialEnergy);
        json.WriteNumber("moved", result.Moved);
        json.WriteNumber("lost", result.Lost);
        json.WriteNumber("notFinite", result.NotFinite);
        json.WriteString("hash", HashText(result.Hash));
        json.WriteStartArray("hashes");
        foreach (StepHash entry in result.Hashes)
        {
            json.WriteStartArray();
            json.WriteNumberValue(entry.Step);
            json.WriteStringValue(HashText(entry.Hash));
            json.WriteEndArray();
        }
        json.WriteEndArray();
        json.WriteEndObject();
    }

    /// <summary>A hash as it is written everywhere: 16 hexadecimal digits.</summary>
    public static string HashText(ulong hash) => hash.ToString("x16", CultureInfo.InvariantCulture);

    static void WriteTimes(Utf8JsonWriter json, RunResult result)
    {
        json.WriteStartObject("ms");
        Number(json, "mean", result.Times.Mean);
        Number(json, "median", result.Times.Median);
        Number(json, "p95", result.Times.P95);
        Number(json, "p99", result.Times.P99);
        Number(json, "max", result.Times.Max);
        json.WriteEndObject();
        json.WriteStartObject("stages");
        Number(json, "sleep", result.Stages.Sleep);
        Number(json, "predict", result.Stages.Predict);
        Number(json, "broad", result.Stages.Broad);
        Number(json, "narrow", result.Stages.Narrow);
        Number(json, "flush", result.Stages.Flush);
        Number(json, "solve", result.Stages.Solve);
        Number(json, "settle", result.Stages.Settle);
        json.WriteEndObject();
    }

    static void WriteCounts(Utf8JsonWriter json, RunResult result)
    {
        json.WriteNumber("bodies", result.Bodies);
        json.WriteNumber("awake", result.Awake);
        json.WriteNumber("statics", result.Statics);
        Number(json, "pairs", result.Pairs);
        Number(json, "manifolds", result.Manifolds);
        Number(json, "contacts", result.Contacts);
        Number(json, "constraints", result.Constraints);
        Number(json, "batches", result.Batches);
        Number(json, "fallback", result.Fallback);
        json.WriteNumber("managedBytes", result.ManagedBytes);
        json.WriteNumber("poolBytes", result.PoolBytes);
    }

    static void Number(Utf8JsonWriter json, string name, long? value)
    {
        if (value is long number)
            json.WriteNumber(name, number);
        else
            json.WriteNull(name);
    }

    /// <summary>JSON has no word for what is not finite: such a figure is null, and "notFinite" says why.</summary>
    static void Number(Utf8JsonWriter json, string name, double? value)
    {
        if (value is double number && double.IsFinite(number))
            json.WriteNumber(name, number);
        else
            json.WriteNull(name);
    }
}
