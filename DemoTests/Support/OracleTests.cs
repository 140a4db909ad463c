using System;
using Demos.References;
using Xunit;

namespace DemoTests.Support;

/// <summary>
/// The references must be right before anything is measured with them: each is checked against a second way to the same number.
/// </summary>
public class OracleTests
{
    static TorqueFreeBody Box(Double3 angularVelocity) =>
        new(TorqueFreeBody.BoxInertia(1, 1, 2, 3), DoubleQuaternion.Identity, angularVelocity);

    static TorqueFreeBody After(Double3 angularVelocity, double duration, double step)
    {
        var body = Box(angularVelocity);
        body.Advance(duration, step);
        return body;
    }

    [Fact]
    public void RotationConvergesWithTheFourthPowerOfTheStep()
    {
        var start = new Double3(1, 10, 1);
        var reference = After(start, 2, 1e-5).Orientation;
        double coarse = DoubleQuaternion.AngleBetween(After(start, 2, 4e-3).Orientation, reference);
        double fine = DoubleQuaternion.AngleBetween(After(start, 2, 2e-3).Orientation, reference);
        Assert.InRange(coarse / fine, 12, 20);
        Assert.True(DoubleQuaternion.AngleBetween(After(start, 2, 1e-4).Orientation, reference) < 1e-9);
    }

    [Fact]
    public void RotationKeepsEnergyAndMomentum()
    {
        var start = Box(new(.1, 10, .1));
        var end = After(new(.1, 10, .1), 60, 1e-4);
        Assert.Equal(start.Energy, end.Energy, start.Energy * 1e-9);
        Assert.True((end.Momentum - start.Momentum).Length < 1e-8 * start.Momentum.Length);
    }

    [Fact]
    public void MiddleAxisFlipsTwentyFourTimesInAMinute()
    {
        Assert.Equal(24, After(new(.1, 10, .1), 60, 1e-4).FlipCount);
        Assert.Equal(24, After(new(.1, 10, .1), 60, 5e-4).FlipCount);
    }

    [Fact]
    public void RotationAboutASymmetryAxisIsTheClosedForm()
    {
        // Symmetric about Y: the body spins about its own axis at w (1 - I_y / I_x) and precesses about L at |L| / I_x.
        var body = new TorqueFreeBody(new(2, 1, 2), DoubleQuaternion.Identity, new(3, 4, 0));
        var momentum = body.Momentum;
        body.Advance(1.5, 1e-4);
        var expected = DoubleQuaternion.FromAxisAngle(momentum * (1 / momentum.Length), momentum.Length / 2 * 1.5)
            * DoubleQuaternion.FromAxisAngle(new(0, 1, 0), 4 * (1 - 1d / 2) * 1.5);
        Assert.True(DoubleQuaternion.AngleBetween(expected, body.Orientation) < 1e-9);
    }

    [Fact]
    public void TopConvergesWithTheFourthPowerOfTheStep()
    {
        var reference = TopAfter(.2, 1e-6);
        double coarse = (TopAfter(.2, 4e-4).Axis - reference.Axis).Length, fine = (TopAfter(.2, 2e-4).Axis - reference.Axis).Length;
        Assert.InRange(coarse / fine, 10, 40);
        Assert.True((TopAfter(.2, 1 / 12000.0).Axis - reference.Axis).Length < 1e-7);
    }

    [Fact]
    public void TopKeepsEnergyAndPrecessesAtItsKnownRate()
    {
        var start = TopAfter(0, 1);
        var end = TopAfter(10, 1 / 12000.0);
        Assert.Equal(start.Energy, end.Energy, start.Energy * 1e-7);
        // A fast top's rate, around which it nods by a few thousandths of a radian.
        double turned = Math.Atan2(start.Axis.Z * end.Axis.X - start.Axis.X * end.Axis.Z, start.Axis.X * end.Axis.X + start.Axis.Z * end.Axis.Z);
        Assert.Equal(10 * HeavyTop.FastPrecession(9.81 * .5, .125, 200), Math.Abs(turned), .005);
        Assert.Equal(Math.Cos(Math.PI / 6), end.Axis.Y, .003);
    }

    static HeavyTop TopAfter(double duration, double step)
    {
        var top = HeavyTop.OfDisc(.5, .1, 1, .5, 200, Math.PI / 6, 9.81);
        top.Advance(duration, step);
        return top;
    }

    [Theory]
    [InlineData(.01)]
    [InlineData(1)]
    [InlineData(Math.PI / 2)]
    [InlineData(3)]
    public void PendulumPeriodByMeanAgreesWithIntegration(double amplitude)
    {
        double exact = PendulumOracle.Period(1.004, 9.81, amplitude);
        Assert.Equal(exact, PendulumOracle.IntegratedPeriod(1.004, 9.81, amplitude, 1e-4), exact * 1e-8);
    }

    [Fact]
    public void PendulumOfTheSuiteHasItsKnownPeriod() =>
        Assert.Equal(2.3726, PendulumOracle.Period(PendulumOracle.EffectiveLength(1, .1), 9.81, Math.PI / 2), 5e-5);

    [Fact]
    public void EffectiveFrictionInvertsTheSlopeDistance()
    {
        double distance = SlidingOracle.SlopeDistance(9.81, .6, .5, 5);
        Assert.Equal(9.81 * (Math.Sin(.6) - .5 * Math.Cos(.6)) * 12.5, distance, 1e-12);
        Assert.Equal(.5, SlidingOracle.EffectiveFriction(9.81, .6, distance, 5), 1e-12);
        Assert.Equal(0, SlidingOracle.SlopeDistance(9.81, .4, .5, 5));
    }

    [Fact]
    public void SlidingSphereAgreesWithIntegrationOfItsTwoEquations()
    {
        const double mu = .3, g = 9.81, start = 5, step = 1e-5;
        double speed = start, surface = 0, distance = 0;
        for (int i = 0; i < 200_000; ++i)
        {
            // m dv/dt = -F, I dw/dt = F r with I = 2/5 m r^2: the surface speed w r rises by 5/2 F / m. F = mu m g while it slips.
            double slip = speed - surface;
            double force = Math.Min(mu * g, slip / step * (2d / 7));
            double next = speed - force * step;
            distance += (speed + next) / 2 * step;
            (speed, surface) = (next, surface + 2.5 * force * step);
            if (i == 20_000)
                Assert.Equal(SlidingOracle.SlidingSphereSpeed(g, mu, start, (i + 1) * step), speed, 1e-3);
        }
        Assert.Equal(5d / 7 * start, speed, 1e-6);
        Assert.Equal(SlidingOracle.SlidingSphereSpeed(g, mu, start, 2), speed, 1e-6);
        Assert.Equal(SlidingOracle.SlidingSphereDistance(g, mu, start, 2), distance, 1e-4);
    }

    [Fact]
    public void EulerSumIsTheClosedForm()
    {
        Double3 position = new(1, 2, 3), velocity = new(1000, 0, 5), gravity = new(0, -9.81, 0);
        var start = (position, velocity);
        const double h = 1 / 60d;
        for (int i = 0; i < 600; ++i)
        {
            velocity += gravity * h;
            position += velocity * h;
        }
        Assert.True((position - FallingOracle.SemiImplicitEuler(start.position, start.velocity, gravity, h, 600)).Length < 1e-8);
        var exact = FallingOracle.Position(start.position, start.velocity, gravity, 10);
        Assert.Equal(9.81 * 10 * h / 2, exact.Y - position.Y, 1e-8);
    }

    [Fact]
    public void BoxOverlapIsKnownForSimplePoses()
    {
        var half = new Double3(.5, .5, .5);
        var straight = DoubleQuaternion.Identity;
        Assert.Equal(.1, BoxOverlapOracle.Depth(half, Double3.Zero, straight, half, new(.9, .2, 0), straight), 1e-12);
        Assert.Equal(1, BoxOverlapOracle.Depth(half, Double3.Zero, straight, half, Double3.Zero, straight), 1e-12);
        // A cube turned by 45 degrees shows its edge: reach sqrt(1/2).
        var turned = DoubleQuaternion.FromAxisAngle(new(0, 0, 1), Math.PI / 4);
        Assert.Equal(.5 + Math.Sqrt(.5) - 1.3, BoxOverlapOracle.Depth(half, Double3.Zero, straight, half, new(1.3, 0, 0), turned), 1e-12);
        // Two crossed edges: only the cross product of the edges finds that they are apart.
        var tiltX = DoubleQuaternion.FromAxisAngle(new(1, 0, 0), Math.PI / 4);
        double edges = BoxOverlapOracle.Depth(half, Double3.Zero, turned, half, new(0, 2 * Math.Sqrt(.5) + .01, 0), tiltX);
        Assert.Equal(-.01, edges, 1e-12);
    }
}
