using System;
using System.CommandLine;
using System.IO;
using System.Linq;
using Demos.Terminal;

namespace Demos.JointTables;

/// <summary>The command of a process that measures what constraints cost, for a program that compares engines.</summary>
public static class JointTimesCommand
{
    /// <summary>The word on the command line; then the file for the figures, and names of types.</summary>
    public const string Word = "joint-times";

    internal static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var file = new Argument<string>("file");
        var names = new Argument<string[]>("type") { Arity = ArgumentArity.ZeroOrMore };
        var command = new Command(Word, "Measures what constraints cost.") { Hidden = true };
        command.Arguments.Add(file);
        command.Arguments.Add(names);
        command.SetAction(parsed => guard(parsed, () =>
        {
            string[] asked = parsed.GetValue(names) ?? [];
            // A line for each: type, floats of a vector, nanoseconds of a velocity iteration, and of a substep.
            File.WriteAllLines(parsed.GetRequiredValue(file), (asked.Length > 0 ? asked : JointTimes.Names).Select(JointTimes.Measure)
                .Select(time => FormattableString.Invariant($"{time.Name},{time.Lanes},{time.Solve:R},{time.Substep:R}")));
            return DemosCommand.Finished;
        }));
        return command;
    }
}
