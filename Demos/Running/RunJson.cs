using System;
using System.Collections.Generic;
using System.Text.Json;
using System.Text.Json.Serialization;

namespace Demos.Running;

/// <summary>
/// The JSON object of a run, member by member as every program that runs scenes writes it: times in milliseconds, otherwise SI. A figure that a scene or
/// an engine does not have, or that is not finite, is null.
/// </summary>
public sealed record RunJson
{
    public required string Engine { get; init; }

    public required string Scene { get; init; }

    public int Steps { get; init; }

    /// <summary>Only there when the run was stopped.</summary>
    [JsonIgnore(Condition = JsonIgnoreCondition.WhenWritingNull)]
    public int? StepsAsked { get; init; }

    public float Dt { get; init; }

    public int Substeps { get; init; }

    public int Iterations { get; init; }

    /// <summary>Only there where they were asked for: other engines do not have them.</summary>
    [JsonIgnore(Condition = JsonIgnoreCondition.WhenWritingNull)]
    public int? Relaxations { get; init; }

    public int Threads { get; init; }

    public int Lanes { get; init; }

    public int Seed { get; init; }

    public required RunTimesJson Ms { get; init; }

    public required RunStagesJson Stages { get; init; }

    public int Bodies { get; init; }

    public int Awake { get; init; }

    public int Statics { get; init; }

    public long? Pairs { get; init; }

    public long? Manifolds { get; init; }

    public long? Contacts { get; init; }

    public int? Constraints { get; init; }

    public int? Batches { get; init; }

    public int? Fallback { get; init; }

    public long ManagedBytes { get; init; }

    public long PoolBytes { get; init; }

    public double? MaxPenetration { get; init; }

    public double? MaxJointError { get; init; }

    public double? RmsJointError { get; init; }

    public double? KineticEnergy { get; init; }

    public double? PotentialEnergy { get; init; }

    public int Moved { get; init; }

    public int Lost { get; init; }

    public int NotFinite { get; init; }

    /// <summary>16 hexadecimal digits.</summary>
    public required string Hash { get; init; }

    public IReadOnlyList<RunHashJson> Hashes { get; init; } = [];
}

/// <summary>Milliseconds of a step.</summary>
public sealed record RunTimesJson(double? Mean, double? Median, double? P95, double? P99, double? Max);

/// <summary>Mean milliseconds of the stages of a step.</summary>
public sealed record RunStagesJson(double? Sleep, double? Predict, double? Broad, double? Narrow, double? Flush, double? Solve, double? Settle);

/// <summary>A step and the hash after it, as an array of both.</summary>
[JsonConverter(typeof(RunHashConverter))]
public readonly record struct RunHashJson(int Step, string Hash);

/// <summary>Writes a step and its hash as [step, "hash"].</summary>
sealed class RunHashConverter : JsonConverter<RunHashJson>
{
    public override RunHashJson Read(ref Utf8JsonReader reader, Type typeToConvert, JsonSerializerOptions options)
    {
        if (reader.TokenType != JsonTokenType.StartArray || !reader.Read())
            throw new JsonException("a recorded hash is an array of a step and a text");
        int step = reader.GetInt32();
        reader.Read();
        string hash = reader.GetString() ?? throw new JsonException("a recorded hash has no text");
        return reader.Read() && reader.TokenType == JsonTokenType.EndArray
            ? new RunHashJson(step, hash)
            : throw new JsonException("a recorded hash has two entries");
    }

    public override void Write(Utf8JsonWriter writer, RunHashJson value, JsonSerializerOptions options)
    {
        writer.WriteStartArray();
        writer.WriteNumberValue(value.Step);
        writer.WriteStringValue(value.Hash);
        writer.WriteEndArray();
    }
}

/// <summary>Reads and writes runs by generated code.</summary>
[JsonSourceGenerationOptions(PropertyNamingPolicy = JsonKnownNamingPolicy.CamelCase, WriteIndented = true)]
[JsonSerializable(typeof(RunJson))]
sealed partial class RunJsonContext : JsonSerializerContext;
