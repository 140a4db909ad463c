using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Text;
using System.Threading;
using Demos.Terminal;

namespace DemoTests.Scenes;

/// <summary>
/// The runner of scenes in a process with vectors of one width. It starts when it is first asked and goes on to the end of the tests, since
/// most of a short run is the time that it takes to compile the engine.
/// </summary>
sealed class LaneRunner(string name, int bits, Func<string> path)
{
    static readonly string program = Path.Combine(AppContext.BaseDirectory, "Demos.dll");

    readonly Lock gate = new();
    readonly StringBuilder errors = new();
    Process? process;

    /// <summary>Vectors of 128 bits.</summary>
    public static LaneRunner Four { get; } = new("4 lanes", 128, () => program);

    /// <summary>Vectors of 256 bits, which the processor must have.</summary>
    public static LaneRunner Eight { get; } = new("8 lanes", 256, () => program);

    /// <summary>Vectors of 512 bits, which the processor must have.</summary>
    public static LaneRunner Sixteen { get; } = new("16 lanes", 512, () => program);

    /// <summary>The stand-in of sixteen lanes, on any processor.</summary>
    public static LaneRunner StandIn { get; } = new("the stand-in of 16 lanes", 128, () => SixteenLanesRunner.Path);

    public string Name => name;

    /// <summary>Runs a command and returns its exit status; that of the process where that ended.</summary>
    /// <param name="arguments">The command; none of them may hold a quotation mark.</param>
    /// <param name="messages">What was written.</param>
    public int Run(string[] arguments, out string messages)
    {
        lock (gate)
        {
            if (process is null || process.HasExited)
                Start();
            process!.StandardInput.WriteLine($"\"{string.Join("\" \"", arguments)}\"");
            var written = new StringBuilder();
            while (process.StandardOutput.ReadLine() is string line)
            {
                if (line.StartsWith(BatchCommand.StatusPrefix, StringComparison.Ordinal))
                {
                    messages = Messages(written);
                    return int.Parse(line.AsSpan(BatchCommand.StatusPrefix.Length), CultureInfo.InvariantCulture);
                }
                written.AppendLine(line);
            }
            process.WaitForExit();
            messages = Messages(written);
            return process.ExitCode;
        }
    }

    string Messages(StringBuilder written)
    {
        lock (errors)
        {
            written.Append(errors);
            errors.Clear();
        }
        return written.ToString();
    }

    void Start()
    {
        process?.Dispose();
        var start = new ProcessStartInfo(Environment.GetEnvironmentVariable("DOTNET_HOST_PATH") ?? "dotnet")
        {
            RedirectStandardInput = true,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        start.ArgumentList.Add(path());
        start.ArgumentList.Add("batch");
        start.Environment["DOTNET_MaxVectorTBitWidth"] = bits.ToString(CultureInfo.InvariantCulture);
        process = Process.Start(start)!;
        // It is read to its end, so that no full pipe stops the child, which ends with its input: at the latest when this process does.
        process.ErrorDataReceived += (_, message) =>
        {
            lock (errors)
                errors.AppendLine(message.Data);
        };
        process.BeginErrorReadLine();
    }
}
