using System;
using System.CommandLine;
using System.IO;
using System.Linq;
using Demos.Accuracy;
using Demos.Scenes;
using Demos.Terminal;

namespace Demos.Mechanisms;

/// <summary>The command that runs machines and says what is true of them.</summary>
static class MechanismCommand
{
    public static Command Create(Func<ParseResult, Func<int>, int> guard)
    {
        var names = new Argument<string[]>("machines") { Description = "Names of machines. Without any: all.", Arity = ArgumentArity.ZeroOrMore };
        var substeps = new Option<int>("--substeps")
        {
            Description = "Substeps per step.",
            DefaultValueFactory = _ => new AccuracySettings().SubstepCount,
        };
        var command = new Command("mechanisms", "Runs machines of joints and checks what must be true of them.");
        command.Arguments.Add(names);
        command.Options.Add(substeps);
        command.SetAction(parsed => guard(parsed, () =>
            Run(parsed.GetValue(names) ?? [], parsed.GetValue(substeps), parsed.InvocationConfiguration.Output)));
        return command;
    }

    static int Run(string[] names, int substeps, TextWriter output)
    {
        foreach (string name in names)
        {
            if (MechanismLibrary.All.All(machine => machine.Name != name))
                throw new SceneException($"there is no machine '{name}'; there are {string.Join(", ", MechanismLibrary.All.Select(m => m.Name))}");
        }
        if (substeps is < 1 or > 10_000)
            throw new SceneException($"the setting substeps cannot be {substeps}");
        bool isSound = true;
        foreach (NamedMechanism machine in MechanismLibrary.All.Where(machine => names.Length == 0 || names.Contains(machine.Name)))
        {
            using Mechanism mechanism = machine.Create(new AccuracySettings { SubstepCount = substeps });
            mechanism.Run();
            output.WriteLine($"{machine.Name}: {machine.Summary}");
            foreach (Finding finding in mechanism.Findings)
            {
                string judgement = finding.Holds ? "    " : "NOT ";
                output.WriteLine(FormattableString.Invariant(
                    $"  {judgement}{finding.What,-66} {finding.Figure,10:0.00000}  ({finding.Least:0.#####} to {finding.Most:0.#####})"));
                isSound &= finding.Holds;
            }
        }
        return isSound ? DemosCommand.Finished : DemosCommand.Unsound;
    }
}
