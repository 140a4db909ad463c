using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Linq;
using System.Text.Json;
using Demos.Engine;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Accuracy;

/// <summary>The command that runs the accuracy suite.</summary>
static class AccuracyCommand
{
    const string BothEfforts = "both";

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var families = new Argument<string[]>("case")
        {
            Description = $"Families of cases: {string.Join(", ", Families())} [default: all].",
            Arity = ArgumentArity.ZeroOrMore,
        };
        var effort = new Option<string>("--effort")
        {
            Description = "default (what a game gets without thinking), accurate (16 relaxed substeps), or both and the cases with settings of their own.",
            DefaultValueFactory = _ => BothEfforts,
        };
        var json = new Option<string?>("--json") { Description = "File to write the figures to, as JSON.", HelpName = "FILE" };
        var page = new Option<string?>("--page") { Description = "Page to write the rows into; it keeps those of other cases.", HelpName = "FILE" };
        var command = new Command("accuracy", "Runs scenes whose truth is known and judges the errors.");
        command.Arguments.Add(families);
        foreach (Option option in (Option[])[effort, json, page])
            command.Options.Add(option);
        command.SetAction(parsed => guard(parsed, () =>
        {
            AccuracyCase[] cases = Choose(parsed.GetValue(families) ?? [], parsed.GetRequiredValue(effort));
            foreach (string? path in (string?[])[parsed.GetValue(json), parsed.GetValue(page)])
            {
                if (path is not null)
                    OutputFile.CheckWritable(path);
            }
            return Run(cases, parsed.GetValue(json), parsed.GetValue(page), parsed.InvocationConfiguration);
        }));
        return command;
    }

    static int Run(AccuracyCase[] cases, string? jsonPath, string? pagePath, InvocationConfiguration terminal)
    {
        using var signal = new StopSignal();
        var results = new List<(AccuracyCase Case, CaseResult Result)>();
        foreach (AccuracyCase subject in cases)
        {
            if (signal.Token.IsCancellationRequested)
                break;
            terminal.Error.WriteLine($"{results.Count} of {cases.Length}: {subject.Name}");
            results.Add((subject, subject.Measure()));
        }
        bool isComplete = results.Count == cases.Length;
        var table = new TextTable("case", "scene", "settings", "measured", "must", "verdict");
        foreach ((AccuracyCase subject, CaseResult result) in results)
            table.Add(subject.Id, subject.Scene, result.Settings, result.Found, result.Must, result.Verdict);
        table.Write(terminal.Output);
        int met = results.Count(entry => entry.Result.IsMet), failed = results.Count(entry => entry.Result.Failure is not null);
        int known = results.Count(entry => !entry.Result.IsMet && entry.Result.KnownMiss is not null);
        terminal.Output.WriteLine($"{met} of {results.Count} met, {known} known not to be, {failed} failed");
        if (jsonPath is not null)
            File.WriteAllText(jsonPath, ToJson(results, isComplete));
        if (pagePath is not null)
            AccuracyPage.Update(pagePath, [.. results.Select(entry => entry.Result)], isComplete);
        return failed > 0 ? DemosCommand.Unsound : isComplete ? DemosCommand.Finished : DemosCommand.Stopped;
    }

    static AccuracyCase[] Choose(string[] families, string effort)
    {
        foreach (string family in families)
        {
            if (!Families().Contains(family))
                throw new SceneException($"the suite has no case '{family}'; it has {string.Join(", ", Families())}");
        }
        if (effort != BothEfforts && !Enum.GetValues<Effort>().Any(value => IsNamed(value, effort)))
            throw new SceneException($"--effort cannot be '{effort}'");
        return [.. AccuracySuite.All.Where(subject =>
            (families.Length == 0 || families.Contains(subject.Id)) &&
            (effort == BothEfforts || (subject.Effort is Effort value && IsNamed(value, effort))))];
    }

    static bool IsNamed(Effort value, string word) => string.Equals(value.ToString(), word, StringComparison.OrdinalIgnoreCase);

    static IEnumerable<string> Families() => AccuracySuite.All.Select(subject => subject.Id).Distinct();

    static string ToJson(List<(AccuracyCase Case, CaseResult Result)> results, bool isComplete) => JsonSerializer.Serialize(
        new AccuracyRunJson(EngineDefaults.Name, isComplete,
        [
            .. results.Select(entry => new AccuracyCaseJson(entry.Case.Id, entry.Case.Scene, entry.Case.Effort?.ToString(), entry.Result.Settings,
                entry.Result.IsMet, entry.Result.KnownMiss,
                [.. entry.Result.Figures.Select(figure => new AccuracyFigureJson(figure.Quantity, Known(figure.Value), Known(figure.Limit), figure.Unit))])),
        ]),
        AccuracyJsonContext.Default.AccuracyRunJson);

    static double? Known(double value) => double.IsFinite(value) ? value : null;
}
