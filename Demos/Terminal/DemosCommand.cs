using System;
using System.CommandLine;
using System.Globalization;
using System.IO;
using Demos.Running;
using Demos.Scenes;

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

    /// <summary>Runs the command line and returns the exit status.</summary>
    public static int Run(string[] args)
    {
        var root = new RootCommand("Runs physics scenes without a window and reports what they cost and how well they held.");
        var runOptions = new RunOptions();
        root.Subcommands.Add(ListCommand());
        root.Subcommands.Add(RunCommand(runOptions));
        root.SetAction(_ => Guard(() => RunScene(SceneLibrary.DefaultScene, new RunSettings(), null)));
        return root.Parse(args).Invoke();
    }

    static Command ListCommand()
    {
        var command = new Command("list", "Lists the built-in scenes.");
        command.SetAction(_ =>
        {
            foreach (BuiltInScene scene in SceneLibrary.Scenes)
                Console.Out.WriteLine($"{scene.Name,-16}{scene.Summary}");
            return Finished;
        });
        return command;
    }

    static Command RunCommand(RunOptions options)
    {
        var sceneArgument = new Argument<string>("scene") { Description = "Name of a built-in scene, or path of a .scene file." };
        var jsonOption = new Option<string?>("--json") { Description = "File to write the figures to, as JSON.", HelpName = "FILE" };
        var command = new Command("run", "Runs one scene.");
        command.Arguments.Add(sceneArgument);
        command.Options.Add(jsonOption);
        options.AddTo(command);
        command.SetAction(parsed => Guard(() =>
            RunScene(parsed.GetRequiredValue(sceneArgument), options.Read(parsed), parsed.GetValue(jsonOption))));
        return command;
    }

    static int RunScene(string nameOrPath, RunSettings settings, string? jsonPath)
    {
        SceneDescription scene = SceneLibrary.Load(nameOrPath, settings.Seed);
        using var run = new SceneRun(scene, settings);
        RunResult result = RunReport.RunWithProgress(run, scene.Name, settings.Steps ?? scene.Steps);
        if (jsonPath is not null)
            RunResultJson.Write(jsonPath, result);
        RunReport.Write(result);
        return result.IsSound ? Finished : Unsound;
    }

    /// <summary>Turns what is wrong with the input into a line on standard error. Anything else is a defect and may show its trace.</summary>
    static int Guard(Func<int> action)
    {
        try
        {
            return action();
        }
        catch (Exception error) when (error is SceneException or IOException or UnauthorizedAccessException)
        {
            Console.Error.WriteLine(string.Create(CultureInfo.InvariantCulture, $"error: {error.Message}"));
            return BadInput;
        }
    }
}
