using System.Collections.Generic;

namespace Demos.Accuracy.Cases;

/// <summary>A pendulum of 1 m, let go at the horizontal (J1): period by the arithmetic-geometric mean, energy and joint gap over a minute.</summary>
static class PendulumCases
{
    public static IEnumerable<AccuracyCase> All { get; } = AccuracySuite.AtBothEfforts("J1", "pendulum from the horizontal", Run);

    static void Run(AccuracySettings settings, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        var pendulum = new Pendulum(world);
        world.Run(60, pendulum.Observe);
        result.Limit("period", pendulum.Period / Pendulum.TruePeriod - 1, .01, "%")
            .Limit("energy", pendulum.EnergyError, .05, "%")
            .Limit("gap", pendulum.Gap, .005, "m")
            .Note("energy at the end", pendulum.EnergyErrorNow, "%");
    }
}
