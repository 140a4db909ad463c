using System.Collections.Generic;
using System.Text.Json.Serialization;

namespace Demos.Accuracy;

/// <summary>A figure as it is written to a file: null is a value that is not finite, or a limit that there is not. A unit of % is a part of one.</summary>
sealed record AccuracyFigureJson(string Quantity, double? Value, double? Limit, string Unit);

/// <summary>A case as it is written to a file; one that is about settings of its own has no effort.</summary>
sealed record AccuracyCaseJson(string Case, string Scene, string? Effort, string Settings, bool Met, string? KnownMiss,
    IReadOnlyList<AccuracyFigureJson> Figures);

/// <summary>A run of the suite as it is written to a file.</summary>
sealed record AccuracyRunJson(string Engine, bool Complete, IReadOnlyList<AccuracyCaseJson> Cases);

/// <summary>Writes the file by generated code.</summary>
[JsonSourceGenerationOptions(PropertyNamingPolicy = JsonKnownNamingPolicy.CamelCase, WriteIndented = true)]
[JsonSerializable(typeof(AccuracyRunJson))]
sealed partial class AccuracyJsonContext : JsonSerializerContext;
