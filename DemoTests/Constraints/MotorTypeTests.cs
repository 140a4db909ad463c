using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;

namespace DemoTests.Constraints;

public class AngularAxisMotorTests : MotorTests<AngularAxisMotor>
{
    private protected override AngularAxisMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { LocalAxisA = samples.Direction(), TargetVelocity = samples.Uniform(-5, 5), Settings = settings };

    private protected override double[] Target(AngularAxisMotor d, DoublePose[] poses) => [d.TargetVelocity];

    private protected override double[] Velocity(AngularAxisMotor d, DoublePose[] poses, double[] v) =>
        [DoubleVector.Dot(poses[0].ToWorld(d.LocalAxisA), DoubleVector.At(v, 3) - DoubleVector.At(v, 9))];
}

public class OneBodyAngularMotorTests : MotorTests<OneBodyAngularMotor>
{
    private protected override OneBodyAngularMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { TargetVelocity = samples.Vector(5), Settings = settings };

    private protected override double[] Target(OneBodyAngularMotor d, DoublePose[] poses) => new DoubleVector(d.TargetVelocity).ToArray();

    private protected override double[] Velocity(OneBodyAngularMotor d, DoublePose[] poses, double[] v) => v[3..6];
}

public class AngularMotorTests : MotorTests<AngularMotor>
{
    private protected override AngularMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { TargetVelocityLocalA = samples.Vector(5), Settings = settings };

    private protected override double[] Target(AngularMotor d, DoublePose[] poses) => poses[0].ToWorld(d.TargetVelocityLocalA).ToArray();

    private protected override double[] Velocity(AngularMotor d, DoublePose[] poses, double[] v) =>
        (DoubleVector.At(v, 3) - DoubleVector.At(v, 9)).ToArray();
}

public class TwistMotorTests : MotorTests<TwistMotor>
{
    private protected override TwistMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { LocalAxisA = samples.Direction(), LocalAxisB = samples.Direction(), TargetVelocity = samples.Uniform(-5, 5), Settings = settings };

    private protected override double[] Target(TwistMotor d, DoublePose[] poses) => [d.TargetVelocity];

    private protected override double[] Velocity(TwistMotor d, DoublePose[] poses, double[] v)
    {
        var sum = poses[0].ToWorld(d.LocalAxisA) + poses[1].ToWorld(d.LocalAxisB);
        return [DoubleVector.Dot(sum * (1 / sum.Length), DoubleVector.At(v, 3) - DoubleVector.At(v, 9))];
    }

    private protected override bool IsSmooth(TwistMotor d, DoublePose[] poses) =>
        (poses[0].ToWorld(d.LocalAxisA) + poses[1].ToWorld(d.LocalAxisB)).Length > 0.01;

    private protected override IEnumerable<(string, TwistMotor, SampleBody[])> OwnDegenerateCases(JointSamples samples) =>
        Rotations.ParallelAxes(samples, NewBodies, (a, b) => new TwistMotor { LocalAxisA = a, LocalAxisB = b, TargetVelocity = 3, Settings = new(9, 0) });
}

public class LinearAxisMotorTests : MotorTests<LinearAxisMotor>
{
    private protected override LinearAxisMotor Describe(JointSamples samples, MotorSettings settings) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalOffsetB = samples.Vector(1),
        LocalAxis = samples.Direction(),
        TargetVelocity = samples.Uniform(-5, 5),
        Settings = settings,
    };

    private protected override double[] Target(LinearAxisMotor d, DoublePose[] poses) => [-d.TargetVelocity];

    // Seen from A, which turns: less the velocity that a point fixed to A would have there.
    private protected override double[] Velocity(LinearAxisMotor d, DoublePose[] poses, double[] v) =>
        [DoubleVector.Dot(poses[0].ToWorld(d.LocalAxis), DoublePose.OfAAtPointOfB(poses, d.LocalOffsetB, v))];
}

public class BallSocketMotorTests : MotorTests<BallSocketMotor>
{
    private protected override BallSocketMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { LocalOffsetB = samples.Vector(1), TargetVelocityLocalA = samples.Vector(5), Settings = settings };

    private protected override double[] Target(BallSocketMotor d, DoublePose[] poses) => (poses[0].ToWorld(d.TargetVelocityLocalA) * -1).ToArray();

    private protected override double[] Velocity(BallSocketMotor d, DoublePose[] poses, double[] v) =>
        DoublePose.OfAAtPointOfB(poses, d.LocalOffsetB, v).ToArray();
}

public class OneBodyLinearMotorTests : MotorTests<OneBodyLinearMotor>
{
    private protected override OneBodyLinearMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { LocalOffset = samples.Vector(1), TargetVelocity = samples.Vector(5), Settings = settings };

    private protected override double[] Target(OneBodyLinearMotor d, DoublePose[] poses) => new DoubleVector(d.TargetVelocity).ToArray();

    private protected override double[] Velocity(OneBodyLinearMotor d, DoublePose[] poses, double[] v) =>
        (DoubleVector.At(v, 0) + DoubleVector.Cross(DoubleVector.At(v, 3), poses[0].ToWorld(d.LocalOffset))).ToArray();
}

public class AngularAxisGearMotorTests : MotorTests<AngularAxisGearMotor>
{
    private protected override AngularAxisGearMotor Describe(JointSamples samples, MotorSettings settings) =>
        new() { LocalAxisA = samples.Direction(), VelocityScale = (samples.Coin() ? 1 : -1) * samples.Uniform(0.3f, 3), Settings = settings };

    // The housing, which is not there, bears the rest.
    private protected override bool KeepsAngularMomentum => false;

    private protected override double[] Target(AngularAxisGearMotor d, DoublePose[] poses) => [0];

    private protected override double[] Velocity(AngularAxisGearMotor d, DoublePose[] poses, double[] v) =>
        [DoubleVector.Dot(poses[0].ToWorld(d.LocalAxisA), DoubleVector.At(v, 3) * d.VelocityScale - DoubleVector.At(v, 9))];

    private protected override IEnumerable<(string, AngularAxisGearMotor, SampleBody[])> OwnDegenerateCases(JointSamples samples)
    {
        foreach (var scale in new[] { 0, 1, -1, 1e-30f, 1e4f })
            yield return ($"Scale {scale}", new() { LocalAxisA = Vector3.UnitY, VelocityScale = scale, Settings = new(100, 0) }, NewBodies(samples));
    }
}
