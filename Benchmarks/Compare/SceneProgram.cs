using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using Demos.Running;
using Demos.Scenes;
using Demos.Terminal;

namespace Benchmarks.Compare;

/// <summary>A program that runs scenes, or tests pairs, and writes their figures; each run is a process of its own.</summary>
sealed class SceneProgram(string assemblyPath)
{
    /// <summary>Exit status of a run whose bodies did not all stay where bodies can be: slow or fast, it has to be told.</summary>
    const int UnsoundStatus = 2;

    /// <summary>Runs one case and reads its figures.</summary>
    /// <param name="arguments">Arguments of the run.</param>
    /// <param name="lanes">Widest vectors that the runtime may use, in floats; null for its own choice.</param>
    public RunJson Run(IEnumerable<string> arguments, int? lanes)
    {
        string path = Path.GetTempFileName();
        try
        {
            var start = new ProcessStartInfo("dotnet") { RedirectStandardOutput = true, RedirectStandardError = true };
            start.ArgumentList.Add(assemblyPath);
            foreach (string argument in arguments)
                start.ArgumentList.Add(argument);
            start.ArgumentList.Add("--json");
            start.ArgumentList.Add(path);
            Widen(start, lanes);
            int status = Execute(start, out string messages);
            if (status == UnsoundStatus)
                Console.Error.WriteLine($"warning: {assemblyPath} lost bodies in {string.Join(' ', arguments)}");
            else if (status != 0)
                throw new CompareException($"{assemblyPath} ended with status {status}: {messages.Trim()}");
            return RunResultJson.Read(path);
        }
        finally
        {
            File.Delete(path);
        }
    }

    // Anything else, which has to end well, and is compiled once and for all.
    void Do(int? lanes, string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet") { RedirectStandardOutput = true, RedirectStandardError = true };
        start.ArgumentList.Add(assemblyPath);
        foreach (string argument in arguments)
            start.ArgumentList.Add(argument);
        // As the programs of Demos and Peer are set up; this one is not, since BenchmarkDotNet has its own way.
        start.Environment["DOTNET_TieredCompilation"] = "0";
        start.Environment["DOTNET_TieredPGO"] = "0";
        Widen(start, lanes);
        int status = Execute(start, out string messages);
        if (status != 0)
            throw new CompareException($"{assemblyPath} ended with status {status}: {messages.Trim()}");
    }

    /// <summary>Runs what writes a table, and reads its rows.</summary>
    /// <param name="lanes">Widest vectors that the runtime may use, in floats; null for its own choice.</param>
    /// <param name="arguments">Arguments of the run, given the file that it is to write, whose cells are separated by commas.</param>
    public string[][] ReadRows(int? lanes, Func<string, string[]> arguments)
    {
        string path = Path.GetTempFileName();
        try
        {
            Do(lanes, arguments(path));
            return [.. File.ReadLines(path).Select(line => line.Split(','))];
        }
        finally
        {
            File.Delete(path);
        }
    }

    static void Widen(ProcessStartInfo start, int? lanes)
    {
        if (lanes is int count)
            start.Environment["DOTNET_MaxVectorTBitWidth"] = FormattableString.Invariant($"{32 * count}");
    }

    /// <summary>The peer's program.</summary>
    /// <param name="programOrFolder">A built program (.dll), or the folder of the peer's two assemblies, for which it is built.</param>
    public static SceneProgram OpenPeer(string programOrFolder)
    {
        try
        {
            return new SceneProgram(PeerProgram.Find(programOrFolder));
        }
        catch (SceneException refusal)
        {
            throw new CompareException(refusal.Message);
        }
    }

    /// <summary>Runs a process to its end. What it writes is read as it comes: a full pipe would stop it.</summary>
    static int Execute(ProcessStartInfo start, out string messages)
    {
        using Process process = Process.Start(start) ?? throw new CompareException($"cannot start {start.FileName}");
        var errors = process.StandardError.ReadToEndAsync();
        string output = process.StandardOutput.ReadToEnd();
        process.WaitForExit();
        string errorText = errors.GetAwaiter().GetResult();
        messages = errorText.Length > 0 ? errorText : output;
        if (process.ExitCode == 0 && errorText.Length > 0)
            Console.Error.Write(errorText);
        return process.ExitCode;
    }
}
