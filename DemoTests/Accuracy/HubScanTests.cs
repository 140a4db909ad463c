using System;
using System.Collections.Generic;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// Bodies with 1 to 12 joints of each kind, over mass ratios and numbers of sweeps: none gains energy. Joints on one body are coupled all with all,
/// and bear less than those of a chain as soon as a substep has more than one sweep.
/// </summary>
public class HubScanTests(ITestOutputHelper output)
{
    const double Duration = 4;
    const float HubMass = 4;

    // Each that is treated in a way of its own: up to four joints a body, the first eight with their own order, and many.
    static readonly int[] armCounts = [1, 2, 3, 4, 7, 8, 12];
    static readonly float[] ratios = [.1f, .5f, 2, 5, 10];
    static readonly Dictionary<string, AccuracySettings> efforts = new()
    {
        ["s4"] = new(),
        ["s4 r1"] = new() { RelaxationCount = 1 },
        ["s8 r1"] = new() { SubstepCount = 8, RelaxationCount = 1 },
        ["s16 r1"] = new() { SubstepCount = 16, RelaxationCount = 1 },
        ["i2"] = new() { VelocityIterationCount = 2 },
        ["i3"] = new() { VelocityIterationCount = 3 },
    };

    public static TheoryData<HubJoint, bool, string> Cases()
    {
        var cases = new TheoryData<HubJoint, bool, string>();
        foreach (var joint in Enum.GetValues<HubJoint>())
            foreach (string effort in efforts.Keys)
                foreach (bool isPost in (ReadOnlySpan<bool>)[true, false])
                    cases.Add(joint, isPost, effort);
        return cases;
    }

    /// <summary>A part of a hundred of all that there is stands for what the integration of swings and turns is wrong by.</summary>
    [Theory]
    [MemberData(nameof(Cases))]
    public void A_hub_gains_no_energy(HubJoint joint, bool isPost, string effort)
    {
        double worst = double.NegativeInfinity;
        string where = "";
        foreach (int arms in armCounts)
        {
            foreach (float ratio in ratios)
            {
                double gain = Gain(efforts[effort], joint, arms, ratio, isPost);
                if (gain <= worst)
                    continue;
                worst = gain;
                where = FormattableString.Invariant($"{arms} arms of {ratio * HubMass} kg");
            }
        }
        output.WriteLine(FormattableString.Invariant($"{joint}, {(isPost ? "post" : "free")}, {effort}: at most {100 * worst:G3} %, {where}"));
        Assert.True(worst < .01, FormattableString.Invariant($"{where} gained {100 * worst:G3} %"));
    }

    static double Gain(AccuracySettings settings, HubJoint joint, int armCount, float ratio, bool isPost)
    {
        using var world = new AccuracyWorld(settings with { Gravity = isPost ? settings.Gravity : default, Contacts = ContactScope.None });
        var hub = new Hub(world, joint, armCount, ratio * HubMass, HubMass, isPost);
        double start = hub.Energy, highest = start;
        world.Run(Duration, () => highest = Tally.Most(highest, hub.Energy));
        return double.IsNaN(highest) ? double.PositiveInfinity : (highest - start) / (isPost ? hub.Scale : start);
    }
}
