using System;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using Demos.Engine;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Levels;

/// <summary>The command that says what a level of triangles costs, beside bepuphysics2 where it is told where that is.</summary>
static class LevelCommand
{
    const string Word = "levels", RowOption = "--row", RepetitionOption = "--repetitions", ThreadOption = "--threads";

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var repetitions = new Option<int>(RepetitionOption)
        {
            Description = "Times that each is done in a run; the least counts.",
            DefaultValueFactory = _ => 20,
        };
        var runs = new Option<int>("--runs")
        {
            Description = "Runs of each program, in turn; the least of each figure counts.",
            DefaultValueFactory = _ => 3,
        };
        var threads = new Option<int>(ThreadOption) { Description = "Threads to build with; rays are cast by one.", DefaultValueFactory = _ => 1 };
        Option<string?> peer = PeerProgram.CreateOption("measure beside");
        var row = new Option<bool>(RowOption) { Description = "Writes a row for a program.", Hidden = true };
        var command = new Command(Word, "Measures what a mesh of 131,072 triangles costs: to build, and per ray.") { repetitions, runs, threads, peer, row };
        command.SetAction(parsed => guard(parsed, () =>
        {
            int repetitionCount = parsed.GetValue(repetitions), runCount = parsed.GetValue(runs), threadCount = parsed.GetValue(threads);
            if (repetitionCount is < 1 or > 10_000 || runCount is < 1 or > 1_000 || threadCount is < 1 or > 1024)
                throw new SceneException("repetitions have to be from 1 to 10,000, runs from 1 to 1,000, threads from 1 to 1,024");
            if (parsed.GetValue(row))
            {
                LevelFigures figures = LevelRun.Measure(repetitionCount, threadCount);
                double[] numbers = [figures.Build, figures.Slanted, figures.Grazing, figures.HitShare];
                parsed.InvocationConfiguration.Output.WriteLine(
                    string.Join(';', [EngineDefaults.Name, .. numbers.Select(number => number.ToString("R", CultureInfo.InvariantCulture))]));
                return DemosCommand.Finished;
            }
            string ours = typeof(LevelCommand).Assembly.Location;
            string[] programs = parsed.GetValue(peer) is string folder ? [ours, PeerProgram.Find(folder)] : [ours];
            var names = new string[programs.Length];
            var least = new double[programs.Length][];
            for (int run = 0; run < runCount; ++run)
            {
                for (int i = 0; i < programs.Length; ++i)
                {
                    PeerProgram.Run(programs[i], [Word, RowOption, RepetitionOption, Text(repetitionCount, "0"), ThreadOption, Text(threadCount, "0")], line =>
                    {
                        string[] cells = line.Split(';');
                        double[] numbers = [.. cells.Skip(1).Select(cell => double.Parse(cell, CultureInfo.InvariantCulture))];
                        names[i] = cells[0];
                        least[i] = least[i] is double[] known ? [.. known.Zip(numbers, Math.Min)] : numbers;
                    });
                }
            }
            var table = new TextTable("engine", ">build, s per million", ">slanted rays, million/s", ">grazing", ">of them hit");
            for (int i = 0; i < programs.Length; ++i)
                table.Add(names[i], Text(least[i][0], "0.000"), Text(1e3 / least[i][1], "0.00"), Text(1e3 / least[i][2], "0.00"), Text(least[i][3], "P1"));
            table.Write(parsed.InvocationConfiguration.Output);
            return DemosCommand.Finished;
        }));
        return command;
    }

    static string Text(double number, string format) => number.ToString(format, CultureInfo.InvariantCulture);
}
