using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Threading;
using Demos.Running;
using Spectre.Console;

namespace Demos.Terminal;

/// <summary>Shows a run: a progress bar and a table on a terminal, plain lines everywhere else.</summary>
sealed class RunReport(TextWriter output)
{
    readonly bool isTerminal = TextTable.IsTerminal(output);

    /// <summary>Runs all steps, with a progress bar where somebody can see it.</summary>
    public RunResult RunWithProgress(SceneRun run, string sceneName, int steps, CancellationToken stop)
    {
        if (!isTerminal)
            return run.Run(null, stop);
        // Drawn from between the steps, never by a timer thread: that would cost the steps time and count as their garbage.
        return AnsiConsole.Progress().AutoRefresh(false).AutoClear(true).Start(context =>
        {
            ProgressTask task = context.AddTask(Markup.Escape(sceneName), maxValue: steps);
            int interval = Math.Max(1, steps / 100);
            return run.Run(step =>
            {
                if (step % interval != 0)
                    return;
                task.Value = step;
                context.Refresh();
            }, stop);
        });
    }

    /// <summary>Writes the figures.</summary>
    public void Write(RunResult result)
    {
        var table = new TextTable("figure", "value") { IsHeadless = true };
        foreach ((string name, string value) in Rows(result))
            table.Add(name, value);
        table.Write(output);
    }

    static string Stopped(RunResult result) => result.IsStopped ? Text($", stopped before {result.StepsAsked}") : "";

    static string Relaxed(RunResult result) => result.Relaxations == 0 ? "" : Text($", {result.Relaxations} relaxed");

    static IEnumerable<(string Name, string Value)> Rows(RunResult result)
    {
        yield return ("engine", result.Engine);
        yield return ("scene", result.Scene);
        yield return ("steps", Text($"{result.Steps} of {result.StepDuration * 1000:0.###} ms{Stopped(result)}"));
        yield return ("solver", Text($"{result.Iterations} iterations x {result.Substeps} substeps{Relaxed(result)}"));
        yield return ("threads, lanes", Text($"{result.Threads}, {result.Lanes}"));
        StepTimes ms = result.Times;
        yield return ("ms per step", Text($"median {ms.Median:0.000}, mean {ms.Mean:0.000}"));
        yield return ("  slow steps", Text($"p95 {ms.P95:0.000}, p99 {ms.P99:0.000}, max {ms.Max:0.000}"));
        foreach ((string stage, double? time) in Stages(result.Stages))
        {
            if (time is double known)
                yield return ($"  {stage}", Text($"{known:0.000}"));
        }
        yield return ("bodies", Text($"{result.Bodies} ({result.Awake} awake), {result.Statics} statics"));
        yield return ("contacts", $"{Figure(result.Contacts)} in {Figure(result.Manifolds)} manifolds of {Figure(result.Pairs)} pairs");
        yield return ("constraints", $"{Figure(result.Constraints)} in {Figure(result.Batches)} batches");
        if (result.Fallback > 0)
            yield return ("  without colour", Figure(result.Fallback));
        yield return ("allocated", Text($"{result.ManagedBytes} bytes managed, {result.PoolBytes} bytes pooled"));
        if (result.MaximumPenetration is double depth)
            yield return ("penetration", Text($"{depth * 1000:0.###} mm at most"));
        if (result.MaximumJointError is double worst && result.RmsJointError is double rms)
            yield return ("joint error", Text($"{worst * 1000:0.###} mm at most, {rms * 1000:0.###} mm rms"));
        yield return ("energy", Text($"{result.KineticEnergy:G6} J kinetic, {result.PotentialEnergy:G6} J potential"));
        yield return ("moved", Text($"{result.Moved} by more than 0.5 m, {result.Lost} lost, {result.NotFinite} not finite"));
        if (result.Lost > 0)
            yield return ("status", Text($"{DemosCommand.Unsound}: what fell below y = {BuiltScene.LostBelow} is lost; what falls on nothing is in time"));
        yield return ("hash", RunResultJson.HashText(result.Hash));
    }

    static (string Name, double? Milliseconds)[] Stages(StageTimes times) =>
    [
        ("sleep", times.Sleep), ("predict", times.Predict), ("broad", times.Broad), ("narrow", times.Narrow), ("flush", times.Flush),
        ("solve", times.Solve), ("settle", times.Settle),
    ];

    static string Text(FormattableString text) => FormattableString.Invariant(text);

    static string Figure(long? value) => value?.ToString(CultureInfo.InvariantCulture) ?? "-";
}
