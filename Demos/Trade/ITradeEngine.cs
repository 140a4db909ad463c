using System;
using System.Collections.Generic;
using System.Threading;

namespace Demos.Trade;

/// <summary>An engine that runs the scenes of the trade, in this process or another.</summary>
interface ITradeEngine : IDisposable
{
    /// <summary>What the engine calls itself.</summary>
    string Name { get; }

    /// <summary>Values of each dial that the engine tries in a scene where nobody says what, by the dial's name.</summary>
    IReadOnlyDictionary<string, string[]> Values(string scene);

    /// <summary>Runs a scene; null when it was stopped.</summary>
    /// <param name="scene">Name of the scene.</param>
    /// <param name="place">Value of each dial.</param>
    /// <param name="steps">Steps to run; all of the scene's when null.</param>
    /// <param name="stop">Ends the run early.</param>
    TradeMeasurement? Measure(string scene, IReadOnlyDictionary<string, string> place, int? steps, CancellationToken stop);
}
