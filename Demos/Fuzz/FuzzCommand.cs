using System;
using System.CommandLine;
using System.IO;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Fuzz;

/// <summary>The command that calls the library at random.</summary>
static class FuzzCommand
{
    static readonly FuzzSettings defaults = new();

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var seed = new Option<int>("--seed") { Description = "Seed of all that is drawn.", DefaultValueFactory = _ => defaults.Seed };
        var count = new Option<long>("--count")
        {
            Description = "Number of calls; a million take about five minutes.",
            DefaultValueFactory = _ => defaults.Calls,
        };
        var perWorld = new Option<int>("--calls-per-world")
        {
            Description = "Calls until a simulation is disposed of and the next created.",
            DefaultValueFactory = _ => defaults.CallsPerWorld,
        };
        var world = new Option<int?>("--world") { Description = "The one simulation to run, as a failure names it." };
        var scope = new Option<int>("--scope")
        {
            Description = "Kinds of misuse, added up: 1 stale references, 2 calls from callbacks, 4 bad values from callbacks, 8 callbacks that throw, "
                + "16 removal of used shapes, 32 bad values written through references, 64 bad counts, 128 calls after disposal.",
            DefaultValueFactory = _ => (int)defaults.Scope,
        };
        var failures = new Option<int>("--failures") { Description = "Failures to end after.", DefaultValueFactory = _ => defaults.MaximumFailures };
        var trace = new Option<string?>("--trace") { Description = "File that says where the run is, for when the process dies.", HelpName = "FILE" };
        var command = new Command("fuzz", "Calls the library at random, well and badly, and looks whether it keeps its promises.");
        foreach (Option option in (Option[])[seed, count, perWorld, world, scope, failures, trace])
            command.Options.Add(option);
        command.SetAction(parsed => guard(parsed, () =>
        {
            var settings = new FuzzSettings
            {
                Seed = parsed.GetValue(seed),
                Calls = parsed.GetValue(count),
                CallsPerWorld = parsed.GetValue(perWorld),
                World = parsed.GetValue(world),
                Scope = (FuzzScope)parsed.GetValue(scope),
                MaximumFailures = parsed.GetValue(failures),
                TracePath = parsed.GetValue(trace),
            };
            return Run(settings, parsed.InvocationConfiguration.Output);
        }));
        return command;
    }

    static int Run(FuzzSettings settings, TextWriter output)
    {
        if (settings.Calls <= 0 || settings.CallsPerWorld <= 0 || settings.World < 0 || settings.MaximumFailures <= 0)
            throw new SceneException("numbers of calls and failures are above 0, worlds not below");
        if (settings.TracePath is not null)
            OutputFile.CheckWritable(settings.TracePath);
        using var signal = new StopSignal();
        using var run = new FuzzRun(settings, output);
        int failed = run.Run(signal.Token);
        (long calls, long refusals, long stopped) = run.Counts;
        output.WriteLine(FormattableString.Invariant(
            $"{calls} calls, {refusals} refused, {stopped} bodies stopped, {failed} failures, seed {settings.Seed}"));
        return failed > 0 ? DemosCommand.Unsound : signal.Token.IsCancellationRequested ? DemosCommand.Stopped : DemosCommand.Finished;
    }
}
