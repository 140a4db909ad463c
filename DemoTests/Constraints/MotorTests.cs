using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What holds for every motor: as for joints, with a target velocity instead of a position error. A type adds its J v in double precision.</summary>
public abstract class MotorTests<TDescription> : JointTests<TDescription> where TDescription : unmanaged, IConstraintDescription<TDescription>
{
    /// <summary>J v of linear and angular velocities, six numbers per body.</summary>
    private protected abstract double[] Velocity(TDescription description, DoublePose[] poses, double[] velocities);

    private protected abstract double[] Target(TDescription description, DoublePose[] poses);

    private protected abstract TDescription Describe(JointSamples samples, MotorSettings settings);

    private protected sealed override TDescription Describe(JointSamples samples, SpringSettings spring) =>
        Describe(samples, spring.AngularFrequency == 0 ? new(float.MaxValue, 0) : new(samples.Uniform(0, 20), samples.Uniform(0, 1)));

    private protected sealed override double[] Error(TDescription description, DoublePose[] poses) => new double[RowCount];

    private protected sealed override double[] Wanted(TDescription description, double[] error, DoublePose[] poses) => Target(description, poses);

    private protected sealed override double[][] Jacobian(TDescription description, SampleBody[] bodies)
    {
        var columns = Enumerable.Range(0, bodies.Length * 6).Select(k =>
        {
            var unit = new double[bodies.Length * 6];
            unit[k] = 1;
            return Velocity(description, Poses(bodies), unit);
        }).ToArray();
        return [.. Enumerable.Range(0, RowCount).Select(row => columns.Select(column => column[row]).ToArray())];
    }

    /// <summary>Cases of the type's own.</summary>
    private protected virtual IEnumerable<(string Name, TDescription Description, SampleBody[] Bodies)> OwnDegenerateCases(JointSamples samples) => [];

    private protected sealed override IEnumerable<(string, TDescription, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var own in OwnDegenerateCases(samples))
            yield return own;
        foreach (var force in new[] { 0, 1, float.MaxValue, float.PositiveInfinity })
        {
            foreach (var softness in new[] { 0, 1e-45f, 1e-7f, 1, 1e7f, float.MaxValue, float.PositiveInfinity })
                yield return ($"Force {force}, softness {softness}", Describe(samples, new MotorSettings(force, softness)), NewBodies(samples));
        }
    }

    [Fact]
    public void TargetIsTheDefinition() => ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
        AssertClose(Target(description, Poses(bodies)), probe.TargetVelocity(lane), 1e-5));

    [Fact]
    public void ImpulsesKeepTheirLimit()
    {
        var samples = new JointSamples(9);
        var limited = 0;
        for (int trial = 0; trial < 200; ++trial)
        {
            var force = samples.Uniform(0.1f, 20);
            var probe = JointProbes.New<TDescription>();
            probe.Set(0, Describe(samples, new MotorSettings(force, samples.Uniform(0, 0.01f))), NewBodies(samples));
            for (int i = 0; i < 10; ++i)
            {
                probe.WarmStart(new(0, 1 / 240f));
                probe.Solve(new(0, 1 / 240f));
                var length = Math.Sqrt(probe.Impulse(0).Sum(x => x * x));
                Assert.True(length <= force / 240 * 1.0001, $"{length}");
                limited += length >= force / 240 * 0.999 ? 1 : 0;
            }
        }
        Assert.True(limited > 100, $"Only {limited} reached it.");
    }

    /// <summary>A load below the greatest force is carried at the target velocity; one above it moves the motor by what is left over.</summary>
    [Theory, InlineData(0.7f), InlineData(1.3f)]
    public void LoadsAreCarriedUpToTheForce(float part)
    {
        const float Dt = 1 / 240f;
        const double Force = 2000;
        ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
        {
            probe.Set(lane, Describe(samples, new MotorSettings((float)Force, 0)), bodies);
            probe.SetImpulse(lane, new double[RowCount]);
            double[] load = [.. Enumerable.Range(0, RowCount).Select(row => row == 0 ? part * Force * Dt : 0)];
            double last = 0, next = 0;
            for (int i = 0; i < 400; ++i)
            {
                var kept = probe.Impulse(lane);
                probe.SetImpulse(lane, load);
                probe.ApplyImpulse();
                probe.SetImpulse(lane, kept);
                probe.WarmStart(new(0, Dt));
                probe.Solve(new(0, Dt));
                (last, next) = (next, probe.RelativeVelocity(lane)[0]);
            }
            var gained = load[0] * probe.InverseEffectiveMass(lane)[0, 0];
            if (part < 1)
                AssertClose(probe.TargetVelocity(lane), probe.RelativeVelocity(lane), 1e-3 * (1 + gained));
            else
                Assert.True(Math.Abs(next - last - gained * (1 - 1 / part)) <= 0.02 * gained, $"{next - last} of {gained}");
        });
    }

    [Fact]
    public void RelaxationLeavesItAlone() => ForEachSample(settled: false, (probe, lane, description, bodies, samples) =>
    {
        var before = probe.LaneBits(lane);
        probe.Solve(new(0, 1 / 240f, relaxations: 1, isRelaxation: true));
        Assert.Equal(before, probe.LaneBits(lane));
    });
}
