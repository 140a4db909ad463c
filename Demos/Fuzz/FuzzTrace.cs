using System;
using System.Diagnostics;
using System.IO;
using System.Text;
using System.Threading;

namespace Demos.Fuzz;

/// <summary>Says where a run is: in a file that outlives the process, and on standard error when a call does not return.</summary>
sealed class FuzzTrace : IDisposable
{
    const int LineLength = 160;
    static readonly TimeSpan patience = TimeSpan.FromSeconds(120);

    readonly FileStream? file;
    readonly byte[] line = new byte[LineLength];
    readonly Timer watchdog;
    string where = "", call = "";
    long since = Stopwatch.GetTimestamp();

    public FuzzTrace(string? path)
    {
        // No buffer: what is written is with the system when the process dies.
        file = path is null ? null : new FileStream(path, FileMode.Create, FileAccess.Write, FileShare.Read, bufferSize: 0);
        watchdog = new Timer(_ => EndIfStuck(), null, 1000, 1000);
    }

    public void BeginWorld(int seed, int world) => Write(FormattableString.Invariant($"--seed {seed} --world {world}"), "creation");

    public void BeginCall(int number, string name) => Write(where, FormattableString.Invariant($"call {number} {name}"));

    void Write(string newWhere, string newCall)
    {
        where = newWhere;
        call = newCall;
        Volatile.Write(ref since, Stopwatch.GetTimestamp());
        if (file is null)
            return;
        Array.Fill(line, (byte)' ');
        Encoding.UTF8.GetBytes(where + " " + call, line.AsSpan(0, LineLength - 1));
        line[^1] = (byte)'\n';
        file.Position = 0;
        file.Write(line);
    }

    void EndIfStuck()
    {
        if (Stopwatch.GetElapsedTime(Volatile.Read(ref since)) > patience)
            Environment.FailFast($"fuzz: {where} {call} does not return");
    }

    public void Dispose()
    {
        watchdog.Dispose();
        file?.Dispose();
    }
}
