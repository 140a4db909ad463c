using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.LoadPath;

/// <summary>What lands slowly is brought to rest at once, as rigid bodies are, and does not first sink in as far as soft contacts give way.</summary>
public class LandingTests(ITestOutputHelper output)
{
    /// <summary>A stack that touches the ground moves down with one speed: rigid bodies stop where they are, and none goes up again.</summary>
    [Theory]
    [InlineData(3, .05f), InlineData(3, .2f), InlineData(3, 1)]
    [InlineData(20, .05f), InlineData(20, .2f), InlineData(20, .5f), InlineData(20, 1)]
    [InlineData(50, .05f), InlineData(50, .2f), InlineData(50, 1)]
    public void A_stack_that_is_put_down_stops_where_it_is(int count, float speed)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var boxes = Enumerable.Range(0, count).Select(i => world.Add(new Vector3(0, .5f + i, 0), Vector3.One, 1, new Vector3(0, -speed, 0))).ToArray();
        double lowest = 0, upward = 0, moved = 0;
        for (int step = 0; step < 300; ++step)
        {
            world.Step();
            for (int i = 0; i < count; ++i)
            {
                lowest = Math.Max(lowest, .5 + i - world.Position(boxes[i]).Y);
                upward = Math.Max(upward, world.Velocity(boxes[i]).Y);
            }
            moved = Math.Max(moved, world.Moved);
        }
        output.WriteLine($"{count} at {speed} m/s: lower by {lowest:e2} m, upward {upward:e2} m/s, moved {moved:e2} m");
        Assert.InRange(lowest, 0, 1e-4);
        Assert.InRange(upward, 0, 1e-3);
        Assert.InRange(moved, 0, 1e-3);
    }
}
