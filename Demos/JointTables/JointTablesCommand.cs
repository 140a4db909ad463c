using System;
using System.Collections.Generic;
using System.CommandLine;
using System.IO;
using System.Linq;
using Demos.Accuracy;
using Demos.Engine;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.JointTables;

/// <summary>The command that measures joints over substeps and sweeps, beside bepuphysics2 where it is told where that is.</summary>
static class JointTablesCommand
{
    const string Word = "joints", RowsOption = "--rows";

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var names = new Argument<string[]>("table")
        {
            Description = $"Of {string.Join(", ", JointTable.All.Select(table => table.Name))} [default: all].",
            Arity = ArgumentArity.ZeroOrMore,
        };
        Option<string?> peer = PeerProgram.CreateOption("measure beside");
        var page = new Option<string?>("--page") { Description = "Page to write the tables to.", HelpName = "FILE" };
        var rows = new Option<bool>(RowsOption) { Description = "Writes rows for a program, as they come.", Hidden = true };
        var command = new Command(Word, "Measures pendulums, linkages and loaded chains over substeps and sweeps.");
        command.Arguments.Add(names);
        foreach (Option option in (Option[])[peer, page, rows])
            command.Options.Add(option);
        command.SetAction(parsed => guard(parsed, () =>
        {
            JointTable[] tables = Choose(parsed.GetValue(names) ?? []);
            if (parsed.GetValue(page) is string path)
                OutputFile.CheckWritable(path);
            TextWriter output = parsed.InvocationConfiguration.Output;
            if (parsed.GetValue(rows))
            {
                Run(tables, row => output.WriteLine(row.Line));
                return DemosCommand.Finished;
            }
            var measured = new List<JointTableRow>();
            if (parsed.GetValue(peer) is string programOrFolder)
                RunPeer(PeerProgram.Find(programOrFolder), tables, measured.Add);
            Run(tables, measured.Add);
            JointTablesPage.Write(output, tables, measured);
            if (parsed.GetValue(page) is string file)
            {
                using var writer = new StreamWriter(file) { NewLine = "\n" };
                writer.WriteLine(JointTablesPage.Heading.ReplaceLineEndings("\n"));
                JointTablesPage.Write(writer, tables, measured);
            }
            return DemosCommand.Finished;
        }));
        return command;
    }

    static JointTable[] Choose(string[] names)
    {
        foreach (string name in names)
        {
            if (JointTable.All.All(table => table.Name != name))
                throw new SceneException($"there is no table '{name}'; there are {string.Join(", ", JointTable.All.Select(table => table.Name))}");
        }
        return [.. JointTable.All.Where(table => names.Length == 0 || names.Contains(table.Name))];
    }

    static void Run(JointTable[] tables, Action<JointTableRow> add)
    {
        foreach (JointTable table in tables)
        {
            foreach ((int iterations, int relaxations) in table.Sweeps.Where(sweeps => sweeps.Relaxations == 0 || EngineTraits.HasRelaxation))
            {
                foreach (int substeps in JointTable.Substeps)
                {
                    // The best of the springs that an engine tries, where it leaves stiffness to the game.
                    double[] best = EngineTraits.TradedSprings.Where(spring => spring != "default" || EngineTraits.TradedSprings.Length == 1)
                        .Select(spring => table.Measure(JointTable.Settings(substeps, (iterations, relaxations), spring)))
                        .MinBy(figures => double.IsNaN(figures[^1]) ? double.PositiveInfinity : Math.Abs(figures[^1]))!;
                    add(new JointTableRow(EngineDefaults.Name, table.Name, substeps, iterations, relaxations, best));
                }
            }
        }
    }

    static void RunPeer(string program, JointTable[] tables, Action<JointTableRow> add) =>
        PeerProgram.Run(program, [Word, RowsOption, .. tables.Select(table => table.Name)], line => add(JointTableRow.Parse(line)));
}
