using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Text.Json;
using System.Threading;
using Demos.Scenes;

namespace Demos.Trade;

/// <summary>
/// An engine in a process of its own, asked by lines of JSON. The process lives as long as this does: what it has compiled once serves all measurements.
/// </summary>
sealed class RemoteTradeEngine : ITradeEngine
{
    readonly Process process;
    readonly Dictionary<string, Dictionary<string, string[]>> values;

    /// <summary>Starts a program that knows the command of <see cref="TradeWorker"/>.</summary>
    /// <param name="assemblyPath">The program.</param>
    /// <exception cref="SceneException">It is no such program.</exception>
    public RemoteTradeEngine(string assemblyPath)
    {
        var start = new ProcessStartInfo("dotnet") { RedirectStandardInput = true, RedirectStandardOutput = true };
        start.ArgumentList.Add(assemblyPath);
        start.ArgumentList.Add(TradeWorker.Word);
        process = Process.Start(start) ?? throw new SceneException("dotnet cannot be started");
        try
        {
            TradeGreeting greeting = JsonSerializer.Deserialize(ReadLine(), TradeLineJson.Default.TradeGreeting)!;
            (Name, values) = (greeting.Engine, greeting.Values);
        }
        catch (JsonException)
        {
            Dispose();
            throw new SceneException($"{assemblyPath} is no program that measures the trade");
        }
    }

    public string Name { get; }

    public IReadOnlyDictionary<string, string[]> Values(string scene) =>
        values.GetValueOrDefault(scene) ?? throw new SceneException($"{Name} has no scene '{scene}'");

    public TradeMeasurement? Measure(string scene, IReadOnlyDictionary<string, string> place, int? steps, CancellationToken stop)
    {
        try
        {
            process.StandardInput.WriteLine(JsonSerializer.Serialize(new TradeRequest(scene, place, steps), TradeLineJson.Default.TradeRequest));
            process.StandardInput.Flush();
        }
        catch (IOException)
        {
            throw Gone();
        }
        TradeAnswer answer = JsonSerializer.Deserialize(ReadLine(), TradeLineJson.Default.TradeAnswer)!;
        return answer.Problem is null ? answer.Measurement : throw new SceneException($"{Name}: {answer.Problem}");
    }

    public void Dispose()
    {
        // The end of its input is the end of the worker.
        process.StandardInput.Dispose();
        process.WaitForExit();
        process.Dispose();
    }

    string ReadLine() => process.StandardOutput.ReadLine() ?? throw Gone();

    SceneException Gone() => new($"the process of {Name ?? "an engine"} has ended before its answer");
}
