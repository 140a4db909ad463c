using Demos.Accuracy;
using Xunit;

namespace DemoTests.Accuracy;

/// <summary>The suite's own judgement: a miss fails where it is enforced, what is not finite fails everywhere.</summary>
public class CaseResultTests
{
    static CaseResult With(double value) => new CaseResult("id", "scene", "settings").Limit("error", value, .05, "%").Note("way", 3, "m");

    [Theory]
    [InlineData(.04, true, true)]
    [InlineData(-.04, true, true)]
    [InlineData(.06, true, false)]
    [InlineData(-.06, true, false)]
    [InlineData(.06, false, true)]
    [InlineData(double.NaN, false, false)]
    [InlineData(double.NegativeInfinity, false, false)]
    public void JudgesAgainstTheLimit(double value, bool enforce, bool passes) =>
        Assert.Equal(passes, With(value).Failure(enforce) is null);

    [Fact]
    public void NamesWhatFailed() =>
        Assert.Equal("id, scene, settings: error is 6 %, must be within 5 %", With(.06).Failure(enforce: true));

    [Fact]
    public void RowHoldsFiguresLimitsAndVerdict()
    {
        Assert.Equal("| id | scene | settings | error 4 %, way 3 m | error 5 % | met |", With(.04).Row(enforce: true));
        Assert.Equal("| id | scene | settings | error -6 %, way 3 m | error 5 % | missed (reported) |", With(-.06).Row(enforce: false));
    }

    [Fact]
    public void ExtremesKeepSignAndNotANumber()
    {
        Assert.Equal(-3, Tally.Worst(2, -3));
        Assert.Equal(-3, Tally.Worst(-3, 2));
        Assert.Equal(double.NaN, Tally.Worst(Tally.Worst(2, double.NaN), 5));
        Assert.Equal(2, Tally.Most(2, -3));
        Assert.Equal(double.NaN, Tally.Most(Tally.Most(2, double.NaN), 5));
    }
}
