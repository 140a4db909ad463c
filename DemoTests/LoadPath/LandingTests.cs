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

    /// <summary>
    /// A stack that moves aside as it touches the ground rocks and stands. Before, one of twenty that came with .5 and .1 m/s was 206 mm lower on its way, and
    /// leant by 168 mm in the end; 64 relaxed substeps have these lean by 1 to 22 mm.
    /// </summary>
    [Theory]
    [InlineData(5, 1, .5f, .1f, .002), InlineData(20, 1, .05f, .05f, .01), InlineData(20, 1, .2f, .1f, .03), InlineData(20, 1, .5f, .1f, .02)]
    [InlineData(20, .7f, .5f, .1f, .03), InlineData(20, 1, 1, .1f, .02), InlineData(50, 1, .5f, .1f, .06)]
    public void A_stack_that_lands_moving_aside_stands(int count, float width, float down, float aside, double mostLean)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var boxes = Enumerable.Range(0, count)
            .Select(i => world.Add(new Vector3(0, .5f + i, 0), new Vector3(width, 1, width), 1, new Vector3(aside, -down, 0))).ToArray();
        double lowest = 0;
        for (int step = 0; step < 600; ++step)
        {
            world.Step();
            for (int i = 0; i < count; ++i)
                lowest = Math.Max(lowest, .5 + i - world.Position(boxes[i]).Y);
        }
        var lean = boxes.Max(box => Math.Abs(world.Position(box).X));
        output.WriteLine($"{count} at {down}, {aside} m/s: lower by {lowest:e2} m, leans by {lean:e2} m");
        Assert.InRange(lowest, 0, 1e-3);
        Assert.InRange(lean, 0, mostLean);
    }

    /// <summary>
    /// A brick wall that moves aside as it touches the ground, along or across it: before, one of sixteen rows leant by 203 to 226 mm in the end and had been
    /// 67 to 107 mm lower on its way. 64 relaxed substeps have it lean by .6, 8.6 and 10.6 mm.
    /// </summary>
    [Theory]
    [InlineData(16, 10, .05f, .05f, 0, .001), InlineData(16, 10, .5f, .1f, 0, .001), InlineData(16, 10, .5f, 0, .1f, .02)]
    [InlineData(16, 10, 1, 0, .1f, .015), InlineData(8, 4, .5f, .1f, 0, .001), InlineData(8, 4, .5f, 0, .1f, .004)]
    public void A_wall_that_lands_moving_aside_stands(int rows, int bricks, float down, float along, float across, double mostLean)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        world.AddWall(rows, bricks, new Vector3(along, -down, across));
        double most = 0;
        for (int step = 0; step < 480; ++step)
        {
            world.Step();
            most = Math.Max(most, world.Lowered);
        }
        output.WriteLine($"{rows} rows at {down}, {along}, {across} m/s: lower by {most:e2} m, moved {world.Moved:e2} m");
        Assert.InRange(most, 0, 2e-3);
        Assert.InRange(world.Moved, 0, mostLean);
    }

    /// <summary>A slab on four posts, storey on storey, comes to rest where it lands, as each of them is balanced.</summary>
    [Theory, InlineData(1), InlineData(2), InlineData(4)]
    public void A_house_that_lands_moving_aside_stands(int storeys)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        world.AddPosts(storeys, new Vector3(.1f, -.2f, 0));
        world.Run(8);
        output.WriteLine($"{storeys} storeys: moved {world.Moved:e2} m");
        Assert.InRange(world.Moved, 0, .002);
    }

    /// <summary>Walls and posts that are over their edge as they land are not held, and fall no later than with 64 relaxed substeps.</summary>
    [Theory, InlineData(true, .5f, .8f), InlineData(false, .5f, 1)]
    public void A_structure_that_is_not_balanced_falls(bool isWall, float down, float aside)
    {
        float Falls(LoadPathMode mode, int substeps, int relaxations)
        {
            using var world = new LoadPathWorld(mode, substeps: substeps, relaxations: relaxations);
            if (isWall)
                world.AddWall(16, 6, new Vector3(0, -down, aside));
            else
                world.AddPosts(2, new Vector3(aside, -down, 0));
            for (int step = 1; step <= 300; ++step)
            {
                world.Step();
                if (world.Moved > .7)
                    return step * LoadPathWorld.Dt;
            }
            return float.PositiveInfinity;
        }
        float time = Falls(LoadPathMode.WhereNeeded, 4, 0), expected = Falls(LoadPathMode.Off, 64, 1);
        output.WriteLine($"{time} s, {expected} s");
        Assert.True(expected < 5);
        Assert.InRange(time / expected, .7f, 1.1f);
    }

    /// <summary>What is over its edge as it lands, or comes to be by its speed, is not held on its way: it falls as with 64 relaxed substeps.</summary>
    [Theory, InlineData(10, .12f, .2f, .1f), InlineData(10, .13f, .5f, .2f), InlineData(10, .12f, .5f, -.1f)]
    public void What_lands_and_falls_over_does_so_in_its_time(int count, float each, float down, float aside)
    {
        float Falls(LoadPathMode mode, int substeps, int relaxations)
        {
            using var world = new LoadPathWorld(mode, substeps: substeps, relaxations: relaxations);
            var top = Enumerable.Range(0, count)
                .Select(i => world.Add(new Vector3(i * each, .5f + i, 0), Vector3.One, 1, new Vector3(aside, -down, 0))).ToArray()[^1];
            for (int step = 1; step <= 600; ++step)
            {
                world.Step();
                if (world.Position(top).Y < count - 2)
                    return step * LoadPathWorld.Dt;
            }
            return float.PositiveInfinity;
        }
        float time = Falls(LoadPathMode.WhereNeeded, 4, 0), expected = Falls(LoadPathMode.Off, 64, 1);
        output.WriteLine($"{time} s, {expected} s");
        Assert.InRange(time / expected, .9f, 1.1f);
    }

    [Fact]
    public void Threads_make_no_difference()
    {
        static (Vector3, double) Top(int threads)
        {
            using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, threads: threads);
            var boxes = Enumerable.Range(0, 40).Select(i => world.Add(new Vector3(0, .5f + i, -5), Vector3.One, 1, new Vector3(.1f, -.5f, 0))).ToArray();
            world.AddWall(12, 8, new Vector3(.1f, -.5f, .1f));
            world.Run(1);
            return (world.Position(boxes[^1]), world.Moved);
        }
        Assert.Equal(Top(1), Top(3));
    }
}
