using System.Collections.Generic;
using System.Text.Json.Serialization;

namespace Demos.Trade;

/// <summary>What an engine in another process says first: its name, and the values of each dial that it tries in each scene.</summary>
sealed record TradeGreeting(string Engine, Dictionary<string, Dictionary<string, string[]>> Values);

/// <summary>What an engine in another process is asked: a line each.</summary>
sealed record TradeRequest(string Scene, IReadOnlyDictionary<string, string> Place, int? Steps);

/// <summary>What it answers, a line each: a measurement, or why there is none; neither when it was stopped.</summary>
sealed record TradeAnswer(TradeMeasurement? Measurement, string? Problem);

/// <summary>A point as it is written to a file. Error is null when what was to hold has broken; times are milliseconds of a step.</summary>
sealed record TradePointJson(
    string Engine, string Setting, IReadOnlyDictionary<string, string> Dials, double? Error, double? Ms, double? MsMin, double? MsMax, int Runs, bool Front);

/// <summary>A point of the peer's front, the quickest of our settings that is no less exact (null if there is none), and our time over theirs.</summary>
sealed record TradeRatioJson(string Theirs, double Error, string? Ours, double? Ratio);

/// <summary>A scene's sweep as it is written to a file. An error whose unit is % is a part of one.</summary>
sealed record TradeReportJson(
    string Scene, string Summary, string Error, string Unit, bool Complete, IReadOnlyList<TradePointJson> Points, IReadOnlyList<TradeRatioJson> Ratios);

/// <summary>All JSON of the trade, by generated code.</summary>
[JsonSourceGenerationOptions(PropertyNamingPolicy = JsonKnownNamingPolicy.CamelCase)]
[JsonSerializable(typeof(TradeGreeting))]
[JsonSerializable(typeof(TradeRequest))]
[JsonSerializable(typeof(TradeAnswer))]
sealed partial class TradeLineJson : JsonSerializerContext;

/// <summary>The file of a sweep, for people too.</summary>
[JsonSourceGenerationOptions(PropertyNamingPolicy = JsonKnownNamingPolicy.CamelCase, WriteIndented = true)]
[JsonSerializable(typeof(TradeReportJson))]
sealed partial class TradeFileJson : JsonSerializerContext;
