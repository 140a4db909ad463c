using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Constraints;

public class DistanceLimitTests : JointTests<DistanceLimit>
{
    private protected override DistanceLimit Describe(JointSamples samples, SpringSettings spring)
    {
        var minimum = samples.Coin() ? 0 : samples.Uniform(0.1f, 3);
        return new(samples.Vector(1), samples.Vector(1), minimum, minimum + samples.Uniform(0.1f, 3), spring);
    }

    private protected override double[] Error(DistanceLimit d, DoublePose[] poses)
    {
        var distance = Distance(d, poses);
        var above = distance - d.MinimumDistance;
        var below = d.MaximumDistance - distance;
        return [d.MinimumDistance > 0 && Math.Abs(above) < Math.Abs(below) ? above : below];
    }

    static double Distance(DistanceLimit d, DoublePose[] poses) =>
        (poses[0].Position + poses[0].ToWorld(d.LocalOffsetA) - poses[1].Position - poses[1].ToWorld(d.LocalOffsetB)).Length;

    private protected override bool IsSmooth(DistanceLimit d, DoublePose[] poses)
    {
        var distance = Distance(d, poses);
        return distance > 0.1 && Math.Abs(distance - (d.MinimumDistance + (double)d.MaximumDistance) / 2) > 0.01;
    }

    private protected override IEnumerable<(string, DistanceLimit, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var gap in new[] { 0, 1e-30f, 1e-18f, 1e-12f, 1e-7f })
        {
            var bodies = NewBodies(samples);
            bodies[0].Position = default;
            bodies[1].Position = new(gap, 0, 0);
            yield return ($"{gap} apart, kept apart", new(default, default, 1, 2, default), bodies);
            yield return ($"{gap} apart, rope", new(default, default, 0, 2, default), bodies);
            yield return ($"{gap} apart, no length", new(default, default, 0, 0, default), bodies);
            yield return ($"{gap} apart, no maximum", new(default, default, 0, float.MaxValue, new(1e-12f, 1)), bodies);
        }
    }

    [Fact]
    public void SlackRopeLetsItsEndsPass()
    {
        var bodies = NewBodies(new(1));
        bodies[0].Position = bodies[1].Position = default;
        var probe = JointProbes.New<DistanceLimit>();
        for (int sign = -1; sign <= 1; sign += 2)
        {
            bodies[1].Linear = new(0, sign * 10, 0);
            probe.Set(0, new(default, default, 0, 1, default), bodies);
            probe.Solve(new(0, 1 / 240f, 1, 1));
            Assert.Equal(0, probe.Impulse(0)[0]);
        }
    }
}

public class LinearAxisLimitTests : JointTests<LinearAxisLimit>
{
    private protected override LinearAxisLimit Describe(JointSamples samples, SpringSettings spring)
    {
        var minimum = samples.Uniform(-2, 2);
        return new()
        {
            LocalOffsetA = samples.Vector(1),
            LocalOffsetB = samples.Vector(1),
            LocalAxis = samples.Direction(),
            MinimumOffset = minimum,
            MaximumOffset = minimum + samples.Uniform(0.1f, 3),
            SpringSettings = spring,
        };
    }

    private protected override double[] Error(LinearAxisLimit d, DoublePose[] poses)
    {
        var offset = Offset(d, poses);
        return [Math.Abs(offset - d.MinimumOffset) < Math.Abs(d.MaximumOffset - offset) ? offset - d.MinimumOffset : d.MaximumOffset - offset];
    }

    static double Offset(LinearAxisLimit d, DoublePose[] poses) => DoublePose.Along(poses, d.LocalOffsetA, d.LocalOffsetB, d.LocalAxis);

    private protected override bool IsSmooth(LinearAxisLimit d, DoublePose[] poses) =>
        Math.Abs(Offset(d, poses) - (d.MinimumOffset + (double)d.MaximumOffset) / 2) > 0.01;

    private protected override IEnumerable<(string, LinearAxisLimit, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        var axis = Vector3.UnitZ;
        yield return ("No arms", new() { LocalAxis = axis, MinimumOffset = -1, MaximumOffset = 1 }, NewBodies(samples));
        yield return ("No range", new() { LocalAxis = axis }, NewBodies(samples));
        yield return ("No minimum", new() { LocalAxis = axis, MinimumOffset = float.MinValue }, NewBodies(samples));
        yield return ("No maximum", new() { LocalAxis = axis, MaximumOffset = float.MaxValue }, NewBodies(samples));
        yield return ("No limits", new() { LocalAxis = axis, MinimumOffset = float.MinValue, MaximumOffset = float.MaxValue }, NewBodies(samples));
    }
}

public class CenterDistanceLimitTests : JointTests<CenterDistanceLimit>
{
    private protected override CenterDistanceLimit Describe(JointSamples samples, SpringSettings spring)
    {
        var minimum = samples.Coin() ? 0 : samples.Uniform(0.1f, 3);
        return new(minimum, minimum + samples.Uniform(0.1f, 3), spring);
    }

    private protected override double[] Error(CenterDistanceLimit d, DoublePose[] poses)
    {
        var distance = (poses[0].Position - poses[1].Position).Length;
        var above = distance - d.MinimumDistance;
        var below = d.MaximumDistance - distance;
        return [d.MinimumDistance > 0 && Math.Abs(above) < Math.Abs(below) ? above : below];
    }

    private protected override bool IsSmooth(CenterDistanceLimit d, DoublePose[] poses)
    {
        var distance = (poses[0].Position - poses[1].Position).Length;
        return distance > 0.1 && Math.Abs(distance - (d.MinimumDistance + (double)d.MaximumDistance) / 2) > 0.01;
    }

    private protected override IEnumerable<(string, CenterDistanceLimit, SampleBody[])> DegenerateCases(JointSamples samples) =>
    [
        .. Rotations.NearBodies(samples, NewBodies, distance => new CenterDistanceLimit(distance, distance, default)),
        .. Rotations.NearBodies(samples, NewBodies, distance => new CenterDistanceLimit(0, distance, default)),
        .. Rotations.NearBodies(samples, NewBodies, distance => new CenterDistanceLimit(distance, float.MaxValue, default)),
    ];
}

public class SwingLimitTests : JointTests<SwingLimit>
{
    private protected override SwingLimit Describe(JointSamples samples, SpringSettings spring) =>
        new() { AxisLocalA = samples.Direction(), AxisLocalB = samples.Direction(), MinimumDot = samples.Uniform(-0.99f, 0.99f), SpringSettings = spring };

    private protected override double[] Error(SwingLimit d, DoublePose[] poses) => [Math.Acos(d.MinimumDot) - Angle(d, poses)];

    static double Angle(SwingLimit d, DoublePose[] poses) => DoubleVector.Angle(poses[0].ToWorld(d.AxisLocalA), poses[1].ToWorld(d.AxisLocalB));

    private protected override bool IsSmooth(SwingLimit d, DoublePose[] poses) => Angle(d, poses) is > 0.05 and < Math.PI - 0.05;

    private protected override IEnumerable<(string, SwingLimit, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1), samples.Direction() })
        {
            foreach (var dot in new[] { -1, -0.5f, 0, 0.5f, 1 })
            {
                var bodies = NewBodies(samples);
                bodies[0].Orientation = bodies[1].Orientation = samples.Rotation();
                yield return ($"Same axis {axis}, {dot}", new() { AxisLocalA = axis, AxisLocalB = axis, MinimumDot = dot }, bodies);
                yield return ($"Opposite axes {axis}, {dot}", new() { AxisLocalA = axis, AxisLocalB = -axis, MinimumDot = dot }, bodies);
            }
        }
    }

    [Theory]
    [InlineData(1f, 1f, 0)]
    [InlineData(1f, -1f, -Math.PI)]
    [InlineData(-1f, 1f, Math.PI)]
    [InlineData(-1f, -1f, 0)]
    [InlineData(0f, 1f, Math.PI / 2)]
    [InlineData(0f, -1f, -Math.PI / 2)]
    public void RoomAtTheEndsIsAnAngle(float minimumDot, float axisB, double expected)
    {
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = bodies[1].Orientation = Quaternion.Identity;
        var probe = JointProbes.New<SwingLimit>();
        probe.Set(0, new() { AxisLocalA = new(0, 0, 1), AxisLocalB = new(0, 0, axisB), MinimumDot = minimumDot }, bodies);
        AssertClose([expected], probe.PositionError(0), 1e-6);
    }

    /// <summary>What tells without an angle that a limit is out of reach never says so where the angle would not, whatever lengths axes have.</summary>
    [Fact]
    public void Room_is_never_less_than_its_bound()
    {
        var samples = new JointSamples(5);
        var bounded = 0;
        for (int i = 0; i < 20_000; ++i)
        {
            var bodies = new TwoBodies();
            var limit = new SwingLimitWide();
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                var axis = samples.Direction();
                // Near the ends of what cosines can be, and anywhere.
                var other = samples.Coin() ? samples.Direction() : Vector3.Normalize((samples.Coin() ? axis : -axis) + samples.Vector(0.01f));
                var end = samples.Coin() ? 1 : -1;
                var cosine = samples.Coin() ? samples.Uniform(-1, 1) : end * (1 - MathF.Pow(10, samples.Uniform(-8, -2)));
                Lanes.Write(new SwingLimit { AxisLocalA = axis * Length(0.006f), AxisLocalB = other * Length(0.006f), MinimumDot = cosine }, ref limit, lane);
                Lanes.Write(Quaternion.Identity * Length(0.2f), ref bodies.A.Orientation, lane);
                Lanes.Write(samples.Rotation(samples.Coin() ? 0.01f : 3) * Length(0.2f), ref bodies.B.Orientation, lane);
            }
            SwingLimitJoint.Prepare(bodies, limit, out var geometry);
            SwingLimitJoint.LeastSlack(limit, geometry, out var slack);
            SwingLimitJoint.PositionError(bodies, limit, geometry, out var error);
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                Assert.True(slack.X[lane] < 0 || slack.X[lane] <= error.X[lane], $"{slack.X[lane]:R} and {error.X[lane]:R}");
                bounded += slack.X[lane] >= 0 ? 1 : 0;
            }
        }
        Assert.True(bounded > 2000 * Vector<float>.Count, $"Only {bounded} had a bound.");

        float Length(float range) => samples.Uniform(0, 4) < 3 ? 1 : samples.Uniform(1 - range, 1 + range);
    }

    /// <summary>A hundredth of a degree beyond the limit is that much, however narrow the limit.</summary>
    [Fact]
    public void SmallAnglesKeepTheirDigits()
    {
        var limit = new SwingLimit { AxisLocalA = new(0, 0, 1), AxisLocalB = new(0, 0, 1), MinimumDot = 1 };
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = Quaternion.Identity;
        bodies[1].Orientation = new(1e-4f, 0, 0, 1);
        var probe = JointProbes.New<SwingLimit>();
        probe.Set(0, limit, bodies);
        Assert.Equal(-2e-4, probe.PositionError(0)[0], 1e-9);
    }

    [Fact]
    public void AngleIsKeptAsItsCosine()
    {
        var limit = new SwingLimit { MaximumSwingAngle = MathF.PI / 3 };
        Assert.Equal(0.5f, limit.MinimumDot, 1e-6f);
        Assert.Equal(MathF.PI / 3, limit.MaximumSwingAngle, 1e-6f);
        limit.MaximumSwingAngle = MathF.PI;
        Assert.Equal(-1, limit.MinimumDot);
    }
}

public class TwistLimitTests : JointTests<TwistLimit>
{
    private protected override TwistLimit Describe(JointSamples samples, SpringSettings spring)
    {
        var minimum = samples.Uniform(-3, 3);
        return new()
        {
            LocalBasisA = samples.Rotation(),
            LocalBasisB = samples.Rotation(),
            MinimumAngle = minimum,
            MaximumAngle = minimum + samples.Uniform(0.1f, 4),
            SpringSettings = spring,
        };
    }

    private protected override double[] Error(TwistLimit d, DoublePose[] poses)
    {
        var twist = Rotations.Twist(poses, d.LocalBasisA, d.LocalBasisB);
        var above = Math.IEEERemainder(twist - d.MinimumAngle, 2 * Math.PI);
        var below = Math.IEEERemainder(d.MaximumAngle - twist, 2 * Math.PI);
        return [Math.Abs(above) < Math.Abs(below) ? above : below];
    }

    private protected override bool IsSmooth(TwistLimit d, DoublePose[] poses)
    {
        var twist = Rotations.Twist(poses, d.LocalBasisA, d.LocalBasisB);
        var above = Math.IEEERemainder(twist - d.MinimumAngle, 2 * Math.PI);
        var below = Math.IEEERemainder(d.MaximumAngle - twist, 2 * Math.PI);
        return Rotations.TwistAxesDot(poses, d.LocalBasisA, d.LocalBasisB) > -0.5 && Math.Abs(Math.Abs(above) - Math.Abs(below)) > 0.01;
    }

    private protected override IEnumerable<(string, TwistLimit, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        var opposed = Rotations.OpposedTwistAxes(samples, NewBodies, basisB =>
            new TwistLimit { LocalBasisA = Quaternion.Identity, LocalBasisB = basisB, MinimumAngle = -0.1f, MaximumAngle = 0.1f });
        foreach (var item in opposed)
            yield return item;
        var both = new Quaternion(0, 0, 1, 0);
        var same = NewBodies(samples);
        same[0].Orientation = same[1].Orientation = Quaternion.Identity;
        yield return ("Half a turn of twist", new() { LocalBasisA = Quaternion.Identity, LocalBasisB = both, MinimumAngle = -1, MaximumAngle = 1 }, same);
        yield return ("No range", new() { LocalBasisA = both, LocalBasisB = both }, same);
    }

    [Theory]
    [InlineData(-MathF.PI, MathF.PI)]
    [InlineData(0f, 7f)]
    [InlineData(-10f, 10f)]
    public void WholeTurnLimitsNothing(float minimum, float maximum)
    {
        for (var angle = -3.1f; angle < 3.1f; angle += 0.1f)
            Assert.True(Slack(angle, minimum, maximum) > -1e-6);
    }

    [Theory]
    [InlineData(0.5f, -1f, 1f, 0.5)]
    [InlineData(1.5f, -1f, 1f, -0.5)]
    [InlineData(-1.5f, -1f, 1f, -0.5)]
    // Ranges through half a turn, by an angle above it or by a maximum below the minimum.
    [InlineData(-3f, 2.5f, 4f, 4 - (2 * Math.PI - 3))]
    [InlineData(-3f, 2.5f, 4f - 2 * MathF.PI, 4 - (2 * Math.PI - 3))]
    [InlineData(0f, 2.5f, 4f - 2 * MathF.PI, 4 - 2 * Math.PI)]
    public void RoomIsMeasuredAroundTheCircle(float angle, float minimum, float maximum, double expected) =>
        Assert.Equal(expected, Slack(angle, minimum, maximum), 1e-6);

    static double Slack(float angle, float minimum, float maximum)
    {
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = Quaternion.Identity;
        bodies[1].Orientation = new(0, 0, MathF.Sin(angle / 2), MathF.Cos(angle / 2));
        var probe = JointProbes.New<TwistLimit>();
        probe.Set(0, new() { LocalBasisA = Quaternion.Identity, LocalBasisB = Quaternion.Identity, MinimumAngle = minimum, MaximumAngle = maximum }, bodies);
        return probe.PositionError(0)[0];
    }
}
