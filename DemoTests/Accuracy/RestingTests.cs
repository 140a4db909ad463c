using System;
using System.Numerics;
using BepuPhysics;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What rests stays at rest (R1): ten of each shape on each other for a minute, and every shape on every floor.</summary>
public class RestingTests(ITestOutputHelper output)
{
    public static TheoryData<string, Effort> Piles()
    {
        var data = new TheoryData<string, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
        {
            foreach (string name in RestingPile.Names)
                data.Add(name, effort);
        }
        return data;
    }

    [Theory]
    [MemberData(nameof(Piles))]
    public void R1_TenRestForAMinute(string name, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        var pile = new RestingPile(solids, name);
        pile.Run(60);
        pile.Judge(new CaseResult("R1", $"ten: {name}", settings)).Finish(output);
    }

    public static TheoryData<string, string, Effort> FloorCases()
    {
        var data = new TheoryData<string, string, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
        {
            foreach (string floor in (ReadOnlySpan<string>)[.. Floors.Flat, Floors.Boxes])
            {
                foreach (string name in (ReadOnlySpan<string>)[.. Solids.Standing, "sphere", "lying capsule", "lying cylinder"])
                    data.Add(name, floor, effort);
            }
        }
        return data;
    }

    /// <summary>One solid on a floor, and for those that stand a second one on it, turned against each other.</summary>
    [Theory]
    [MemberData(nameof(FloorCases))]
    public void R1_SolidsRestOnFloors(string name, string floor, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        Floors.Add(solids, floor, RigidPose.Identity, -20, 20, 20);
        var pile = new RestingPile(solids);
        if (name is "lying capsule" or "lying cylinder")
            pile.AddLying(name == "lying capsule" ? "capsule" : "wheel", new(0, .2, 0), yaw: .3);
        else
            pile.AddStanding(name, yaw: .3);
        if (Array.IndexOf(Solids.Standing, name) >= 0)
            pile.AddStanding(name, yaw: .9);
        pile.Run(20);
        // Nothing resists what rolls across the gap of two boxes of 40 m: their rounding is a slope of 2e-6 there, and that is millimetres in
        // twenty seconds. Everything else rests, with few substeps too.
        pile.Judge(new CaseResult("R1", $"{name} on {floor}", settings)).Finish(output);
    }

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
