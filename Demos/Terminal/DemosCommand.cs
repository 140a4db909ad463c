using System;
using System.CommandLine;
using System.Diagnostics;
using System.IO;
using System.Reflection;
using BepuPhysics;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.Engine;
using Demos.JointTables;
using Demos.Levels;
using Demos.Memory;
using Demos.Running;
using Demos.Scenes;
using Demos.Trade;

namespace Demos.Terminal;

/// <summary>The command line: what can be asked for, and what the exit status says.</summary>
public static class DemosCommand
{
    /// <summary>Exit status of a run that ended with every body where it can be.</summary>
    public const int Finished = 0;

    /// <summary>Exit status when the input was bad; the reason is on standard error.</summary>
    public const int BadInput = 1;

    /// <summary>Exit status of a run that lost bodies, or has bodies whose state is not finite.</summary>
    public const int Unsound = 2;

    /// <summary>Exit status of a run that a signal stopped, with its figures so far, as shells have it for Ctrl-C.</summary>
    public const int Stopped = 130;

    /// <summary>Runs the command line and returns the exit status.</summary>
    public static int Run(string[] args) => Run(args, Console.Out, Console.Error);

    /// <summary>As <see cref="Run(string[])"/>, with the messages going to the given writers.</summary>
    public static int Run(string[] args, TextWriter output, TextWriter error)
    {
        var root = new RootCommand("Runs physics scenes without a window and reports what they cost and how well they held.");
        // Not the default handler: it would give a defect of ours the exit status of bad input.
        var configuration = new InvocationConfiguration { Output = output, Error = error, EnableDefaultExceptionHandler = false };
        root.Subcommands.Add(ListCommand());
        root.Subcommands.Add(RunCommand());
        root.Subcommands.Add(BatchCommand.Create(line => root.Parse(line).Invoke(configuration)));
        root.Subcommands.Add(TradeCommand.Create((parsed, action) => Guard(parsed, _ => action())));
        root.Subcommands.Add(TradeCommand.CreateWorker());
        root.Subcommands.Add(JointTablesCommand.Create((parsed, action) => Guard(parsed, _ => action())));
        root.Subcommands.Add(JointTimesCommand.Create((parsed, action) => Guard(parsed, _ => action())));
        root.Subcommands.Add(AccuracyCommand.Create((parsed, action) => Guard(parsed, _ => action())));
        root.Subcommands.Add(MemoryCommand.Create((parsed, action) => Guard(parsed, _ => action())));
        root.Subcommands.Add(LevelCommand.Create((parsed, action) => Guard(parsed, _ => action())));
        foreach (Command command in EngineCommands.Create((parsed, action) => Guard(parsed, _ => action())))
            root.Subcommands.Add(command);
        root.SetAction(parsed => Guard(parsed, report => RunScene(SceneLibrary.DefaultScene, new RunSettings(), null, report)));
        return root.Parse(args).Invoke(configuration);
    }

    static Command ListCommand()
    {
        var command = new Command("list", "Lists the built-in scenes.");
        command.SetAction(parsed =>
        {
            var table = new TextTable("scene", "content") { IsHeadless = true };
            foreach (BuiltInScene scene in SceneLibrary.Scenes)
                table.Add(scene.Name, scene.Summary);
            table.WriteText(parsed.InvocationConfiguration.Output);
            return Finished;
        });
        return command;
    }

    static Command RunCommand()
    {
        var options = new RunOptions();
        var sceneArgument = new Argument<string>("scene") { Description = "Name of a built-in scene, or path of a .scene file." };
        var jsonOption = new Option<string?>("--json") { Description = "File to write the figures to, as JSON.", HelpName = "FILE" };
        var command = new Command("run", "Runs one scene.");
        command.Arguments.Add(sceneArgument);
        command.Options.Add(jsonOption);
        options.AddTo(command);
        command.SetAction(parsed => Guard(parsed, report =>
            RunScene(parsed.GetRequiredValue(sceneArgument), options.Read(parsed), parsed.GetValue(jsonOption), report)));
        return command;
    }

    static int RunScene(string nameOrPath, RunSettings settings, string? jsonPath, RunReport report)
    {
        SceneDescription scene = SceneLibrary.Load(nameOrPath, settings.Seed);
        // Found out now rather than after minutes of simulation.
        if (jsonPath is not null)
            OutputFile.CheckWritable(jsonPath);
        using var run = new SceneRun(scene, settings);
        using var signal = new StopSignal();
        RunResult result = report.RunWithProgress(run, scene.Name, settings.Steps ?? scene.Steps, signal.Token);
        if (jsonPath is not null)
            RunResultJson.Write(jsonPath, result);
        report.Write(result);
        if (!result.IsSound)
            return Unsound;
        return result.IsStopped ? Stopped : Finished;
    }

    /// <summary>Turns what is wrong with the input into a line on standard error. Anything else is a defect and shows its trace.</summary>
    static int Guard(ParseResult parsed, Func<RunReport, int> action)
    {
        InvocationConfiguration configuration = parsed.InvocationConfiguration;
        try
        {
            WarnOfUnoptimized(configuration.Error, typeof(Simulation).Assembly);
            WarnOfUnoptimized(configuration.Error, typeof(BufferPool).Assembly);
            return action(new RunReport(configuration.Output));
        }
        catch (Exception error) when (error is SceneException or IOException or UnauthorizedAccessException)
        {
            configuration.Error.WriteLine($"error: {error.Message}");
            return BadInput;
        }
    }

    /// <summary>One of an engine's assemblies built for debugging makes every time meaningless, and nothing else would show it.</summary>
    static void WarnOfUnoptimized(TextWriter error, Assembly assembly)
    {
        if (assembly.GetCustomAttribute<DebuggableAttribute>() is { IsJITOptimizerDisabled: true })
            error.WriteLine($"warning: {assembly.GetName().Name} was compiled without optimization, its times mean nothing");
    }
}
