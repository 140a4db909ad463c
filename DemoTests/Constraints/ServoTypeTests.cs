using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Constraints;

public class OneBodyLinearServoTests : ServoTests<OneBodyLinearServo>
{
    private protected override OneBodyLinearServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) =>
        new() { LocalOffset = samples.Vector(1), Target = samples.Vector(2), SpringSettings = spring, ServoSettings = servo };

    private protected override double[] Error(OneBodyLinearServo d, DoublePose[] poses) =>
        (poses[0].Position + poses[0].ToWorld(d.LocalOffset) - new DoubleVector(d.Target)).ToArray();

    private protected override void Settle(OneBodyLinearServo d, SampleBody[] bodies) =>
        bodies[0].Position = d.Target - Exact.Rotate(d.LocalOffset, bodies[0].Orientation);
}

public class LinearAxisServoTests : ServoTests<LinearAxisServo>
{
    private protected override LinearAxisServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalOffsetB = samples.Vector(1),
        LocalPlaneNormal = samples.Direction(),
        TargetOffset = samples.Uniform(-2, 2),
        SpringSettings = spring,
        ServoSettings = servo,
    };

    private protected override double[] Error(LinearAxisServo d, DoublePose[] poses) =>
        [d.TargetOffset - DoublePose.Along(poses, d.LocalOffsetA, d.LocalOffsetB, d.LocalPlaneNormal)];

    private protected override IEnumerable<(string, LinearAxisServo, SampleBody[])> OwnDegenerateCases(JointSamples samples)
    {
        yield return ("No arms", new() { LocalPlaneNormal = Vector3.UnitX, ServoSettings = ServoSettings.Default }, NewBodies(samples));
    }
}

public class PointOnLineServoTests : ServoTests<PointOnLineServo>
{
    private protected override PointOnLineServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalOffsetB = samples.Vector(1),
        LocalDirection = samples.Direction(),
        SpringSettings = spring,
        ServoSettings = servo,
    };

    private protected override double[] Error(PointOnLineServo d, DoublePose[] poses)
    {
        // The rows are coordinates in a frame of A; which one is the joint's choice.
        var (x, y) = Rotations.Tangents(d.LocalDirection);
        return [-DoublePose.Along(poses, d.LocalOffsetA, d.LocalOffsetB, x), -DoublePose.Along(poses, d.LocalOffsetA, d.LocalOffsetB, y)];
    }

    private protected override void Settle(PointOnLineServo d, SampleBody[] bodies) => Rotations.JoinAnchors(bodies, d.LocalOffsetA, d.LocalOffsetB);

    private protected override IEnumerable<(string, PointOnLineServo, SampleBody[])> OwnDegenerateCases(JointSamples samples)
    {
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1) })
            yield return ($"No arms, along {axis}", new() { LocalDirection = axis, ServoSettings = ServoSettings.Default }, NewBodies(samples));
    }
}

public class BallSocketServoTests : ServoTests<BallSocketServo>
{
    private protected override BallSocketServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) =>
        new() { LocalOffsetA = samples.Vector(1), LocalOffsetB = samples.Vector(1), SpringSettings = spring, ServoSettings = servo };

    private protected override double[] Error(BallSocketServo d, DoublePose[] poses) =>
        (poses[0].Position + poses[0].ToWorld(d.LocalOffsetA) - poses[1].Position - poses[1].ToWorld(d.LocalOffsetB)).ToArray();

    private protected override void Settle(BallSocketServo d, SampleBody[] bodies) => Rotations.JoinAnchors(bodies, d.LocalOffsetA, d.LocalOffsetB);
}

public class DistanceServoTests : ServoTests<DistanceServo>
{
    private protected override DistanceServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) =>
        new(samples.Vector(1), samples.Vector(1), samples.Uniform(0, 4), spring, servo);

    private protected override double[] Error(DistanceServo d, DoublePose[] poses) => [d.TargetDistance - Distance(d, poses)];

    static double Distance(DistanceServo d, DoublePose[] poses) =>
        (poses[0].Position + poses[0].ToWorld(d.LocalOffsetA) - poses[1].Position - poses[1].ToWorld(d.LocalOffsetB)).Length;

    private protected override bool IsSmooth(DistanceServo d, DoublePose[] poses) => Distance(d, poses) > 0.1;

    private protected override IEnumerable<(string, DistanceServo, SampleBody[])> OwnDegenerateCases(JointSamples samples) =>
        Rotations.NearBodies(samples, NewBodies, distance => new DistanceServo(default, default, distance, default));
}

public class TwistServoTests : ServoTests<TwistServo>
{
    private protected override TwistServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) => new()
    {
        LocalBasisA = samples.Rotation(),
        LocalBasisB = samples.Rotation(),
        TargetAngle = samples.Uniform(-7, 7),
        SpringSettings = spring,
        ServoSettings = servo,
    };

    private protected override double[] Error(TwistServo d, DoublePose[] poses) =>
        [Math.IEEERemainder(d.TargetAngle - Rotations.Twist(poses, d.LocalBasisA, d.LocalBasisB), 2 * Math.PI)];

    private protected override bool IsSmooth(TwistServo d, DoublePose[] poses) =>
        Rotations.TwistAxesDot(poses, d.LocalBasisA, d.LocalBasisB) > -0.5 && Math.Abs(Error(d, poses)[0]) < 3.1;

    private protected override IEnumerable<(string, TwistServo, SampleBody[])> OwnDegenerateCases(JointSamples samples) =>
        Rotations.OpposedTwistAxes(samples, NewBodies, basisB =>
            new TwistServo { LocalBasisA = Quaternion.Identity, LocalBasisB = basisB, ServoSettings = ServoSettings.Default });

    /// <summary>A target of any turn is approached the shorter way around, also through half a turn.</summary>
    [Theory]
    [InlineData(3f, -3f, 2 * Math.PI - 6)]
    [InlineData(-3f, 3f, 6 - 2 * Math.PI)]
    [InlineData(0.5f, 0.25f, -0.25)]
    [InlineData(0.5f, 0.25f + 20 * MathF.PI, -0.25)]
    public void TheShorterWayAroundIsTaken(float twist, float target, double expected)
    {
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = Quaternion.Identity;
        bodies[1].Orientation = new(0, 0, MathF.Sin(twist / 2), MathF.Cos(twist / 2));
        var probe = JointProbes.New<TwistServo>();
        probe.Set(0, new() { LocalBasisA = Quaternion.Identity, LocalBasisB = Quaternion.Identity, TargetAngle = target }, bodies);
        AssertClose([expected], probe.PositionError(0), 1e-5);
    }
}

public class OneBodyAngularServoTests : ServoTests<OneBodyAngularServo>
{
    private protected override OneBodyAngularServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) =>
        new() { TargetOrientation = samples.Rotation(), SpringSettings = spring, ServoSettings = servo };

    private protected override double[] Error(OneBodyAngularServo d, DoublePose[] poses) => Rotation(d, poses).ToArray();

    static DoubleVector Rotation(OneBodyAngularServo d, DoublePose[] poses) =>
        (poses[0].Orientation * DoubleRotation.From(d.TargetOrientation).Inverse).Vector;

    private protected override bool IsSmooth(OneBodyAngularServo d, DoublePose[] poses) => Rotation(d, poses).Length < 3;

    private protected override void Settle(OneBodyAngularServo d, SampleBody[] bodies) => bodies[0].Orientation = d.TargetOrientation;

    private protected override IEnumerable<(string, OneBodyAngularServo, SampleBody[])> OwnDegenerateCases(JointSamples samples)
    {
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1), samples.Direction() })
        {
            var bodies = NewBodies(samples);
            bodies[0].Orientation = new(axis, 0);
            yield return ($"Half a turn about {axis}", new() { TargetOrientation = Quaternion.Identity, ServoSettings = ServoSettings.Default }, bodies);
        }
    }
}

public class AngularServoTests : ServoTests<AngularServo>
{
    private protected override AngularServo Describe(JointSamples samples, SpringSettings spring, ServoSettings servo) =>
        new() { TargetRelativeRotationLocalA = samples.Rotation(), SpringSettings = spring, ServoSettings = servo };

    private protected override double[] Error(AngularServo d, DoublePose[] poses) => Rotation(d, poses).ToArray();

    static DoubleVector Rotation(AngularServo d, DoublePose[] poses) =>
        (poses[0].Orientation * DoubleRotation.From(d.TargetRelativeRotationLocalA) * poses[1].Orientation.Inverse).Vector;

    private protected override bool IsSmooth(AngularServo d, DoublePose[] poses) => Rotation(d, poses).Length < 3;

    private protected override void Settle(AngularServo d, SampleBody[] bodies) =>
        bodies[1].Orientation = Exact.Concatenate(d.TargetRelativeRotationLocalA, bodies[0].Orientation);

    private protected override IEnumerable<(string, AngularServo, SampleBody[])> OwnDegenerateCases(JointSamples samples)
    {
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1), samples.Direction() })
        {
            var servo = new AngularServo { TargetRelativeRotationLocalA = Quaternion.Identity, ServoSettings = ServoSettings.Default };
            yield return ($"Half a turn about {axis}", servo, TurnedBy(samples, new(axis, 0)));
            yield return ($"No rotation, by the other quaternion, {axis}", servo, TurnedBy(samples, new(axis * 1e-30f, -1)));
        }
    }

    static SampleBody[] TurnedBy(JointSamples samples, Quaternion turn)
    {
        var bodies = NewBodies(samples);
        bodies[0].Orientation = Quaternion.Identity;
        bodies[1].Orientation = turn;
        return bodies;
    }

    /// <summary>A little short of half a turn the way goes back, a little beyond it goes on; both are as long as they say.</summary>
    [Theory, InlineData(-1e-3f), InlineData(1e-3f)]
    public void TheShorterWayIsTaken(float beyond)
    {
        var half = (MathF.PI + beyond) / 2;
        var probe = JointProbes.New<AngularServo>();
        probe.Set(0, new() { TargetRelativeRotationLocalA = Quaternion.Identity }, TurnedBy(new(1), new(0, MathF.Sin(half), 0, MathF.Cos(half))));
        AssertClose([0, (beyond > 0 ? 1 : -1) * (Math.PI - Math.Abs(beyond)), 0], probe.PositionError(0), 1e-6);
    }
}
