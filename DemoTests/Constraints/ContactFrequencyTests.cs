using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.LoadPath;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>A frequency for rigid contacts: they are springs of it, where sweeps hold that, and stay rigid to whatever else asks.</summary>
public class ContactFrequencyTests
{
    static double RestingDepth(int substeps, float frequency, float gravity)
    {
        using var world = new LoadPathWorld(LoadPathMode.Off, new Vector3(0, -gravity, 0), substeps);
        world.Simulation.Solver.ContactFrequency = frequency;
        var ball = world.Add(new Vector3(0, .5f, 0), new Sphere(.5f), 1);
        world.Run(3);
        return .5 - world.Position(ball).Y;
    }

    /// <summary>g / w2 for a spring of angular frequency w, whatever the mass and the substeps.</summary>
    [Theory]
    [InlineData(8, 30, 100)]
    [InlineData(16, 30, 100)]
    [InlineData(16, 60, 1000)]
    [InlineData(4, 15, 20)]
    public void A_load_rests_at_the_depth_that_the_frequency_says(int substeps, float frequency, float gravity)
    {
        var depth = gravity / Math.Pow(2 * Math.PI * frequency, 2);
        Assert.Equal(depth, RestingDepth(substeps, frequency, gravity), .02 * depth);
    }

    /// <summary>One sweep holds an eighth of a period in a substep, whatever is asked for.</summary>
    [Fact]
    public void Contacts_are_no_stiffer_than_sweeps_hold()
    {
        Assert.Equal(RestingDepth(4, 0, 100), RestingDepth(4, 1000, 100));
        Assert.Equal(RestingDepth(4, 0, 100), RestingDepth(4, .125f * 4 * 60, 100), 1e-6);
    }

    /// <summary>To the load path they are no springs that a game asked for: it carries them. By sweeps the lowest of ten is 11 mm deep.</summary>
    [Fact]
    public void A_tower_is_carried_all_the_same()
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, substeps: 8);
        world.Simulation.Solver.ContactFrequency = 15;
        world.AddStack(10);
        world.Run(5);
        Assert.InRange(world.Moved, 0, 1e-3);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    public void What_is_no_frequency_is_refused(float frequency)
    {
        using var world = new LoadPathWorld(LoadPathMode.Off);
        var solver = world.Simulation.Solver;
        solver.ContactFrequency = 30;
        Assert.Throws<ArgumentOutOfRangeException>(() => solver.ContactFrequency = frequency);
        Assert.Equal(30, solver.ContactFrequency);
        Assert.Throws<ArgumentOutOfRangeException>(
            () => Simulation.Create(world.Simulation.BufferPool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(default),
                new SolveDescription(1, 8) { ContactFrequency = frequency }));
    }
}
