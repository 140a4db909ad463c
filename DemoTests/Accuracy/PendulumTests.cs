using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// A pendulum of 1 m, let go at the horizontal (J1): period by the arithmetic-geometric mean, energy and joint gap over a minute.
/// </summary>
public class PendulumTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(Effort.Accurate)]
    [InlineData(Effort.Default)]
    public void J1_Pendulum(Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        var pendulum = new Pendulum(world);
        world.Run(60, pendulum.Observe);
        new CaseResult("J1", "pendulum from the horizontal", settings)
            .Limit("period", pendulum.Period / Pendulum.TruePeriod - 1, .01, "%")
            .Limit("energy", pendulum.EnergyError, .05, "%")
            .Limit("gap", pendulum.Gap, .005, "m")
            .Note("energy at the end", pendulum.EnergyErrorNow, "%")
            .Finish(output, enforce: effort == Effort.Accurate);
    }
}
