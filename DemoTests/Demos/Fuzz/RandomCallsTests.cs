using System.IO;
using System.Threading;
using Demos.Fuzz;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Runner;

/// <summary>A few thousand of the random calls of which <c>Demos fuzz</c> makes a million.</summary>
[Collection(AloneCollection.Name)]
public class RandomCallsTests
{
    [Theory]
    [InlineData(6, 400)]
    [InlineData(2, 400)]
    [InlineData(3, 60)]
    [InlineData(4, 1500)]
    public void NoRandomCallsBreakAPromise(int seed, int callsPerWorld)
    {
        using var output = new StringWriter();
        using var run = new FuzzRun(new FuzzSettings { Seed = seed, Calls = 3000, CallsPerWorld = callsPerWorld, ShrinkSeconds = 20 }, output);

        int failures = run.Run(CancellationToken.None);

        Assert.True(failures == 0, output.ToString());
        // Both kinds, or there was nothing to see.
        Assert.InRange(run.Counts.Refusals, run.Counts.Calls / 50, run.Counts.Calls * 3 / 4);
        // Short worlds may all end before a step meets what was written through a reference.
        Assert.True(run.Counts.Stopped > 0 || callsPerWorld < 100);
    }

    [Fact]
    public void TheSameSeedMakesTheSameCalls()
    {
        Assert.Equal(Count(8), Count(8));
        Assert.NotEqual(Count(8), Count(9));

        static (long, long, long) Count(int seed)
        {
            using var run = new FuzzRun(new FuzzSettings { Seed = seed, Calls = 1000, Scope = FuzzScope.None }, TextWriter.Null);
            Assert.Equal(0, run.Run(CancellationToken.None));
            return run.Counts;
        }
    }
}
