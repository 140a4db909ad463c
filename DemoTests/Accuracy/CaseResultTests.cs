using Demos.Accuracy;
using Xunit;

namespace DemoTests.Accuracy;

/// <summary>The suite's own judgement: a miss fails where it is not known, what is not finite fails everywhere, and a known miss that is none.</summary>
public class CaseResultTests
{
    static CaseResult With(double value, string? knownMiss = null) =>
        new CaseResult("id", "scene", "settings") { KnownMiss = knownMiss }.Limit("error", value, .05, "%").Note("way", 3, "m");

    [Theory]
    [InlineData(.04, null, true)]
    [InlineData(-.04, null, true)]
    [InlineData(.06, null, false)]
    [InlineData(-.06, null, false)]
    [InlineData(.06, "why", true)]
    [InlineData(.04, "why", false)]
    [InlineData(double.NaN, "why", false)]
    [InlineData(double.NegativeInfinity, "why", false)]
    public void JudgesAgainstTheLimit(double value, string? knownMiss, bool passes) =>
        Assert.Equal(passes, With(value, knownMiss).Failure is null);

    [Fact]
    public void NamesWhatFailed() =>
        Assert.Equal("id, scene, settings: error is 6 %, must be within 5 %", With(.06).Failure);

    [Fact]
    public void RowHoldsFiguresLimitsAndVerdict()
    {
        Assert.Equal("| id | scene | settings | error 4 %, way 3 m | error 5 % | met |", With(.04).Row);
        Assert.Equal("| id | scene | settings | error -6 %, way 3 m | error 5 % | missed: why |", With(-.06, "why").Row);
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
