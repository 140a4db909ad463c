using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
using System.Linq;
using BepuPhysics;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Governing;

/// <summary>
/// The command that shows what a governor of substeps saves where easy and hard come in turns, beside the least fixed count that holds the same error.
/// </summary>
static class GovernorCommand
{
    const int Least = 2, Greatest = 32;

    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var kind = new Argument<AlternatingKind>("what") { Description = "What is loaded in turns.", DefaultValueFactory = _ => AlternatingKind.Chain };
        var target = new Option<float>("--target") { Description = "Error to hold, mm.", DefaultValueFactory = _ => 1 };
        var copies = new Option<int>("--copies") { Description = "How many side by side.", DefaultValueFactory = _ => 64 };
        var runs = new Option<int>("--runs") { Description = "Runs of each in turn, of whose times the middle one counts.", DefaultValueFactory = _ => 5 };
        var command = new Command("governor", "Shows what a governor of substeps saves where loads come and go.") { kind, target, copies, runs };
        command.SetAction(parsed => guard(parsed, () =>
        {
            Require(parsed.GetValue(target) is > 0 and < 1000, "target", parsed.GetValue(target));
            Require(parsed.GetValue(copies) is > 0 and <= 10_000, "copies", parsed.GetValue(copies));
            Require(parsed.GetValue(runs) is > 0 and <= 1000, "runs", parsed.GetValue(runs));
            Measure(parsed.GetValue(kind), parsed.GetValue(target) / 1000, parsed.GetValue(copies), parsed.GetValue(runs),
                parsed.InvocationConfiguration.Output);
            return DemosCommand.Finished;
        }));
        return command;
    }

    static void Measure(AlternatingKind kind, float target, int copies, int runs, TextWriter output)
    {
        var governor = new SubstepGovernor(target, Least, Greatest);
        (float error, double substeps, _) = Run(kind, 1, Least, governor);
        int holding = Least;
        float fixedError;
        // A governor of one number only reads.
        while ((fixedError = Run(kind, 1, holding, new SubstepGovernor(target, holding, holding)).Error) > target && holding < Greatest)
            ++holding;
        List<double> governed = [], byCount = [];
        for (int i = 0; i < runs; ++i)
        {
            governed.Add(Run(kind, copies, Least, governor).Milliseconds);
            byCount.Add(Run(kind, copies, holding, null).Milliseconds);
        }
        var table = new TextTable("setting", ">error, mm", ">substeps", ">ms/step");
        table.Add("governor", Text(error * 1000, "0.00"), Text(substeps, "0.0"), Text(Median(governed), "0.000"));
        table.Add("fixed", Text(fixedError * 1000, "0.00"), Text(holding, "0.0"), Text(Median(byCount), "0.000"));
        table.Write(output);
        output.WriteLine($"time with the governor over that without: {Text(Median([.. governed.Zip(byCount, (a, b) => a / b)]), "0.00")}");
    }

    static (float Error, double Substeps, double Milliseconds) Run(AlternatingKind kind, int copies, int substeps, SubstepGovernor? governor)
    {
        using var world = new AlternatingWorld(kind, copies, substeps, governor);
        world.Run();
        return (world.Error, world.Substeps, world.Milliseconds);
    }

    static double Median(List<double> values) => values.Order().ElementAt(values.Count / 2);

    static string Text(double value, string format) => value.ToString(format, CultureInfo.InvariantCulture);

    static void Require(bool condition, string setting, object value)
    {
        if (!condition)
            throw new SceneException(FormattableString.Invariant($"the setting {setting} cannot be {value}"));
    }
}
