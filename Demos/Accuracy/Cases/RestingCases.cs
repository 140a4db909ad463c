using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics;

namespace Demos.Accuracy.Cases;

/// <summary>What rests stays at rest (R1): ten of each shape on each other for a minute, and every shape on every floor.</summary>
static class RestingCases
{
    static readonly string[] floors = [.. Floors.Flat, Floors.Boxes];
    static readonly string[] onFloors = [.. Solids.Standing, "sphere", "lying capsule", "lying cylinder"];

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. RestingPile.Names.SelectMany(name => AccuracySuite.AtBothEfforts("R1", $"ten: {name}",
            (settings, result) => RunTen(settings, name, result))),
        .. floors.SelectMany(floor => onFloors.SelectMany(name => AccuracySuite.AtBothEfforts("R1", $"{name} on {floor}",
            (settings, result) => RunOnFloor(settings, name, floor, result)))),
    ];

    static void RunTen(AccuracySettings settings, string name, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        using var solids = new Solids(world);
        var pile = new RestingPile(solids, name);
        pile.Run(60);
        pile.Judge(result);
    }

    /// <summary>One solid on a floor, and for those that stand a second one on it, turned against each other.</summary>
    static void RunOnFloor(AccuracySettings settings, string name, string floor, CaseResult result)
    {
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
        pile.Judge(result);
    }
}
