using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using System.Threading;
using Demos.Scenes;

namespace Demos.Trade;

/// <summary>The other end of <see cref="RemoteTradeEngine"/>: measures what it is asked, a line each, until its input ends.</summary>
static class TradeWorker
{
    /// <summary>The word on the command line.</summary>
    public const string Word = "trade-worker";

    /// <summary>Greets, and answers until there is no more question.</summary>
    public static void Run(TextReader input, TextWriter output, CancellationToken stop)
    {
        using var engine = new LocalTradeEngine();
        Write(JsonSerializer.Serialize(
            new TradeGreeting(engine.Name, TradeScene.All.ToDictionary(scene => scene.Name, LocalTradeEngine.ValuesFor)), TradeLineJson.Default.TradeGreeting));
        while (input.ReadLine() is string line)
            Write(JsonSerializer.Serialize(Answer(engine, line, stop), TradeLineJson.Default.TradeAnswer));

        void Write(string line)
        {
            output.WriteLine(line);
            output.Flush();
        }
    }

    static TradeAnswer Answer(LocalTradeEngine engine, string line, CancellationToken stop)
    {
        try
        {
            TradeRequest request = JsonSerializer.Deserialize(line, TradeLineJson.Default.TradeRequest)!;
            return new TradeAnswer(engine.Measure(request.Scene, request.Place, request.Steps, stop), null);
        }
        catch (Exception refusal) when (refusal is SceneException or ArgumentException or JsonException)
        {
            return new TradeAnswer(null, refusal.Message);
        }
    }
}
