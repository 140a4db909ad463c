using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using Demos.Towers;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.LoadPath;

/// <summary>Columns whose top is pushed, at the default setting: they stand as with 64 relaxed substeps, and what truly falls falls as it does there.</summary>
public class SwayTests(ITestOutputHelper output)
{
    static readonly TowerSettings reference = new() { Substeps = 64, Relaxations = 1, LoadPath = LoadPathMode.Off };

    static TowerResult Watch(string name, TowerSettings settings)
    {
        using var run = new TowerRun(StructureLibrary.All.Single(structure => structure.Name == name), settings);
        return run.Run();
    }

    /// <summary>By 64 relaxed substeps none loses more than 5 mm. Before, 30 cubes lost 249 mm, and all of the others fell.</summary>
    [Theory]
    [InlineData("cubes-30", .5f, .03), InlineData("cubes-100", .5f, .03), InlineData("slim-100", .5f, .03), InlineData("hulls-20", .5f, .03)]
    [InlineData("cubes-50", 1, .12), InlineData("slim-50", 1, .12), InlineData("hulls-20", 1, .12)]
    public void A_stack_whose_top_is_pushed_stands(string name, float push, double mostLean)
    {
        var result = Watch(name, new() { Push = push });
        output.WriteLine($"lost {result.HeightLost:f4} m, leans by {result.Lean:f4} m");
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.HeightLost, -.005, .005);
        Assert.InRange(result.Lean, 0, mostLean);
    }

    /// <summary>Storeys on slim posts, which no column is: before, they leant by 46 and 38 mm; by 64 relaxed substeps with seed 1 by 2.8.</summary>
    [Theory, InlineData(0, 1), InlineData(.001f, 1), InlineData(.001f, 3)]
    public void A_house_whose_top_is_pushed_stands(float offset, int seed)
    {
        var result = Watch("slim-house", new() { Push = .5f, Offset = offset, Seed = seed, Seconds = 10 });
        output.WriteLine($"lost {result.HeightLost:f4} m, leans by {result.Lean:f4} m");
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.HeightLost, -.002, .002);
        Assert.InRange(result.Lean, 0, .032);
    }

    [Theory, InlineData("offset-.09"), InlineData("offset-.12")]
    public void What_truly_falls_falls_as_soon_as_by_64_relaxed_substeps(string name)
    {
        var result = Watch(name, new() { Seconds = 6 });
        var expected = Watch(name, reference with { Seconds = 6 });
        output.WriteLine($"{result.FellAt} s, {expected.FellAt} s");
        Assert.False(expected.Stands);
        Assert.InRange((double)(result.FellAt / expected.FellAt)!, .9, 1.1);
    }

    /// <summary>As a rigid body about the edge of the lowest box: nine boxes whose centre is .1 m beyond it, while no face has opened that was held.</summary>
    [Fact]
    public void What_tips_over_turns_together()
    {
        const float aside = .12f;
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var boxes = Enumerable.Range(0, 10).Select(i => world.Add(new Vector3(i * aside, .5f + i, 0), Vector3.One, 1)).ToArray();
        for (int step = 1; step <= 12; ++step)
        {
            world.Step();
            if (step < 3)
                continue;
            double moment = 0, inertia = 0;
            for (int i = 1; i < 10; ++i)
            {
                double x = i * aside - .5, y = i - .5;
                moment += 9.81 * x;
                inertia += 1 / 6.0 + x * x + y * y;
            }
            var expected = moment / inertia * step * LoadPathWorld.Dt;
            for (int i = 1; i < 10; ++i)
                Assert.InRange(-world.Simulation.Bodies[boxes[i]].Velocity.Angular.Z / expected, .8, 1.2);
        }
    }

    /// <summary>To who moves along with it a stack on a lift or a wagon sways as on the ground.</summary>
    [Fact]
    public void What_sways_on_the_ground_sways_on_a_lift()
    {
        foreach (var velocity in new Vector3[] { default, new(0, 2, 0), new(3, 0, 1) })
        {
            using var lift = new FloorWorld(_ => velocity);
            BodyHandle top = default;
            for (int i = 0; i < 30; ++i)
                top = lift.Add(new Vector3(0, .5f + i, 0), Vector3.One);
            lift.Run(2);
            lift.Simulation.Bodies[top].Velocity.Linear.X += .5f;
            double lowest = 0;
            while (lift.Time < 12)
            {
                lift.Step();
                for (int box = 0; box < lift.Count; ++box)
                    lowest = Math.Max(lowest, .5 + box - lift.Place(box).Y);
            }
            output.WriteLine($"{velocity}: lower by {lowest:e2} m, moved {lift.Moved:e2} m");
            Assert.InRange(lowest, 0, 3e-3);
            Assert.InRange(lift.Moved, .01, .04);
        }
    }

    [Fact]
    public void Threads_make_no_difference()
    {
        var one = Watch("cubes-50", new() { Seconds = 4, Push = .5f });
        var three = Watch("cubes-50", new() { Seconds = 4, Push = .5f, Threads = 3 });
        Assert.Equal((one.HeightLost, one.Lean), (three.HeightLost, three.Lean));
    }
}
