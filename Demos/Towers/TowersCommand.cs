using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Threading;
using BepuPhysics;
using Demos.Scenes;
using Demos.Terminal;
using Demos.Towers.Trials;

namespace Demos.Towers;

/// <summary>The command that watches whether structures stand.</summary>
static class TowersCommand
{
    const int ReferenceSubsteps = 64;
    static readonly TowerSettings defaults = new();

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var names = new Argument<string[]>("structures")
        {
            Description = "Names of structures and trials; 'cubes*' for all that begin so. Without any: all small ones.",
            Arity = ArgumentArity.ZeroOrMore,
        };
        var seconds = Make("--seconds", "Time that each is watched.", defaults.Seconds);
        var dt = Make("--dt", "Seconds per step.", defaults.StepDuration);
        var random = Make("--random-steps", "Steps of half to twice that length, by lot.", false);
        var substeps = Make("--substeps", "Substeps per step.", defaults.Substeps);
        var iterations = Make("--iterations", "Velocity iterations per substep.", defaults.Iterations);
        var relaxations = Make("--relaxations", "Relaxation sweeps per substep.", defaults.Relaxations);
        var loadPath = Make("--load-path", "Whether loads are handed down to the ground in one go.", defaults.LoadPath);
        var offset = Make("--offset", "How far parts are out of place at most, m.", defaults.Offset);
        var seed = Make("--seed", "Seed of offsets and steps.", defaults.Seed);
        var push = Make("--push", "Speed that the topmost part gets after two seconds, m/s.", defaults.Push);
        var reference = Make("--reference", "Also watches each at 64 relaxed substeps, and says where that ends otherwise.", false);
        var list = Make("--list", "Lists the structures.", false);
        var json = new Option<string?>("--json") { Description = "File to write the figures to, as JSON.", HelpName = "FILE" };
        var command = new Command("towers", "Watches whether structures stand that are built of loose parts.");
        command.Arguments.Add(names);
        foreach (Option option in (Option[])[seconds, dt, random, substeps, iterations, relaxations, loadPath, offset, seed, push, reference, list, json])
            command.Options.Add(option);
        command.SetAction(parsed => guard(parsed, () =>
        {
            TextWriter output = parsed.InvocationConfiguration.Output;
            if (parsed.GetValue(list))
                return List(output);
            var settings = new TowerSettings
            {
                Seconds = parsed.GetValue(seconds),
                StepDuration = parsed.GetValue(dt),
                Steps = parsed.GetValue(random) ? StepPattern.Random : StepPattern.Even,
                Substeps = parsed.GetValue(substeps),
                Iterations = parsed.GetValue(iterations),
                Relaxations = parsed.GetValue(relaxations),
                LoadPath = parsed.GetValue(loadPath),
                Offset = parsed.GetValue(offset),
                Seed = parsed.GetValue(seed),
                Push = parsed.GetValue(push),
            };
            return Run(parsed.GetValue(names) ?? [], settings, parsed.GetValue(reference), parsed.GetValue(json), output);
        }));
        return command;
    }

    static Option<T> Make<T>(string name, string description, T defaultValue) =>
        new(name) { Description = description, DefaultValueFactory = _ => defaultValue };

    static int List(TextWriter output)
    {
        foreach (Structure structure in StructureLibrary.All)
            output.WriteLine($"{structure.Name,-16}{structure.Summary}");
        foreach (Trial trial in StructureLibrary.Trials)
            output.WriteLine($"{trial.Name,-16}{trial.Summary}");
        return DemosCommand.Finished;
    }

    static int Run(string[] names, TowerSettings settings, bool withReference, string? jsonPath, TextWriter output)
    {
        Refuse(settings);
        var (structures, trials) = StructureLibrary.Choose(names);
        if (jsonPath is not null)
            OutputFile.CheckWritable(jsonPath);
        using var signal = new StopSignal();
        var results = new List<TowerResult>();
        int otherwise = 0;
        if (structures.Count > 0)
            output.WriteLine($"{"structure",-16}{"parts",6}  {"",-14}{"lost, mm",10}{"lean, mm",10}{"ms/step",9}");
        foreach (Structure structure in structures)
        {
            TowerResult result = Watch(structure, settings, signal.Token);
            if (signal.Token.IsCancellationRequested)
                break;
            results.Add(result);
            output.Write(Line(result));
            if (withReference && !IsAsReference(structure, settings, result, output, signal.Token))
                ++otherwise;
            output.WriteLine();
        }
        var figures = new List<(Trial Trial, double Figure)>();
        foreach (Trial trial in trials)
        {
            if (signal.Token.IsCancellationRequested)
                break;
            figures.Add((trial, trial.Measure(settings)));
            output.WriteLine(FormattableString.Invariant($"{trial.Name,-16}{figures[^1].Figure:0.00} {trial.Unit}; {trial.Truth:0.00} for rigid bodies"));
        }
        if (jsonPath is not null)
            TowerJson.Write(jsonPath, settings, results, figures);
        if (withReference)
            output.WriteLine($"{otherwise} of {results.Count} end otherwise than the reference");
        return signal.Token.IsCancellationRequested ? DemosCommand.Stopped : DemosCommand.Finished;
    }

    // Where both fall, the times may differ by a tenth.
    static bool IsAsReference(Structure structure, TowerSettings settings, TowerResult result, TextWriter output, CancellationToken stop)
    {
        var bySweeps = settings with { Substeps = ReferenceSubsteps, Iterations = 1, Relaxations = 1, LoadPath = LoadPathMode.Off };
        TowerResult reference = Watch(structure, bySweeps, stop);
        bool isAlike = result.Stands == reference.Stands && !(float.Abs((result.FellAt - reference.FellAt) ?? 0) > .1f * reference.FellAt);
        output.Write($"   reference: {Fate(reference)}{(isAlike ? "" : ", OTHERWISE")}");
        return isAlike;
    }

    static TowerResult Watch(Structure structure, TowerSettings settings, CancellationToken stop)
    {
        using var run = new TowerRun(structure, settings);
        return run.Run(stop);
    }

    static string Line(TowerResult result)
    {
        float lost = result.HeightLost * 1000, lean = result.Lean * 1000;
        return FormattableString.Invariant(
            $"{result.Structure,-16}{result.Parts,6}  {Fate(result),-14}{lost,10:0.0}{lean,10:0.0}{result.MillisecondsPerStep,9:0.000}");
    }

    static string Fate(TowerResult result) => result.FellAt is float time ? FormattableString.Invariant($"fell at {time:0.0}") : "stands";

    static void Refuse(TowerSettings settings)
    {
        Require(settings.Seconds is > 0 and <= 100_000, "seconds", settings.Seconds);
        Require(settings.StepDuration is > 0 and <= .5f, "dt", settings.StepDuration);
        Require(settings.Substeps is > 0 and <= 10_000, "substeps", settings.Substeps);
        Require(settings.Iterations is > 0 and <= 10_000, "iterations", settings.Iterations);
        Require(settings.Relaxations is >= 0 and <= 10_000, "relaxations", settings.Relaxations);
        Require(settings.Offset is >= 0 and <= 1, "offset", settings.Offset);
        Require(float.IsFinite(settings.Push), "push", settings.Push);
    }

    static void Require(bool condition, string setting, object value)
    {
        if (!condition)
            throw new SceneException(FormattableString.Invariant($"the setting {setting} cannot be {value}"));
    }
}
