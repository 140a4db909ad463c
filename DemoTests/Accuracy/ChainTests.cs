using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// A chain of 100 links with a load at its end (J3). Reported: the error depends on how much stiffness the substep allows.
/// </summary>
public class ChainTests(ITestOutputHelper output)
{
    const int LinkCount = 100;
    const float LinkLength = .2f;

    /// <summary>How the chain begins. Exactly straight is the worst case for a stiff solver: nothing can buckle away.</summary>
    public enum Start
    {
        HangingStraight,
        HangingKicked,
        HorizontalStraight,
        HorizontalZigzag,
    }

    public static TheoryData<Start, float, Effort> Chains()
    {
        var chains = new TheoryData<Start, float, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
            foreach (var start in Enum.GetValues<Start>())
                foreach (float load in new[] { 1f, 100, 1000 })
                    chains.Add(start, load, effort);
        return chains;
    }

    [Theory]
    [MemberData(nameof(Chains))]
    public void J3_LoadedChain(Start start, float load, Effort effort)
    {
        var settings = AccuracySettings.For(effort) with { Contacts = ContactScope.None };
        using var world = new AccuracyWorld(settings);
        var chain = new BodyHandle[LinkCount + 1];
        Build(world, start, load, chain);
        double stretchSum = 0, worst = 0;
        int samples = 0;
        // The second half counts: by then a hanging chain has settled and a falling one has swung through.
        world.Run(5, () => Gaps(world, chain, out _, ref worst));
        world.Run(5, () =>
        {
            Gaps(world, chain, out double stretch, ref worst);
            stretchSum += stretch;
            ++samples;
        });
        new CaseResult("J3", FormattableString.Invariant($"{start}, 1:{load}"), settings)
            .Limit("mean stretch", stretchSum / samples, .01, "%")
            .Limit("worst gap", worst, .02, "m")
            .Finish(output, enforce: false);
    }

    static void Build(AccuracyWorld world, Start start, float load, BodyHandle[] chain)
    {
        bool hanging = start is Start.HangingStraight or Start.HangingKicked;
        var straight = hanging ? -Vector3.UnitY : Vector3.UnitX;
        var spring = world.Settings.Spring;
        var link = new Capsule(.05f, LinkLength - .1f);
        var joint = world.AddAnchor(Vector3.Zero);
        var jointOffset = Vector3.Zero;
        var end = Vector3.Zero;
        for (int i = 0; i <= LinkCount; ++i)
        {
            // Links lie along their local Y, so that the last joint's offset is +Y of each.
            float bend = start == Start.HorizontalZigzag ? (i % 2 == 0 ? .02f : -.02f) : 0;
            var direction = bend == 0 ? straight : Vector3.Normalize(straight + new Vector3(0, bend, bend));
            var orientation = hanging ? Quaternion.Identity : FromMinusY(direction);
            float half = LinkLength / 2;
            var pose = new RigidPose(end + direction * half, orientation);
            chain[i] = i < LinkCount ? world.AddDynamic(link, 1, pose) : world.AddDynamic(new Sphere(half), load, pose);
            var socket = new BallSocket { LocalOffsetA = jointOffset, LocalOffsetB = new Vector3(0, half, 0), SpringSettings = spring };
            world.Simulation.Solver.Add(joint, chain[i], socket);
            (joint, jointOffset) = (chain[i], new Vector3(0, -half, 0));
            end += direction * LinkLength;
        }
        if (start == Start.HangingKicked)
            world.Bodies[chain[LinkCount]].Velocity.Linear = new Vector3(.5f, 0, .25f);
    }

    /// <summary>Turns -Y into a direction.</summary>
    static Quaternion FromMinusY(Vector3 direction)
    {
        var axis = Vector3.Cross(-Vector3.UnitY, direction);
        return Quaternion.CreateFromAxisAngle(Vector3.Normalize(axis), MathF.Atan2(axis.Length(), -direction.Y));
    }

    /// <summary>Mean gap of the joints as a part of a link's length, and the worst gap so far in metres.</summary>
    static void Gaps(AccuracyWorld world, BodyHandle[] chain, out double meanStretch, ref double worst)
    {
        double sum = 0;
        var end = Double3.Zero;
        foreach (var body in chain)
        {
            var half = world.Orientation(body).Rotate(new(0, LinkLength / 2, 0));
            double gap = (world.Position(body) + half - end).Length;
            sum += gap;
            worst = Tally.Most(worst, gap);
            end = world.Position(body) - half;
        }
        meanStretch = sum / chain.Length / LinkLength;
    }
}
