using System;
using System.CommandLine;
using System.IO;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Pages;

/// <summary>The command that writes the pages of the constraints.</summary>
static class ConstraintPagesCommand
{
    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var folder = new Option<string?>("--write")
        {
            Description = "Folder to write the pages and pictures to. Without it, only the list is shown.",
            HelpName = "FOLDER",
        };
        var command = new Command("constraints", "Lists the constraints, or writes a page and a picture of each.");
        command.Options.Add(folder);
        command.SetAction(parsed => guard(parsed, () => Run(parsed.GetValue(folder), parsed.InvocationConfiguration.Output)));
        return command;
    }

    static int Run(string? folder, TextWriter output)
    {
        if (folder is null)
        {
            output.Write(ConstraintPages.Write()[ConstraintPages.Index]);
            return DemosCommand.Finished;
        }
        if (!Directory.Exists(folder))
            throw new SceneException($"there is no folder '{folder}'");
        var files = ConstraintPages.Write();
        foreach (var (name, text) in files)
            File.WriteAllText(Path.Combine(folder, name), text);
        output.WriteLine($"{files.Count} files in {folder}");
        return DemosCommand.Finished;
    }
}
