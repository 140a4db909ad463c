using System;
using System.CommandLine;
using System.IO;
using Demos.Scenes;

namespace Demos.Sleeping;

/// <summary>The command that watches a scene fall asleep, and what its steps cost before and after.</summary>
static class SleepCommand
{
    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var scene = new Argument<string>("scene")
        {
            Description = "Name of a scene whose bodies may sleep, or a file.",
            DefaultValueFactory = _ => "many-statics",
        };
        var threads = new Option<int>("--threads") { Description = "Threads that step.", DefaultValueFactory = _ => 1 };
        var steps = new Option<int?>("--steps") { Description = "Steps to watch; the scene's without." };
        var seed = new Option<int>("--seed") { Description = "Seed of scenes by lot.", DefaultValueFactory = _ => 1 };
        var awake = new Option<bool>("--awake") { Description = "Nothing sleeps: what the scene costs then." };
        var repeat = new Option<int>("--repeat") { Description = "Runs, of which each step takes the least time.", DefaultValueFactory = _ => 1 };
        var command = new Command("sleep", "Watches a scene fall asleep, and what its steps cost.") { scene, threads, steps, seed, awake, repeat };
        command.SetAction(parsed => guard(parsed, () =>
        {
            var description = SceneLibrary.Load(parsed.GetValue(scene)!, parsed.GetValue(seed));
            int count = parsed.GetValue(steps) ?? description.Steps;
            SleepRun? best = null;
            for (int i = parsed.GetValue(repeat); i > 0; --i)
            {
                var run = new SleepRun(description, parsed.GetValue(threads), parsed.GetValue(awake));
                run.Step(count);
                run.TakeFastest(best);
                best?.Dispose();
                best = run;
            }
            Report(parsed.InvocationConfiguration.Output, best!, count);
            best!.Dispose();
            return 0;
        }));
        return command;
    }

    static void Report(TextWriter output, SleepRun run, int steps)
    {
        output.WriteLine(FormattableString.Invariant($"{run.BodyCount} bodies, {run.Simulation.Statics.Count} statics, {steps} steps"));
        output.WriteLine(FormattableString.Invariant(
            $"fewest awake: {run.FewestAwake} after step {run.StepOfFewest}, all but those that move; most in the last third: {run.MostAwakeAtEnd}"));
        output.WriteLine(FormattableString.Invariant(
            $"until then: mean {run.MeanUntilAsleep:0.000} ms, worst {run.WorstUntilAsleep:0.000} ms; awake step {run.AwakeStep:0.000} ms"));
        output.WriteLine(FormattableString.Invariant(
            $"after that: mean {run.MeanAfterwards:0.0000} ms, p99 {run.PercentileAfterwards(.99):0.0000} ms, worst {run.PercentileAfterwards(1):0.0000} ms"));
        if (run.Simulation.Bodies.ActiveSet.Count == 0)
        {
            output.WriteLine(FormattableString.Invariant($"a step in which all sleep: {run.MeasureAsleep():0.000} us"));
            var (wake, step) = run.MeasureWaking();
            output.WriteLine(FormattableString.Invariant($"waking all at once: {wake:0.000} ms, the slowest step until they sleep again {step:0.000} ms"));
        }
        output.WriteLine($"{run.Simulation.Awakener.SleepingIslandCount} islands sleep");
        output.WriteLine(FormattableString.Invariant(
            $"{run.PoolBytes / 1e6:0.0} MB, {run.PoolBytes / Math.Max(1.0, run.BodyCount):0} B a body"));
        output.WriteLine(FormattableString.Invariant($"cost of the static tree over that of a new one: {run.CompareTree():0.000}"));
        output.WriteLine($"hash {run.Simulation.StateHash():x16}");
    }
}
