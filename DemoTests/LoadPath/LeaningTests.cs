using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints.Contact;
using Demos.Towers;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>Bodies that lean on each other by their faces, as the stones of an arch, at the default setting.</summary>
public class LeaningTests
{
    const float Gravity = 9.81f;

    static TowerResult Watch(string name, TowerSettings settings)
    {
        using var run = new TowerRun(StructureLibrary.All.Single(structure => structure.Name == name), settings);
        return run.Run();
    }

    static void AssertStands(TowerResult result, float tolerance)
    {
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.HeightLost, -tolerance, tolerance);
        Assert.InRange(result.Lean, 0, tolerance);
    }

    /// <summary>By statics arches stand that are thicker than .1075 of their radius (Milankovitch 1907), of any size.</summary>
    [Theory]
    [InlineData("arch-20", .001f)]
    [InlineData("arch-12", .001f)]
    [InlineData("arch-7", .001f)]
    [InlineData("arch-10cm", .001f)]
    [InlineData("arch-31", .001f)]
    [InlineData("arch-40m", .02f)]
    public void An_arch_stands_as_it_was_built(string name, float tolerance) => AssertStands(Watch(name, new() { Seconds = 10 }), tolerance);

    [Theory, InlineData(1), InlineData(2), InlineData(3)]
    public void An_arch_that_is_out_of_place_stands(int seed) => AssertStands(Watch("arch-12", new() { Seconds = 10, Offset = .01f, Seed = seed }), .001f);

    [Theory, InlineData("arch-20"), InlineData("arch-12")]
    public void An_arch_stands_in_long_and_changing_steps(string name)
    {
        AssertStands(Watch(name, new() { Seconds = 10, StepDuration = 1 / 30f }), .005f);
        AssertStands(Watch(name, new() { Seconds = 10, Steps = StepPattern.Random }), .005f);
    }

    /// <summary>Let go because of the push, the thin one fell within two seconds, and the thick one leaned by five centimetres.</summary>
    [Theory]
    [InlineData("arch-12", .1f, .005f)]
    [InlineData("arch-12", .5f, .005f)]
    [InlineData("arch-20", .3f, .005f)]
    [InlineData("arch-20", .5f, .005f)]
    public void An_arch_whose_keystone_is_pushed_stands(string name, float push, float tolerance) =>
        AssertStands(Watch(name, new() { Seconds = 10, Push = push }), tolerance);

    /// <summary>
    /// With a metre per second, or in steps half as long, as with 64 relaxed substeps: 2.8 / 18, .9 / 7.5, 1.4 / 17, .1 / 1.9 and .6 / 4.6 mm. All but the
    /// third fell.
    /// </summary>
    [Theory]
    [InlineData("arch-12", 1, 60, .01, .03), InlineData("arch-31", 1, 60, .003, .01), InlineData("arch-20", 1, 60, .01, .03)]
    [InlineData("arch-31", .5f, 120, .003, .01), InlineData("arch-10cm", .5f, 120, .003, .01)]
    public void An_arch_that_is_pushed_hard_stands(string name, float push, float frequency, double mostLost, double mostLean)
    {
        var result = Watch(name, new() { Seconds = 6, Push = push, StepDuration = 1 / frequency, Offset = .001f, Seed = 2 });
        Assert.True(result.Stands, $"fell at {result.FellAt} s");
        Assert.InRange(result.HeightLost, -mostLost, mostLost);
        Assert.InRange(result.Lean, 0, mostLean);
    }

    [Fact]
    public void Threads_make_no_difference()
    {
        var one = Watch("arch-12", new() { Seconds = 2, Offset = .01f });
        var three = Watch("arch-12", new() { Seconds = 2, Offset = .01f, Threads = 3 });
        Assert.Equal((one.HeightLost, one.Lean), (three.HeightLost, three.Lean));
    }

    /// <summary>On a slope of 45 degrees, too steep to be a support: held by friction above 1, and sliding as g (sin - mu cos) says below it.</summary>
    [Theory, InlineData(1.02f, 0), InlineData(.95f, 2)]
    public void A_box_on_a_steep_slope_holds_or_slides_as_friction_says(float friction, float tolerancePercent)
    {
        var gravity = Gravity * new Vector3(MathF.Sqrt(.5f), -MathF.Sqrt(.5f), 0);
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, gravity, friction: friction);
        var body = world.Add(new Vector3(0, .25f, 0), new Vector3(1, .5f, 1), 3);
        // Friction knows its limit once the load is there.
        world.Run(.5f);
        var start = world.Position(body).X;
        var speed = world.Velocity(body).X;
        world.Run(2);
        var way = world.Position(body).X - start;
        var expected = 2 * speed + Gravity * MathF.Sqrt(.5f) * MathF.Max(0, 1 - friction) * 2;
        Assert.InRange(way, expected * (1 - tolerancePercent / 100) - 1e-5f, expected * (1 + tolerancePercent / 100) + 1e-5f);
    }

    /// <summary>What a support says that its twist does to the upper body is what the sweeps do with it, whichever body of the constraint that is.</summary>
    [Theory, InlineData(true), InlineData(false)]
    public unsafe void A_twist_turns_the_upper_body_as_in_a_sweep(bool isUpperA)
    {
        const int count = 4;
        var normal = isUpperA ? Vector3.UnitY : -Vector3.UnitY;
        var prestep = new float[ContactPrestepLayout.PrestepFloats(count) * Vector<float>.Count];
        var impulses = new float[ContactPrestepLayout.ImpulseFloats(count) * Vector<float>.Count];
        prestep[(ContactPrestepLayout.Normal(count) + 1) * Vector<float>.Count] = normal.Y;
        fixed (float* prestepPointer = prestep, impulsePointer = impulses)
        {
            var support = new LoadSupport(new SupportLink
            {
                Prestep = prestepPointer,
                Impulses = impulsePointer,
                Lower = isUpperA ? 1 : 0,
                Count = count,
                HasTwoBodies = true,
                IsUpperA = isUpperA,
            });
            support.Read();
            support.TwistAfter += 2;
            support.Change(out _, out var angular);
            support.Write(1);
            var twist = impulses[(ContactPrestepLayout.FrictionImpulse(count) + 3) * Vector<float>.Count];
            // A sweep turns A by the normal times the twist, and B by as much the other way round.
            Assert.Equal(normal * twist * (isUpperA ? 1 : -1), angular);
        }
    }
}
