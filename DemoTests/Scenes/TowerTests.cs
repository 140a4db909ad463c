using System.Linq;
using BepuPhysics;
using Demos.Towers;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Structures of loose parts at the default setting: what stands in truth stands, and what falls falls.</summary>
public class TowerTests
{
    /// <summary>At rest nothing has moved by more than a few millimetres, whatever the height.</summary>
    [Theory]
    [InlineData("cubes-100", .005)]
    [InlineData("slim-50", .001)]
    [InlineData("cylinders-40", .001)]
    [InlineData("hulls-20", .001)]
    [InlineData("wall-30", .001)]
    [InlineData("wall-door", .001)]
    [InlineData("dry-stone", .001)]
    [InlineData("house", .001)]
    [InlineData("jenga-7.5", .001)]
    public void A_structure_stands_as_it_was_built(string name, double tolerance)
    {
        TowerResult result = Watch(name, new TowerSettings());
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.HeightLost, -tolerance, tolerance);
        Assert.InRange(result.Lean, 0, tolerance);
    }

    /// <summary>By sweeps alone all but the house fell by themselves while contacts took over the lean of a stack from step to step.</summary>
    [Theory]
    [InlineData("cubes-20", .14, .03)]
    [InlineData("cubes-30", .3, .06)]
    [InlineData("slim-30", .25, .06)]
    [InlineData("flat-20", .2, .02)]
    [InlineData("wall-16", .05, .03)]
    [InlineData("wall-door", .05, .03)]
    [InlineData("house", .02, .01)]
    public void A_structure_stands_by_sweeps_alone(string name, double heightLost, double lean)
    {
        TowerResult result = Watch(name, new TowerSettings { LoadPath = LoadPathMode.Off });
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.HeightLost, 0, heightLost);
        Assert.InRange(result.Lean, 0, lean);
    }

    /// <summary>For a minute, out of place by up to a millimetre.</summary>
    [Theory]
    [InlineData(1, LoadPathMode.Off)]
    [InlineData(2, LoadPathMode.Off)]
    [InlineData(3, LoadPathMode.Off)]
    [InlineData(1, LoadPathMode.WhereNeeded)]
    [InlineData(2, LoadPathMode.WhereNeeded)]
    [InlineData(3, LoadPathMode.WhereNeeded)]
    public void A_stack_of_fifty_stands_for_a_minute(int seed, LoadPathMode loadPath)
    {
        TowerResult result = Watch("slim-50", new TowerSettings { Seconds = 60, Offset = .001f, Seed = seed, LoadPath = loadPath });
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.Lean, 0, .2);
    }

    /// <summary>Of which the topmost box is pushed: while a stack sways its contacts are let go, or it would sway more and more.</summary>
    [Theory]
    [InlineData("cubes-20", .5f)]
    [InlineData("slim-20", .3f)]
    [InlineData("slim-20", .5f)]
    [InlineData("slim-house", .1f)]
    [InlineData("slim-house", .5f)]
    public void A_pushed_structure_comes_to_rest(string name, float push)
    {
        TowerResult result = Watch(name, new TowerSettings { Push = push });
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.Lean, 0, .15);
    }

    /// <summary>At the time at which they fall with 64 relaxed substeps, to a fifth: softer contacts let them begin to fall at once.</summary>
    [Theory]
    [InlineData("offset-.09")]
    [InlineData("offset-.12")]
    [InlineData("arch-08")]
    public void What_must_fall_falls_when_it_must(string name)
    {
        TowerResult result = Watch(name, new TowerSettings());
        TowerResult reference = Watch(name, new TowerSettings { Substeps = 64, Relaxations = 1, LoadPath = LoadPathMode.Off });
        Assert.False(result.Stands);
        Assert.InRange((double)result.FellAt!, .8 * (double)reference.FellAt!, 1.2 * (double)reference.FellAt);
    }

    [Theory]
    [InlineData("slips", .1)]
    [InlineData("tips", .2)]
    [InlineData("edge-100", 2)]
    [InlineData("edge-10", 1)]
    public void What_must_slip_or_tip_does_so_where_it_must(string name, double tolerance)
    {
        var trial = StructureLibrary.Trials.Single(trial => trial.Name == name);
        Assert.InRange(trial.Measure(new TowerSettings()), trial.Truth - tolerance, trial.Truth + tolerance);
    }

    [Theory]
    [InlineData("cubes-30")]
    [InlineData("wall-16")]
    [InlineData("hulls-10")]
    public void Threads_make_no_difference(string name)
    {
        var expected = Watch(name, new TowerSettings { Seconds = 5 });
        foreach (int threads in new[] { 2, 3 })
        {
            var result = Watch(name, new TowerSettings { Seconds = 5, Threads = threads });
            Assert.Equal((expected.HeightLost, expected.Lean), (result.HeightLost, result.Lean));
        }
    }

    static TowerResult Watch(string name, TowerSettings settings)
    {
        using var run = new TowerRun(StructureLibrary.All.Single(structure => structure.Name == name), settings);
        return run.Run();
    }
}
