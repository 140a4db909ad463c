using System;
using System.CommandLine;
using System.Globalization;
using System.IO;
using Demos.Engine;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Memory;

/// <summary>The command that says how much memory a body takes, of the system and of the pool, beside bepuphysics2 where it is told where that is.</summary>
static class MemoryCommand
{
    const string Word = "memory", RowOption = "--row", SleepOption = "--sleep";
    const float SleepThreshold = 0.01f;

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var bodies = new Option<int>("--bodies") { Description = "Boxes that lie on a ground, apart from each other.", DefaultValueFactory = _ => 100_000 };
        var steps = new Option<int>("--steps") { Description = "Steps before memory is looked at.", DefaultValueFactory = _ => 600 };
        var threads = new Option<int>("--threads") { Description = "Threads that step.", DefaultValueFactory = _ => 1 };
        var sleep = new Option<bool>(SleepOption) { Description = "Boxes that rest fall asleep; they stay awake otherwise." };
        Option<string?> peer = PeerProgram.CreateOption("measure beside");
        var row = new Option<bool>(RowOption) { Description = "Writes a row for a program.", Hidden = true };
        var command = new Command(Word, "Measures the memory that a body takes: resident, at most, held by pools, and lent by them.")
        {
            bodies, steps, threads, sleep, peer, row,
        };
        command.SetAction(parsed => guard(parsed, () =>
        {
            int bodyCount = parsed.GetValue(bodies), stepCount = parsed.GetValue(steps), threadCount = parsed.GetValue(threads);
            if (bodyCount is < 1 or > 4_000_000 || stepCount is < 1 or > 1_000_000 || threadCount is < 1 or > 1024)
                throw new SceneException("bodies have to be from 1 to 4,000,000, steps from 1 to 1,000,000, threads from 1 to 1,024");
            bool sleeps = parsed.GetValue(sleep);
            TextWriter output = parsed.InvocationConfiguration.Output;
            if (parsed.GetValue(row))
            {
                output.WriteLine(string.Join(';', Cells(MemoryRun.Measure(bodyCount, stepCount, threadCount, sleeps ? SleepThreshold : -1))));
                return DemosCommand.Finished;
            }
            var table = new TextTable("engine", ">resident, B a body", ">at most", ">held by pools", ">lent by them");
            // A program of its own for each: what one has left behind is not counted as the other's.
            table.Add(RunRow(typeof(MemoryCommand).Assembly.Location, bodyCount, stepCount, threadCount, sleeps));
            if (parsed.GetValue(peer) is string programOrFolder)
                table.Add(RunRow(PeerProgram.Find(programOrFolder), bodyCount, stepCount, threadCount, sleeps));
            table.Write(output);
            return DemosCommand.Finished;
        }));
        return command;
    }

    static string[] Cells(in MemoryFigures figures) =>
        [EngineDefaults.Name, Text(figures.Resident), Text(figures.Peak), Text(figures.Held), figures.Lent is double lent ? Text(lent) : "-"];

    static string Text(double bytes) => bytes.ToString("0", CultureInfo.InvariantCulture);

    static string[] RunRow(string program, int bodies, int steps, int threads, bool sleeps)
    {
        string[] cells = [];
        string[] sleep = sleeps ? [SleepOption] : [];
        PeerProgram.Run(program, [Word, RowOption, "--bodies", Number(bodies), "--steps", Number(steps), "--threads", Number(threads), .. sleep],
            line => cells = line.Split(';'));
        return cells;
    }

    static string Number(int number) => number.ToString(CultureInfo.InvariantCulture);
}
