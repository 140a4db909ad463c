using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Constraints;

public class CenterDistanceConstraintTests : JointTests<CenterDistanceConstraint>
{
    private protected override CenterDistanceConstraint Describe(JointSamples samples, SpringSettings spring) => new(samples.Uniform(0, 4), spring);

    private protected override double[] Error(CenterDistanceConstraint d, DoublePose[] poses) =>
        [d.TargetDistance - (poses[0].Position - poses[1].Position).Length];

    private protected override bool IsSmooth(CenterDistanceConstraint d, DoublePose[] poses) => (poses[0].Position - poses[1].Position).Length > 0.1;

    private protected override IEnumerable<(string, CenterDistanceConstraint, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.NearBodies(samples, NewBodies, distance => new CenterDistanceConstraint(distance, default));
}

public class AreaConstraintTests : JointTests<AreaConstraint>
{
    private protected override AreaConstraint Describe(JointSamples samples, SpringSettings spring) =>
        new() { TargetScaledArea = samples.Uniform(0, 6), SpringSettings = spring };

    private protected override double[] Error(AreaConstraint d, DoublePose[] poses) => [Cross(poses).Length - d.TargetScaledArea];

    static DoubleVector Cross(DoublePose[] poses) =>
        DoubleVector.Cross(poses[1].Position - poses[0].Position, poses[2].Position - poses[0].Position);

    // Neither near a line, nor so small that the error is bounded.
    private protected override bool IsSmooth(AreaConstraint d, DoublePose[] poses) => Cross(poses).Length > 0.5 + d.TargetScaledArea / 4;

    private protected override IEnumerable<(string, AreaConstraint, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var near in Rotations.NearBodies(samples, NewBodies, area => new AreaConstraint { TargetScaledArea = area }))
            yield return near;
        foreach (var height in new[] { 0, 1e-20f, 1e-6f })
            yield return ($"In a line but for {height}", new() { TargetScaledArea = 1 }, At(samples, default, new(1, 0, 0), new(3, height, 0)));
    }

    static SampleBody[] At(JointSamples samples, params Vector3[] positions)
    {
        var bodies = NewBodies(samples);
        for (int i = 0; i < bodies.Length; ++i)
            bodies[i].Position = positions[i];
        return bodies;
    }

    [Fact]
    public void ItDescribesTheAreaThatIsThere()
    {
        // Base 2, height 3.
        Assert.Equal(6, new AreaConstraint(new(1, 1, 1), new(3, 1, 1), new(2, 1, 4), default).TargetScaledArea, 1e-5f);
        var bodies = At(new(1), new(1, 1, 1), new(3, 1, 1), new(2, 1, 4));
        var probe = JointProbes.New<AreaConstraint>();
        probe.Set(0, new() { TargetScaledArea = 5 }, bodies);
        AssertClose([1], probe.PositionError(0), 1e-6);
    }
}

public class VolumeConstraintTests : JointTests<VolumeConstraint>
{
    private protected override VolumeConstraint Describe(JointSamples samples, SpringSettings spring) =>
        new() { TargetScaledVolume = samples.Uniform(-6, 6), SpringSettings = spring };

    private protected override double[] Error(VolumeConstraint d, DoublePose[] poses) => [Volume(poses) - d.TargetScaledVolume];

    static double Volume(DoublePose[] poses)
    {
        var b = poses[1].Position - poses[0].Position;
        var c = poses[2].Position - poses[0].Position;
        return DoubleVector.Dot(DoubleVector.Cross(b, c), poses[3].Position - poses[0].Position);
    }

    // Not so small that the error is bounded.
    private protected override bool IsSmooth(VolumeConstraint d, DoublePose[] poses) => Math.Abs(Volume(poses)) > 1 + Math.Abs(d.TargetScaledVolume) / 4;

    private protected override IEnumerable<(string, VolumeConstraint, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var near in Rotations.NearBodies(samples, NewBodies, volume => new VolumeConstraint { TargetScaledVolume = volume }))
            yield return near;
        foreach (var height in new[] { 0, 1e-20f, 1e-6f })
        {
            var bodies = NewBodies(samples);
            bodies[0].Position = default;
            bodies[1].Position = new(1, 0, 0);
            bodies[2].Position = new(0, 0, 1);
            bodies[3].Position = new(1, height, 1);
            yield return ($"In a plane but for {height}", new() { TargetScaledVolume = 1 }, bodies);
        }
    }

    [Fact]
    public void ItDescribesTheVolumeThatIsThere()
    {
        // The winding is part of it.
        Assert.Equal(24, new VolumeConstraint(new(1, 1, 1), new(3, 1, 1), new(1, 4, 1), new(1, 1, 5), default).TargetScaledVolume, 1e-5f);
        Assert.Equal(-24, new VolumeConstraint(new(1, 1, 1), new(1, 4, 1), new(3, 1, 1), new(1, 1, 5), default).TargetScaledVolume, 1e-5f);
    }
}
