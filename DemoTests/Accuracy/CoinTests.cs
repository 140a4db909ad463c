using System;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Demos.Scenes;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>A coin spun on its edge comes to lie flat, and stays so, and gains no energy on the way (R3).</summary>
public class CoinTests(ITestOutputHelper output)
{
    const float Radius = .5f;
    const float Mass = .2f;
    const double Gravity = 9.81f;

    /// <summary>A coin that spins faster stands for longer than the test waits, as nothing but rounding and impacts takes its spin.</summary>
    const float SettlingSpin = 5;

    public static TheoryData<float, float, Effort> Spins()
    {
        var data = new TheoryData<float, float, Effort>();
        foreach (var effort in Enum.GetValues<Effort>())
        {
            foreach (float halfHeight in new[] { .015f, .03f })
            {
                foreach (float spin in new[] { SettlingSpin, 7, 10, 15 })
                    data.Add(halfHeight, spin, effort);
            }
        }
        return data;
    }

    [Theory]
    [MemberData(nameof(Spins))]
    public void R3_ASpunCoinSettles(float halfHeight, float spin, Effort effort)
    {
        const double lean = .15;
        var settings = AccuracySettings.For(effort) with { Friction = .3f };
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        // The axis lies along Z but for the lean; the lowest point of the rim touches the ground.
        double half = Math.PI / 4 + lean / 2;
        double height = Radius * Math.Cos(lean) + halfHeight * Math.Sin(lean);
        var pose = new RigidPose(new(0, (float)height, 0), new((float)Math.Sin(half), 0, 0, (float)Math.Cos(half)));
        var coin = world.AddDynamic(new Cylinder(Radius, 2 * halfHeight), Mass, pose, new BodyVelocity(default, new(0, spin, 0)));

        double across = Mass * (Radius * Radius / 4 + halfHeight * halfHeight / 3), along = Mass * Radius * Radius / 2;
        // Above that of the coin that lies flat.
        double Energy() => world.Energy(coin, Mass, new(across, along, across)) - Mass * Gravity * halfHeight;
        double first = Energy(), least = first, gain = 0, still = 0, lost = 0;
        world.Run(30, () =>
        {
            double energy = Energy();
            gain = Tally.Most(gain, energy - least);
            least = Math.Min(least, energy);
            lost = Tally.Most(lost, halfHeight - world.Position(coin).Y);
            if (world.AngularVelocity(coin).Length >= .001)
                still = world.Time;
        });
        double spinLeft = 0, kineticLeft = 0, heightLeft = 0;
        var place = world.Position(coin);
        world.Run(10, () =>
        {
            spinLeft = Tally.Most(spinLeft, world.AngularVelocity(coin).Length);
            kineticLeft = Tally.Most(kineticLeft, Energy() - Mass * Gravity * (world.Position(coin).Y - halfHeight));
            heightLeft = Tally.Worst(heightLeft, world.Position(coin).Y - halfHeight);
        });
        string scene = FormattableString.Invariant($"coin {2 * halfHeight} m thick, {spin} rad/s");
        // The contact stays where it was at the beginning of a step, while the rim rolls on: the coin sinks in, and is pushed out again.
        new CaseResult("R3", $"{scene}, on the way", settings)
            .Limit("energy gained", gain / first, .01, "%")
            .Note("still after", still, "s")
            .Note("deepest", lost, "m")
            .Finish(output);
        new CaseResult("R3", $"{scene}, at the end", settings)
            .Limit("spin left", spinLeft, .001, "rad/s")
            .Limit("energy left", kineticLeft, 1e-6, "J")
            .Limit("height", heightLeft, .001, "m")
            .Limit("drift", (world.Position(coin) - place).Length, .001, "m")
            .Finish(output);
    }

    /// <summary>Whether the coins of the built-in scene lie flat and still at its end; reported.</summary>
    [Fact]
    public void TheCoinsOfTheScene()
    {
        const float halfHeight = .03f;
        var scene = SceneLibrary.Load("coins", 1);
        using var world = new SceneWorld(scene, 1);
        for (int i = 0; i < scene.Steps; ++i)
            world.Step();
        double spin = 0, speed = 0, height = 0, lean = 0;
        int unsettled = 0;
        ref var set = ref world.Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            ref var state = ref set.MotionStates[i];
            double bodySpin = ((Double3)state.Velocity.Angular).Length;
            var up = ((DoubleQuaternion)state.Pose.Orientation).Rotate(new(0, 1, 0));
            spin = Tally.Most(spin, bodySpin);
            speed = Tally.Most(speed, ((Double3)state.Velocity.Linear).Length);
            height = Tally.Worst(height, state.Pose.Position.Y - halfHeight);
            lean = Tally.Most(lean, Math.Atan2(Math.Sqrt(up.X * up.X + up.Z * up.Z), Math.Abs(up.Y)) * 180 / Math.PI);
            if (bodySpin >= .001)
                ++unsettled;
        }
        new CaseResult("R3", "scene coins", "s4 i1")
            .Limit("unsettled", unsettled, 0)
            .Limit("spin", spin, .001, "rad/s")
            .Limit("speed", speed, .001, "m/s")
            .Limit("height", height, .001, "m")
            .Limit("lean", lean, .5, "degrees")
            .Finish(output);
    }
}
