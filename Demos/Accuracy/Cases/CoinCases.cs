using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>A coin spun on its edge comes to lie flat, and stays so, and gains no energy on the way (R3).</summary>
static class CoinCases
{
    const float Radius = .5f;
    const float Mass = .2f;
    const double Gravity = 9.81f;

    public static IEnumerable<AccuracyCase> All { get; } = new[] { .015f, .03f }.SelectMany(halfHeight => new[] { 5f, 7, 10, 15 }.SelectMany(spin =>
    {
        string scene = FormattableString.Invariant($"coin {2 * halfHeight} m thick, {spin} rad/s");
        return AccuracySuite.AtBothEfforts("R3", $"{scene}, on the way", (settings, result) => RunOnTheWay(settings, halfHeight, spin, result))
            .Concat(AccuracySuite.AtBothEfforts("R3", $"{scene}, at the end", (settings, result) => RunAtTheEnd(settings, halfHeight, spin, result)));
    }));

    /// <summary>The contact stays where it was at the beginning of a step, while the rim rolls on: the coin sinks in, and is pushed out again.</summary>
    static void RunOnTheWay(AccuracySettings settings, float halfHeight, float spin, CaseResult result)
    {
        using var coin = new SpunCoin(settings, halfHeight, spin);
        double first = coin.Energy, least = first, gain = 0, still = 0, lost = 0;
        coin.Settle(() =>
        {
            double energy = coin.Energy;
            gain = Tally.Most(gain, energy - least);
            least = Math.Min(least, energy);
            lost = Tally.Most(lost, -coin.Height);
            if (coin.Spin >= .001)
                still = coin.Time;
        });
        result.Limit("energy gained", gain / first, .01, "%").Note("still after", still, "s").Note("deepest", lost, "m");
    }

    /// <summary>A coin that spins fast stands for longer than this waits, as nothing but rounding and impacts takes its spin.</summary>
    static void RunAtTheEnd(AccuracySettings settings, float halfHeight, float spin, CaseResult result)
    {
        using var coin = new SpunCoin(settings, halfHeight, spin);
        coin.Settle();
        double spinLeft = 0, kineticLeft = 0, heightLeft = 0;
        var place = coin.Position;
        coin.Run(10, () =>
        {
            spinLeft = Tally.Most(spinLeft, coin.Spin);
            kineticLeft = Tally.Most(kineticLeft, coin.Energy - Mass * Gravity * coin.Height);
            heightLeft = Tally.Worst(heightLeft, coin.Height);
        });
        result.Limit("spin left", spinLeft, .001, "rad/s")
            .Limit("energy left", kineticLeft, 1e-6, "J")
            .Limit("height", heightLeft, .001, "m")
            .Limit("drift", (coin.Position - place).Length, .001, "m");
    }

    /// <summary>A coin on its edge that leans a little, spun about the vertical.</summary>
    sealed class SpunCoin : IDisposable
    {
        const double Lean = .15;
        const double SettlingTime = 30;
        readonly AccuracyWorld world;
        readonly BodyHandle coin;
        readonly float halfHeight;
        readonly Double3 inertia;

        public SpunCoin(AccuracySettings settings, float halfHeight, float spin)
        {
            this.halfHeight = halfHeight;
            world = new AccuracyWorld(settings with { Friction = .3f });
            world.AddGround();
            // The axis lies along Z but for the lean; the lowest point of the rim touches the ground.
            double half = Math.PI / 4 + Lean / 2;
            double height = Radius * Math.Cos(Lean) + halfHeight * Math.Sin(Lean);
            var pose = new RigidPose(new(0, (float)height, 0), new((float)Math.Sin(half), 0, 0, (float)Math.Cos(half)));
            coin = world.AddDynamic(new Cylinder(Radius, 2 * halfHeight), Mass, pose, new BodyVelocity(default, new(0, spin, 0)));
            double across = Mass * (Radius * Radius / 4 + halfHeight * halfHeight / 3), along = Mass * Radius * Radius / 2;
            inertia = new(across, along, across);
        }

        public double Time => world.Time;

        public Double3 Position => world.Position(coin);

        /// <summary>Above that of the coin that lies flat.</summary>
        public double Height => Position.Y - halfHeight;

        public double Spin => world.AngularVelocity(coin).Length;

        /// <summary>Above that of the coin that lies flat.</summary>
        public double Energy => world.Energy(coin, Mass, inertia) - Mass * Gravity * halfHeight;

        public void Settle(Action? afterStep = null) => Run(SettlingTime, afterStep);

        public void Run(double seconds, Action? afterStep) => world.Run(seconds, afterStep);

        public void Dispose() => world.Dispose();
    }
}
