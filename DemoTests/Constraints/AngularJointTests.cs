using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Constraints;

public class AngularHingeTests : JointTests<AngularHinge>
{
    private protected override AngularHinge Describe(JointSamples samples, SpringSettings spring) =>
        new() { LocalHingeAxisA = samples.Direction(), LocalHingeAxisB = samples.Direction(), SpringSettings = spring };

    private protected override double[] Error(AngularHinge d, DoublePose[] poses) => Rotations.TurnToAlign(poses, d.LocalHingeAxisA, d.LocalHingeAxisB);

    private protected override bool IsSmooth(AngularHinge d, DoublePose[] poses) =>
        DoubleVector.Dot(poses[0].ToWorld(d.LocalHingeAxisA), poses[1].ToWorld(d.LocalHingeAxisB)) > -0.99;

    private protected override void Settle(AngularHinge d, SampleBody[] bodies) => Rotations.Align(bodies, d.LocalHingeAxisA, d.LocalHingeAxisB);

    private protected override IEnumerable<(string, AngularHinge, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.ParallelAxes(samples, NewBodies, (a, b) => new AngularHinge { LocalHingeAxisA = a, LocalHingeAxisB = b });

    [Fact]
    public void OppositeAxesAreHalfATurnApart()
    {
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = bodies[1].Orientation = Quaternion.Identity;
        var probe = JointProbes.New<AngularHinge>();
        probe.Set(0, new() { LocalHingeAxisA = new(0, 0, 1), LocalHingeAxisB = new(0, 0, -1) }, bodies);
        AssertClose([Math.PI, 0], probe.PositionError(0), 1e-6);
    }
}

public class AngularSwivelHingeTests : JointTests<AngularSwivelHinge>
{
    private protected override AngularSwivelHinge Describe(JointSamples samples, SpringSettings spring) =>
        new() { LocalSwivelAxisA = samples.Direction(), LocalHingeAxisB = samples.Direction(), SpringSettings = spring };

    private protected override double[] Error(AngularSwivelHinge d, DoublePose[] poses) => [Math.PI / 2 - Angle(d, poses)];

    static double Angle(AngularSwivelHinge d, DoublePose[] poses) =>
        DoubleVector.Angle(poses[0].ToWorld(d.LocalSwivelAxisA), poses[1].ToWorld(d.LocalHingeAxisB));

    private protected override bool IsSmooth(AngularSwivelHinge d, DoublePose[] poses) => Angle(d, poses) is > 0.05 and < Math.PI - 0.05;

    private protected override IEnumerable<(string, AngularSwivelHinge, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.ParallelAxes(samples, NewBodies, (a, b) => new AngularSwivelHinge { LocalSwivelAxisA = a, LocalHingeAxisB = b });
}
