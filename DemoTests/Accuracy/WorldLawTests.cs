using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What happens does not depend on who looks: through a mirror, from a train, from nearby, at bodies in another order.</summary>
public class WorldLawTests(ITestOutputHelper output)
{
    const int Steps = 64;

    static readonly LawBody floor = new(new(40, 1, 40), new(0, -.5f, 0), IsFixed: true);
    static readonly LawBody anchor = new(new(.05f, 0, 0), new(0, 3, 0), IsFixed: true);
    static readonly LawBody tumbler = new(new(1, .6f, .8f), new(.1f, 1.2f, .05f), Turn: Quaternion.CreateFromYawPitchRoll(.2f, .3f, .1f));

    static readonly Dictionary<string, LawScene> scenes = new()
    {
        ["drop"] = new([floor, tumbler], []),
        ["slide"] = new([floor, new(new(1, .6f, .8f), new(0, .3f, 0), new(3, 0, 1), Turn: Quaternion.CreateFromYawPitchRoll(.4f, 0, 0))], []),
        ["roll"] = new([floor, new(new(.4f, 0, 0), new(0, .4f, 0), new(2, 0, 1))], [], Friction: .3f),
        ["stack"] = new(
            [floor, .. Enumerable.Range(0, 6).Select(i => new LawBody(
                new(1, .5f, 1), new(.05f * (i % 2), .25f + .5f * i, .03f * (i % 3)), Turn: Quaternion.CreateFromYawPitchRoll(.1f * i, 0, 0)))], []),
        ["bounce"] = new([floor, tumbler, new(new(.3f, 0, 0), new(3, 1.5f, .05f), new(1, 0, .5f))], [], Restitution: .7f),
        ["tiles"] = new(
            [.. Enumerable.Range(0, 4).Select(i => new LawBody(new(2, 1, 2), new(2 * (i % 2) - 1, -.5f, 2 * (i / 2) - 1), IsFixed: true)),
                new(new(1, .6f, .8f), new(.1f, 1.2f, .05f))], [], Restitution: 1),
        ["break"] = new(
            [new(new(.5f, 0, 0), new(-.501f, 0, 0)), new(new(.5f, 0, 0), new(.501f, 0, 0)), new(new(.5f, 0, 0), new(0, 1.2f, 0), new(0, -1, 0))], [],
            Restitution: 1, Friction: 0, Gravity: 0),
        ["pendulum"] = new([anchor, new(new(.2f, 0, 0), new(1, 3, .3f))], [new(new(0, 3, 0))]),
        ["chain"] = new(
            [anchor, .. Enumerable.Range(0, 5).Select(i => new LawBody(new(.3f, .1f, .1f), new(.4f * i + .3f, 3, 0)))],
            [.. Enumerable.Range(0, 5).Select(i => new LawJoint(new(.4f * i + .1f, 3, 0)))]),
        ["hinge"] = new(
            [anchor, new(new(1, .2f, .5f), new(.6f, 3, .1f), Spin: new(1, 2, .5f))],
            [new(new(.05f, 3, 0), Vector3.Normalize(new(.2f, .3f, 1)))]),
    };

    public static TheoryData<string> Scenes() => [.. scenes.Keys];

    // Of bodies of a metre: who is turned by a rounding lands a little otherwise.
    [Theory, MemberData(nameof(Scenes))]
    public void Mirror_shows_the_mirrored_motion(string scene) => AssertAlike(scene, new() { IsMirrored = true }, new(), 1e-3);

    [Theory, MemberData(nameof(Scenes))]
    public void Order_of_adding_means_nothing(string scene) => AssertAlike(scene, new() { IsReversed = true }, new(), 1e-3);

    [Theory, MemberData(nameof(Scenes))]
    public void Floor_that_rests_may_be_a_body(string scene) => AssertAlike(scene, new() { HasKinematicFloors = true }, new(), 1e-3);

    // A power of two changes no rounding: any difference is a number somewhere that should have been relative.
    [Theory, MemberData(nameof(Scenes))]
    public void Size_means_nothing(string scene)
    {
        AssertAlike(scene, new() { Scale = 1 / 64f }, new(), 0);
        AssertAlike(scene, new() { Scale = 64 }, new(), 0);
    }

    [Theory, MemberData(nameof(Scenes))]
    public void Train_carries_all_alike(string scene)
    {
        foreach (var velocity in new Vector3[] { new(4, 0, -2), new(0, 2, 0), new(30, 0, 0), new(0, 0, 300) })
            AssertAlike(scene, new() { Velocity = velocity, HasKinematicFloors = true }, new() { HasKinematicFloors = true }, 2e-3);
    }

    void AssertAlike(string name, Outlook one, Outlook other, double tolerance)
    {
        using var first = new LawWorld(scenes[name], one);
        using var second = new LawWorld(scenes[name], other);
        double worst = 0;
        for (int i = 0; i < Steps; ++i)
        {
            first.Step();
            second.Step();
            worst = Math.Max(worst, first.Points().Zip(second.Points(), (a, b) => (double)(a - b).Length()).Max());
        }
        output.WriteLine($"{one}: {worst:g3} m");
        Assert.InRange(worst, 0, tolerance);
    }
}
