using System;
using System.Numerics;
using BepuUtilities;
using Xunit;

namespace DemoTests.Numerics;

/// <summary>The errors that the documentation states, measured against double precision.</summary>
public class TrigonometryTests
{
    delegate Vector<float> WideFunction(Vector<float> x);

    static double MaximumError(WideFunction function, Func<double, double> truth, double from, double to, int count)
    {
        double worst = 0;
        Span<float> lanes = stackalloc float[Vector<float>.Count];
        for (int i = 0; i < count; i += lanes.Length)
        {
            for (int lane = 0; lane < lanes.Length; ++lane)
                lanes[lane] = (float)(from + (to - from) * (i + lane) / (count - 1 + lanes.Length));
            var results = function(new Vector<float>(lanes));
            for (int lane = 0; lane < lanes.Length; ++lane)
            {
                var error = Math.Abs(results[lane] - truth(lanes[lane]));
                worst = error <= worst ? worst : double.IsNaN(error) ? double.PositiveInfinity : error;
            }
        }
        return worst;
    }

    [Theory]
    [InlineData(-Math.PI, Math.PI, 4_000_000)]
    [InlineData(-100, 100, 4_000_000)]
    [InlineData(-1e4, 1e4, 4_000_000)]
    [InlineData(-1e5, 1e5, 4_000_000)]
    public void SineAndCosine(double from, double to, int count)
    {
        Assert.InRange(MaximumError(Wide.Sin, Math.Sin, from, to, count), 0, 1e-7);
        Assert.InRange(MaximumError(Wide.Cos, Math.Cos, from, to, count), 0, 1e-7);
    }

    [Theory]
    [InlineData(3f), InlineData(-1e4f), InlineData(float.NaN)]
    public void AnglesInOtherLanesDoNotChangeABit(float other)
    {
        for (var x = -1f; x <= 1; x += 0.0009765625f)
        {
            Wide.SinCos(new Vector<float>(x), out var sin, out var cos);
            Wide.SinCos(new Vector<float>(x).WithElement(0, other), out var mixedSin, out var mixedCos);
            Assert.Equal(BitConverter.SingleToInt32Bits(sin[1]), BitConverter.SingleToInt32Bits(mixedSin[1]));
            Assert.Equal(BitConverter.SingleToInt32Bits(cos[1]), BitConverter.SingleToInt32Bits(mixedCos[1]));
        }
    }

    [Fact]
    public void SineOfSmallAnglesIsRelativelyAccurate()
    {
        for (var x = 1e-30f; x < 0.5f; x *= 1.01f)
            Assert.InRange(MathHelper.Sin(x) / Math.Sin(x), 1 - 1.5e-7, 1 + 1.5e-7);
    }

    [Fact]
    public void Arccosine() => Assert.InRange(MaximumError(Wide.Acos, Math.Acos, -1, 1, 8_000_000), 0, 4e-7);

    [Fact]
    public void ArccosineNearItsEnds()
    {
        Assert.InRange(MaximumError(Wide.Acos, Math.Acos, 1 - 1e-4, 1, 100_000), 0, 1e-7);
        Assert.InRange(MaximumError(Wide.Acos, Math.Acos, -1, -1 + 1e-4, 100_000), 0, 4e-7);
    }

    [Fact]
    public void AngleOverItsSine()
    {
        Assert.Equal(1, Wide.AsinOverSine(Vector<float>.Zero)[0]);
        for (int i = 1; i <= 1_000_000; ++i)
        {
            var square = Wide.AsinOverSineLimit * i / 1_000_000;
            var sine = Math.Sqrt(square);
            Assert.InRange(Wide.AsinOverSine(new Vector<float>(square))[0] * sine / Math.Asin(sine), 1 - 1.5e-7, 1 + 1.5e-7);
        }
    }

    [Theory]
    [InlineData(1f), InlineData(1e-30f), InlineData(1e30f), InlineData(1e-42f)]
    public void Arctangent(float scale)
    {
        double worst = 0;
        for (int i = 0; i < 400_000; ++i)
        {
            var angle = 2 * Math.PI * i / 400_000;
            var (y, x) = ((float)(Math.Sin(angle) * scale), (float)(Math.Cos(angle) * scale));
            worst = Math.Max(worst, Math.Abs(MathHelper.Atan2(y, x) - Math.Atan2(y, x)));
        }
        Assert.InRange(worst, 0, 4e-7);
    }

    [Fact]
    public void OddCases()
    {
        Assert.Equal(0, MathHelper.Sin(0));
        Assert.Equal(1, MathHelper.Cos(0));
        Assert.Equal(0, MathHelper.Sin(1.1e5f));
        Assert.Equal(1, MathHelper.Cos(-3e38f));
        foreach (var x in new[] { float.NaN, float.PositiveInfinity, float.NegativeInfinity })
        {
            Assert.Equal(float.NaN, MathHelper.Sin(x));
            Assert.Equal(float.NaN, MathHelper.Cos(x));
        }
        Assert.Equal(0, MathHelper.Acos(1));
        Assert.Equal(0, MathHelper.Acos(1.0001f));
        Assert.Equal(MathHelper.Pi, MathHelper.Acos(-1));
        Assert.Equal(MathHelper.Pi, MathHelper.Acos(float.NegativeInfinity));
        Assert.Equal(MathHelper.PiOver2, MathHelper.Acos(0));
        Assert.Equal(float.NaN, MathHelper.Acos(float.NaN));
        Assert.Equal(0, MathHelper.Atan2(0, 0));
        Assert.Equal(0, MathHelper.Atan2(0, 1));
        Assert.Equal(MathHelper.Pi, MathHelper.Atan2(0, -1));
        Assert.Equal(MathHelper.PiOver2, MathHelper.Atan2(1, 0));
        Assert.Equal(-MathHelper.PiOver2, MathHelper.Atan2(float.NegativeInfinity, 1));
        Assert.Equal(float.NaN, MathHelper.Atan2(float.NaN, 1));
        Assert.Equal(float.NaN, MathHelper.Atan2(1, float.NaN));
        Assert.Equal(float.NaN, MathHelper.Atan2(float.PositiveInfinity, float.PositiveInfinity));
    }

    [Fact]
    public void ScalarAndWideAgreeToTheBit()
    {
        var samples = new WideSamples(3);
        for (int i = 0; i < 20_000; ++i)
        {
            var x = samples.Numbers(i % 2 == 0 ? 4 : 2e5f);
            var y = samples.Numbers();
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                AssertSameBits(Wide.Sin(x)[lane], MathHelper.Sin(x[lane]));
                AssertSameBits(Wide.Cos(x)[lane], MathHelper.Cos(x[lane]));
                AssertSameBits(Wide.Acos(y)[lane], MathHelper.Acos(y[lane]));
                AssertSameBits(Wide.Atan2(y, x)[lane], MathHelper.Atan2(y[lane], x[lane]));
            }
        }
    }

    /// <summary>Bits that every machine and every width must reproduce: a change here changes every recorded simulation.</summary>
    [Fact]
    public void BitsAreTheSameOnEveryMachine()
    {
        var hash = new BepuUtilities.Diagnostics.StateHash();
        for (int i = -5000; i <= 5000; ++i)
        {
            hash.Add(MathHelper.Sin(i * 0.37f));
            hash.Add(MathHelper.Cos(i * 1.91f));
            hash.Add(MathHelper.Acos(i / 5000f));
            hash.Add(MathHelper.Atan2(i * 0.01f, 7 - i % 13));
        }
        Assert.Equal(13624201660400696159UL, hash.Value);
    }

    [Fact]
    public void SignedDifferenceOfAngles()
    {
        var samples = new WideSamples(8);
        for (int i = 0; i < 1000; ++i)
        {
            var (a, b) = (samples.Numbers(20), samples.Numbers(20));
            MathHelper.GetSignedAngleDifference(a, b, out var difference);
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                var truth = Math.IEEERemainder((double)b[lane] - a[lane], 2 * Math.PI);
                Assert.InRange(Math.Abs(Math.IEEERemainder(difference[lane] - truth, 2 * Math.PI)), 0, 1e-5);
                Assert.InRange(difference[lane], -3.1416f, 3.1416f);
            }
        }
    }

    static void AssertSameBits(float expected, float actual) =>
        Assert.Equal(BitConverter.SingleToInt32Bits(expected), BitConverter.SingleToInt32Bits(actual));
}
