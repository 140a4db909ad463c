using System;
using System.Collections.Generic;
using System.CommandLine;

namespace Demos.Engine;

/// <summary>Commands that only this engine can carry out: there are none.</summary>
static class EngineCommands
{
    public static IEnumerable<Command> Create(Func<ParseResult, Func<int>, int> guard) => [];
}
