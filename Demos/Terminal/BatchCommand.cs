using System;
using System.CommandLine;
using System.IO;

namespace Demos.Terminal;

/// <summary>Several commands in one process, which compiles the engine once for all of them.</summary>
static class BatchCommand
{
    /// <summary>Begins the line that follows what a command wrote; its exit status ends it.</summary>
    public const string StatusPrefix = "exit status ";

    /// <param name="run">Runs a command line and returns its exit status.</param>
    public static Command Create(Func<string, int> run)
    {
        var command = new Command("batch", "Runs the commands that standard input holds, one a line, and writes the exit status after each.");
        command.SetAction(parsed => Run(Console.In, parsed.InvocationConfiguration.Output, run));
        return command;
    }

    /// <summary>Runs all lines that are not empty.</summary>
    /// <returns>The greatest status of any command; that of a success where there was none.</returns>
    public static int Run(TextReader input, TextWriter output, Func<string, int> run)
    {
        int greatest = DemosCommand.Finished;
        while (input.ReadLine() is string line)
        {
            if (string.IsNullOrWhiteSpace(line))
                continue;
            int status = run(line);
            output.WriteLine($"{StatusPrefix}{status}");
            output.Flush();
            greatest = Math.Max(greatest, status);
        }
        return greatest;
    }
}
