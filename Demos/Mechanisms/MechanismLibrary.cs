using System;
using System.Collections.Generic;
using Demos.Accuracy;

namespace Demos.Mechanisms;

/// <summary>A machine that is known by name.</summary>
/// <param name="Name">As it is asked for.</param>
/// <param name="Summary">What it is, in a line.</param>
/// <param name="Create">Builds it.</param>
sealed record NamedMechanism(string Name, string Summary, Func<AccuracySettings, Mechanism> Create);

/// <summary>All machines.</summary>
static class MechanismLibrary
{
    public static IReadOnlyList<NamedMechanism> All { get; } =
    [
        new("bridge", "24 hinged planks under a ball of 100 kg", s => new Bridge(s)),
        new("car", "suspension, steering and drive: a figure of eight", s => new Car(s)),
        new("newt-block", "a soft block that keeps its volume", s => new NewtBlock(s)),
        new("linkages", "a four-bar, a slider-crank, a platform on six legs", s => new Linkages(s)),
        new("gears", "three geared shafts and a rack", s => new GearTrain(s)),
        new("crane", "a boom that is drawn up, and its load", s => new Crane(s)),
    ];
}
