using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Threading;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Trade;

/// <summary>The commands that measure error against time: one for people, and one that a measuring process of another engine answers to.</summary>
static class TradeCommand
{
    const int DefaultRuns = 5;

    /// <summary>The command for people.</summary>
    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var scenes = new Argument<string[]>("scene")
        {
            Description = $"Scenes: {string.Join(", ", TradeScene.All.Select(scene => scene.Name))}; or all.",
            Arity = ArgumentArity.OneOrMore,
        };
        var runs = new Option<int>("--runs") { Description = "Runs of each setting.", DefaultValueFactory = _ => DefaultRuns };
        Option<string?> peer = PeerProgram.CreateOption("measure in turn with");
        var output = new Option<string?>("--output") { Description = "Folder for SCENE.svg, SCENE.json and SCENE.md of each scene.", HelpName = "FOLDER" };
        var all = new Option<bool>("--all") { Description = "Prints all settings, not only those on the front." };
        var command = new Command("trade", "Measures error against time of a step over all settings, and shows the settings that nothing beats.");
        command.Arguments.Add(scenes);
        foreach (Option option in (Option[])[runs, peer, output, all])
            command.Options.Add(option);
        var dials = new List<(TradeAxis Axis, Option<string?> Option)>();
        foreach (TradeAxis axis in TradeAxis.All)
        {
            var option = new Option<string?>($"--{axis.Name}") { Description = $"{axis.Description} Separated by commas [default: {Defaults(axis)}]." };
            dials.Add((axis, option));
            command.Options.Add(option);
        }
        command.SetAction(parsed => guard(parsed, () =>
        {
            TradeScene[] chosen = Choose(parsed.GetRequiredValue(scenes));
            int runCount = parsed.GetValue(runs);
            if (runCount is < 1 or > 1000)
                throw new SceneException($"--runs cannot be {runCount}");
            var asked = new Dictionary<string, string[]>();
            foreach ((TradeAxis axis, Option<string?> option) in dials)
            {
                if (parsed.GetValue(option) is string list)
                    asked.Add(axis.Name, Split(axis.Name, list));
            }
            if (parsed.GetValue(output) is string folder)
            {
                // Found out now rather than after minutes of measuring.
                Directory.CreateDirectory(folder);
                OutputFile.CheckWritable(Path.Combine(folder, $"{chosen[0].Name}.json"));
            }
            return Run(chosen, asked, runCount, parsed.GetValue(peer), parsed.GetValue(output), parsed.GetValue(all), parsed.InvocationConfiguration);
        }));
        return command;
    }

    /// <summary>The command of a measuring process.</summary>
    public static Command CreateWorker()
    {
        var command = new Command(TradeWorker.Word, "Measures what it is asked on its standard input.") { Hidden = true };
        command.SetAction(parsed =>
        {
            // The process that asks is told by the same Ctrl-C, and ends this one.
            using var signal = new StopSignal();
            TradeWorker.Run(Console.In, parsed.InvocationConfiguration.Output, signal.Token);
            return DemosCommand.Finished;
        });
        return command;
    }

    static int Run(TradeScene[] scenes, Dictionary<string, string[]> asked, int runs, string? peer, string? folder, bool all, InvocationConfiguration terminal)
    {
        using var signal = new StopSignal();
        var engines = new List<ITradeEngine>();
        try
        {
            if (peer is null)
            {
                engines.Add(new LocalTradeEngine());
            }
            else
            {
                string program = PeerProgram.Find(peer);
                // Both in processes of their own, so that neither has what the other lacks.
                engines.Add(new RemoteTradeEngine(typeof(TradeCommand).Assembly.Location));
                engines.Add(new RemoteTradeEngine(program));
            }
            TradeSweep[] sweeps = [.. scenes.Select(scene => new TradeSweep(scene, engines, asked))];
            for (int i = 0; i < scenes.Length && !signal.Token.IsCancellationRequested; ++i)
                Measure(scenes[i], sweeps[i], runs, folder, all, terminal, signal.Token);
            return signal.Token.IsCancellationRequested ? DemosCommand.Stopped : DemosCommand.Finished;
        }
        finally
        {
            engines.ForEach(engine => engine.Dispose());
        }
    }

    static void Measure(TradeScene scene, TradeSweep sweep, int runs, string? folder, bool all, InvocationConfiguration terminal, CancellationToken stop)
    {
        int shown = -1;
        sweep.Run(runs, (done, total, point) =>
        {
            // Every twentieth is enough to see that it goes on.
            if (done * 20 / total == shown)
                return;
            shown = done * 20 / total;
            terminal.Error.WriteLine($"{scene.Name}: {done} of {total} runs, {point.Engine} {point.Label}");
        }, stop);
        var report = new TradeReport(scene, sweep.Points, !stop.IsCancellationRequested);
        report.WriteTable(terminal.Output, all);
        if (report.Verdict() is string verdict)
            terminal.Output.WriteLine(verdict);
        terminal.Output.WriteLine();
        if (folder is null)
            return;
        File.WriteAllText(Path.Combine(folder, $"{scene.Name}.svg"), report.Plot());
        File.WriteAllText(Path.Combine(folder, $"{scene.Name}.json"), report.ToJson());
        using var page = new StreamWriter(Path.Combine(folder, $"{scene.Name}.md"));
        report.WriteMarkdown(page);
    }

    /// <summary>What is tried where nobody says what, of the scene that has the most to try.</summary>
    static string Defaults(TradeAxis axis) => string.Join(',', TradeScene.All.Select(axis.Values).MaxBy(values => values.Length)!);

    static TradeScene[] Choose(string[] names) => names is ["all"] ? [.. TradeScene.All] : [.. names.Distinct().Select(TradeScene.Find)];

    static string[] Split(string option, string list)
    {
        string[] values = list.Split(',', StringSplitOptions.RemoveEmptyEntries | StringSplitOptions.TrimEntries);
        return values.Length > 0 ? [.. values.Distinct()] : throw new SceneException($"--{option} is empty");
    }
}
