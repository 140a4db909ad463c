using System;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.DirectJoints;

/// <summary>For how long a joint asks to be solved at once, and how an error goes with which it comes from the sweeps.</summary>
public class JointNeedTests
{
    const float Time = .125f;

    [Fact]
    public void It_asks_twice_as_long_each_time_that_it_asks_again_soon()
    {
        var need = new JointNeed();
        for (var period = JointNeed.LeastPeriod; period <= 4 * JointNeed.GreatestPeriod; period *= 2)
        {
            Assert.True(need.Ask());
            Assert.False(need.Ask());
            Assert.Equal(Math.Min(period, JointNeed.GreatestPeriod), TimeAsked(ref need));
            need.Rest(Time);
        }
        // After as long a time in which it did not ask all is as at first.
        for (float passed = 0; passed <= JointNeed.GreatestPeriod; passed += Time)
            need.Rest(Time);
        Assert.True(need.Ask());
        Assert.Equal(JointNeed.LeastPeriod, TimeAsked(ref need));
    }

    [Fact]
    public void One_that_is_refused_may_not_ask_for_a_time()
    {
        var need = new JointNeed();
        need.Ask();
        need.Refuse();
        Assert.Equal(0, need.Asks);
        for (float passed = 0; passed < JointNeed.GreatestPeriod; passed += Time)
        {
            Assert.True(need.Refused > 0);
            need.Rest(Time);
        }
        Assert.Equal(0, need.Refused);
    }

    /// <summary>As exp(-(t / .5 s)^2), whatever the length of a substep: what is corrected in each is carried out here.</summary>
    [Theory]
    [InlineData(1 / 60f)]
    [InlineData(1 / 240f)]
    [InlineData(1 / 960f)]
    public void An_error_goes_slowly_by_time_and_not_by_substeps(float substepDt)
    {
        const double first = .1;
        var need = new JointNeed();
        need.Ease();
        var error = first;
        double t = 0, fastest = 0;
        for (; need.Eases > 0; t += substepDt)
        {
            var change = need.CorrectedPart(ref need.Gap, error, substepDt) * error;
            fastest = Math.Max(fastest, change / substepDt);
            error -= change;
            need.GoOn(substepDt);
            // The correction of what is beyond lags by its time constant, .02 s.
            Assert.InRange(error, .95 * Left(t) - 1e-3, Left(t - .04) + 1e-3);
        }
        Assert.Equal(1.25, t, 1.5 * substepDt);
        Assert.InRange(fastest, 0, 1.05 * .86 * first / .5);
        Assert.InRange(error, 0, .01 * first);

        double Left(double time) => time < 0 ? first : first * Math.Exp(-time * time / .25);
    }

    static float TimeAsked(ref JointNeed need)
    {
        float asked = 0;
        for (; need.Asks > 0; asked += Time)
            need.Rest(Time);
        return asked;
    }
}
