using System;
using System.Collections.Generic;
using System.CommandLine;
using Demos.Fuzz;
using Demos.Governing;
using Demos.Mechanisms;
using Demos.Pages;
using Demos.Sleeping;
using Demos.Stages;
using Demos.Towers;

namespace Demos.Engine;

/// <summary>Commands that only this engine can carry out: they use what the surface shared with bepuphysics2 does not have.</summary>
static class EngineCommands
{
    /// <summary>The commands.</summary>
    /// <param name="guard">Runs an action and turns what is wrong with the input into a message.</param>
    public static IEnumerable<Command> Create(Func<ParseResult, Func<int>, int> guard) =>
        [
            FuzzCommand.Create(guard), TowersCommand.Create(guard), MechanismCommand.Create(guard), SleepCommand.Create(guard),
            StageCommand.Create(guard), ConstraintPagesCommand.Create(guard), GovernorCommand.Create(guard),
        ];
}
