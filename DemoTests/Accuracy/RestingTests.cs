using System.Numerics;
using BepuPhysics;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What rests stays at rest (R1), and the back of a one-sided triangle carries nothing.</summary>
public class RestingTests(ITestOutputHelper output)
{
    [Theory, SuiteData("R1")]
    public void Case(string name) => SuiteCases.Judge(name, output);

    /// <summary>The back of a one-sided triangle is not there: what falls on it falls as freely as beside it.</summary>
    [Theory]
    [InlineData("box")]
    [InlineData("sphere")]
    [InlineData("capsule")]
    [InlineData("cylinder")]
    [InlineData("coin")]
    [InlineData("cube hull")]
    [InlineData("random hull")]
    public void TheBackOfAOneSidedTriangleHoldsNothing(string name)
    {
        var settings = AccuracySettings.For(Effort.Default);
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        // Upside down: half a turn about X.
        Floors.Add(solids, Floors.Triangle, new RigidPose(Vector3.Zero, new Quaternion(1, 0, 0, 0)), -20, 20, 20);
        var start = new Vector3(0, 1.5f, 0);
        var over = solids.Create(name).Place(start);
        var beside = solids.Create(name).Place(start + new Vector3(1000, 0, 0));
        world.Run(2);
        var difference = world.Position(over) + new Double3(1000, 0, 0) - world.Position(beside);
        Assert.True(world.Position(over).Y < -10, $"fell to {world.Position(over).Y} m only");
        Assert.True(difference.Length < 1e-4, $"fell otherwise than beside it, by {difference}");
    }
}
