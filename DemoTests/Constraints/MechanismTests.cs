using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Constraints;

public class SliderTests : JointTests<Slider>
{
    private protected override Slider Describe(JointSamples samples, SpringSettings spring) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalAxisA = samples.Direction(),
        LocalOffsetB = samples.Vector(1),
        LocalOrientation = samples.Rotation(),
        SpringSettings = spring,
    };

    private protected override double[] Error(Slider d, DoublePose[] poses)
    {
        var (x, y) = Rotations.Tangents(d.LocalAxisA);
        return
        [
            .. Rotation(d, poses).ToArray(),
            -DoublePose.Along(poses, d.LocalOffsetA, d.LocalOffsetB, x), -DoublePose.Along(poses, d.LocalOffsetA, d.LocalOffsetB, y),
        ];
    }

    static DoubleVector Rotation(Slider d, DoublePose[] poses) =>
        (poses[0].Orientation * DoubleRotation.From(d.LocalOrientation) * poses[1].Orientation.Inverse).Vector;

    private protected override bool IsSmooth(Slider d, DoublePose[] poses) => Rotation(d, poses).Length < 3;

    // Anywhere on the line.
    private protected override void Settle(Slider d, SampleBody[] bodies)
    {
        bodies[1].Orientation = Exact.Concatenate(d.LocalOrientation, bodies[0].Orientation);
        Rotations.JoinAnchors(bodies, d.LocalOffsetA + d.LocalAxisA * 0.7f, d.LocalOffsetB);
    }

    private protected override IEnumerable<(string, Slider, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1) })
            yield return ($"No arms, along {axis}", new() { LocalAxisA = axis, LocalOrientation = Quaternion.Identity }, NewBodies(samples));
    }
}

public class GearTests : JointTests<Gear>
{
    private protected override Gear Describe(JointSamples samples, SpringSettings spring) => new()
    {
        LocalBasisA = samples.Rotation(),
        LocalBasisB = samples.Rotation(),
        LocalHousingBasisA = samples.Rotation(),
        LocalHousingBasisB = samples.Rotation(),
        TeethA = MathF.Floor(samples.Uniform(1, 30)) * (samples.Coin() ? 1 : -1),
        TeethB = MathF.Floor(samples.Uniform(1, 30)) * (samples.Coin() ? 1 : -1),
        SpringSettings = spring,
    };

    static double Sum(Gear d, DoublePose[] poses) =>
        d.TeethA * Rotations.Twist([poses[2], poses[0]], d.LocalHousingBasisA, d.LocalBasisA) +
        d.TeethB * Rotations.Twist([poses[2], poses[1]], d.LocalHousingBasisB, d.LocalBasisB);

    private protected override double[] Error(Gear d, DoublePose[] poses) =>
        [Math.IEEERemainder(Sum(d, poses), 2 * Math.PI) / Math.Max(Math.Abs(d.TeethA), Math.Abs(d.TeethB))];

    private protected override bool IsSmooth(Gear d, DoublePose[] poses) =>
        Rotations.TwistAxesDot([poses[2], poses[0]], d.LocalHousingBasisA, d.LocalBasisA) > -0.5 &&
        Rotations.TwistAxesDot([poses[2], poses[1]], d.LocalHousingBasisB, d.LocalBasisB) > -0.5 &&
        Math.Abs(Math.IEEERemainder(Sum(d, poses), 2 * Math.PI)) < 3;

    private protected override IEnumerable<(string, Gear, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.OpposedTwistAxes(samples, NewBodies, basis => new Gear
        {
            LocalBasisA = basis,
            LocalBasisB = basis,
            LocalHousingBasisA = Quaternion.Identity,
            LocalHousingBasisB = Quaternion.Identity,
            TeethA = 1,
            TeethB = 1000,
        });

    /// <summary>After whole turns of both wheels the teeth are where they were; half a tooth on, the next one is as near.</summary>
    [Theory, InlineData(0), InlineData(1), InlineData(2.75f), InlineData(-4.4f)]
    public void WholeTurnsNeedNoCounting(float turns)
    {
        static Quaternion About(double angle) => new(0, 0, (float)Math.Sin(angle / 2), (float)Math.Cos(angle / 2));
        var bodies = NewBodies(new(1));
        var angle = 2 * Math.PI * turns;
        bodies[0].Orientation = About(angle);
        bodies[1].Orientation = About(-angle * 12 / 31 + 0.01);
        bodies[2].Orientation = Quaternion.Identity;
        var probe = JointProbes.New<Gear>();
        var basis = Quaternion.Identity;
        probe.Set(0, new()
        {
            LocalBasisA = basis,
            LocalBasisB = basis,
            LocalHousingBasisA = basis,
            LocalHousingBasisB = basis,
            TeethA = 12,
            TeethB = 31,
        }, bodies);
        AssertClose([0.01], probe.PositionError(0), 1e-5);
    }
}

public class RackTests : JointTests<Rack>
{
    private protected override Rack Describe(JointSamples samples, SpringSettings spring) => new()
    {
        LocalBasisA = samples.Rotation(),
        LocalHousingBasis = samples.Rotation(),
        LocalOffsetB = samples.Vector(1),
        LocalHousingOffset = samples.Vector(1),
        LocalHousingAxis = samples.Direction(),
        Radius = samples.Uniform(0.1f, 1) * (samples.Coin() ? 1 : -1),
        Teeth = MathF.Floor(samples.Uniform(1, 20)),
        SpringSettings = spring,
    };

    private protected override double[] Error(Rack d, DoublePose[] poses) => [Math.IEEERemainder(
        DoublePose.Along([poses[2], poses[1]], d.LocalHousingOffset, d.LocalOffsetB, d.LocalHousingAxis) -
        d.Radius * Rotations.Twist([poses[2], poses[0]], d.LocalHousingBasis, d.LocalBasisA), 2 * Math.PI * d.Radius / d.Teeth)];

    private protected override bool IsSmooth(Rack d, DoublePose[] poses) =>
        Rotations.TwistAxesDot([poses[2], poses[0]], d.LocalHousingBasis, d.LocalBasisA) > -0.5 && Math.Abs(Error(d, poses)[0] * d.Teeth / d.Radius) < 3;

    private protected override IEnumerable<(string, Rack, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.OpposedTwistAxes(samples, NewBodies, basis => new Rack
        {
            LocalBasisA = basis,
            LocalHousingBasis = Quaternion.Identity,
            LocalHousingAxis = Vector3.UnitX,
            Radius = 1e-3f,
            Teeth = 1000,
        });
}

public class PulleyTests : JointTests<Pulley>
{
    private protected override Pulley Describe(JointSamples samples, SpringSettings spring) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalOffsetB = samples.Vector(1),
        LocalWheelA = samples.Vector(1),
        LocalWheelB = samples.Vector(1),
        Ratio = samples.Uniform(0.2f, 3),
        MaximumLength = samples.Uniform(0, 12),
        SpringSettings = spring,
    };

    static (double A, double B) Lengths(Pulley d, DoublePose[] poses)
    {
        double Part(int body, Vector3 offset, Vector3 wheel) =>
            (poses[body].Position + poses[body].ToWorld(offset) - poses[2].Position - poses[2].ToWorld(wheel)).Length;
        return (Part(0, d.LocalOffsetA, d.LocalWheelA), Part(1, d.LocalOffsetB, d.LocalWheelB));
    }

    private protected override double[] Error(Pulley d, DoublePose[] poses)
    {
        var (a, b) = Lengths(d, poses);
        return [d.MaximumLength - a - d.Ratio * b];
    }

    private protected override bool IsSmooth(Pulley d, DoublePose[] poses) => Lengths(d, poses) is ( > 0.1, > 0.1);

    private protected override IEnumerable<(string, Pulley, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.NearBodies(samples, NewBodies, length => new Pulley { Ratio = 1, MaximumLength = length });
}
