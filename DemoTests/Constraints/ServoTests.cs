using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What holds for every servo: as for joints, within limits of speed and force.</summary>
public abstract class ServoTests<TDescription> : JointTests<TDescription> where TDescription : unmanaged, IConstraintDescription<TDescription>
{
    const float Dt = 1 / 240f;

    private protected abstract TDescription Describe(JointSamples samples, SpringSettings spring, ServoSettings servo);

    private protected sealed override TDescription Describe(JointSamples samples, SpringSettings spring) => Describe(samples, spring, ServoSettings.Default);

    /// <summary>Cases of the type's own.</summary>
    private protected virtual IEnumerable<(string Name, TDescription Description, SampleBody[] Bodies)> OwnDegenerateCases(JointSamples samples) => [];

    private protected sealed override IEnumerable<(string, TDescription, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var own in OwnDegenerateCases(samples))
            yield return own;
        foreach (var force in new[] { 0, 1e-30f, 1, float.MaxValue, float.PositiveInfinity })
        {
            foreach (var (maximum, least) in new[] { (0, 0), (10, 1), (1, 10), (float.MaxValue, 0), (float.PositiveInfinity, 1e7f) })
            {
                var servo = new ServoSettings(maximum, least, force);
                yield return ($"Force {force}, speed {least} to {maximum}", Describe(samples, default, servo), NewBodies(samples));
                yield return ($"At its target, force {force}, speed {least} to {maximum}", Settled(samples, servo, out var bodies), bodies);
            }
        }
    }

    TDescription Settled(JointSamples samples, ServoSettings servo, out SampleBody[] bodies)
    {
        var description = Describe(samples, default, servo);
        bodies = NewBodies(samples);
        Settle(description, bodies);
        return description;
    }

    [Fact]
    public void ForceAndSpeedKeepTheirLimits()
    {
        var samples = new JointSamples(9);
        int stalled = 0, limited = 0;
        for (int trial = 0; trial < 200; ++trial)
        {
            var servo = new ServoSettings(samples.Uniform(0.1f, 3), samples.Uniform(0, 0.1f), samples.Coin() ? samples.Uniform(0.001f, 2) : 1e4f);
            var probe = JointProbes.New<TDescription>();
            probe.Set(0, Describe(samples, default, servo), NewBodies(samples));
            var wanted = Length(probe.PositionError(0)) * Rate;
            for (int i = 0; i < 100; ++i)
            {
                probe.WarmStart(new(0, Dt));
                probe.Solve(new(0, Dt));
                Assert.True(Length(probe.Impulse(0)) <= servo.MaximumForce * Dt * 1.0001, $"{Length(probe.Impulse(0))} N s of {servo.MaximumForce * Dt}");
            }
            stalled += Length(probe.Impulse(0)) > servo.MaximumForce * Dt * 0.999 ? 1 : 0;
            if (servo.MaximumForce < 1e4f || wanted == 0)
                continue;
            // As fast as the spring is, and within the limits of speed.
            var expected = Math.Min(Math.Max(wanted, servo.BaseSpeed), servo.MaximumSpeed);
            limited += expected == servo.MaximumSpeed ? 1 : 0;
            Assert.True(Math.Abs(Length(probe.RelativeVelocity(0)) - expected) <= 1e-3 * (1 + expected), $"{Length(probe.RelativeVelocity(0))}, {expected}");
        }
        Assert.True(stalled > 10 && limited > 10, $"{stalled} were held back by force, {limited} by speed.");
    }

    /// <summary>However small the error, it is approached at the base speed; and not overshot, where it is less than that is in a substep.</summary>
    [Fact]
    public void BaseSpeedIsKept()
    {
        var samples = new JointSamples(10);
        for (int trial = 0; trial < 100; ++trial)
        {
            var servo = new ServoSettings(1e4f, samples.Uniform(200, 2000), 1e6f);
            var probe = JointProbes.New<TDescription>();
            probe.Set(0, Describe(samples, default, servo), NewBodies(samples));
            var error = Length(probe.PositionError(0));
            for (int i = 0; i < 60; ++i)
            {
                probe.WarmStart(new(0, Dt));
                probe.Solve(new(0, Dt));
            }
            var expected = Math.Min(Math.Max(error * Rate, servo.BaseSpeed), Math.Max(error / Dt, error * Rate));
            Assert.True(Math.Abs(Length(probe.RelativeVelocity(0)) - expected) <= 2e-3 * (1 + expected), $"{Length(probe.RelativeVelocity(0))}, {expected}");
        }
    }

    [Fact]
    public void RelaxationLeavesItAlone() => ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
    {
        var before = probe.LaneBits(lane);
        probe.Solve(new(0, Dt, relaxations: 1, isRelaxation: true));
        Assert.Equal(before, probe.LaneBits(lane));
    });

    // Velocity per error of a rigid servo with one sweep: w / (w h + 2), w that of the greatest frequency.
    static double Rate
    {
        get
        {
            var frequency = 2 * Math.PI * SpringSettings.JointCyclesPerSubstep(1) / Dt;
            return frequency / (frequency * Dt + 2);
        }
    }

    static double Length(double[] v) => Math.Sqrt(v.Sum(x => x * x));
}
