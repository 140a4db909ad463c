using BepuPhysics;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.LoadPath;

/// <summary>
/// Walls that lean too far tip over as rigid bodies do, where a game asks for it: all that is above the edge turns together, from the first step on. What they
/// do is compared with 64 relaxed substeps, which are within 5 % of rows as rigid bodies in the plane in steps of a thousandth of a second.
/// </summary>
public class TippingTests(ITestOutputHelper output)
{
    /// <summary>
    /// Rows aside of each other. Before, these sank in on soft contacts and fell after three quarters to four fifths of the time.
    /// </summary>
    [Theory]
    [InlineData(16, 10, .045f), InlineData(16, 10, .055f), InlineData(16, 10, .07f)]
    [InlineData(16, 4, .05f), InlineData(8, 5, .1f), InlineData(20, 10, .035f)]
    public void A_wall_whose_rows_are_aside_falls_in_its_time(int rows, int bricks, float aside)
    {
        var time = Falls(LoadPathMode.Always, 4, 0, rows, bricks, aside);
        var expected = Falls(LoadPathMode.Off, 64, 1, rows, bricks, aside);
        output.WriteLine($"{rows} rows {aside} m aside: {time} s, {expected} s");
        Assert.InRange(time / expected, .9f, 1.1f);
    }

    /// <summary>Near balance it turns slowly, and nothing of it sinks in: by turning as far as it has by then its topmost row is lower by 2 mm.</summary>
    [Fact]
    public void A_wall_that_begins_to_tip_over_does_not_sink_in()
    {
        using var world = new LoadPathWorld(LoadPathMode.Always);
        world.AddWall(16, 10, default, .035f);
        world.Run(.4f);
        output.WriteLine($"lower by {world.Lowered:e2} m, moved {world.Moved:e2} m");
        Assert.InRange(world.Lowered, 0, .005);
    }

    [Fact]
    public void Threads_make_no_difference()
    {
        static (double, double) Fall(int threads)
        {
            using var world = new LoadPathWorld(LoadPathMode.Always, threads: threads);
            world.AddWall(16, 6, default, .05f);
            world.AddStack(10, .12f);
            world.Run(.6f);
            return (world.Moved, world.Lowered);
        }
        Assert.Equal(Fall(1), Fall(3));
    }

    static float Falls(LoadPathMode mode, int substeps, int relaxations, int rows, int bricks, float aside)
    {
        using var world = new LoadPathWorld(mode, substeps: substeps, relaxations: relaxations);
        world.AddWall(rows, bricks, default, aside);
        for (int step = 1; step <= 300; ++step)
        {
            world.Step();
            if (world.Moved > .5)
                return step * LoadPathWorld.Dt;
        }
        return float.PositiveInfinity;
    }
}
