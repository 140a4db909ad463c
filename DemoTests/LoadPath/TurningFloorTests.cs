using System;
using System.Numerics;
using BepuPhysics;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.LoadPath;

/// <summary>What stands on something that turns slowly stands as on the ground, to who turns along; what cannot hold slides and falls.</summary>
public class TurningFloorTests(ITestOutputHelper output)
{
    static Func<double, BodyVelocity> Carousel(float turn) => _ => new BodyVelocity(default, new Vector3(0, turn, 0));

    // Which swings by an angle, and has turned by just that after each step.
    static Func<double, BodyVelocity> Deck(double degrees, double period, Vector3 axis)
    {
        double Angle(double time) => degrees * Math.PI / 180 * Math.Sin(Math.Tau * time / period);
        return time => new BodyVelocity(default, axis * (float)((Angle(time + FloorWorld.Dt) - Angle(time)) / FloorWorld.Dt));
    }

    // What is 20 m high, at rest on the ground, moves by .13 mm and loses .01; by sweeps alone ten lose 48 and twenty 200, and fall from 1.5 m away on.
    [Theory]
    [InlineData("ten", 0.2f, 0), InlineData("ten", 0.2f, 1.5f), InlineData("ten", 0.2f, 3), InlineData("ten", 0.5f, 0), InlineData("ten", 0.5f, 3)]
    [InlineData("twenty", 0.2f, 0), InlineData("twenty", 0.2f, 3), InlineData("twenty", 0.5f, 0), InlineData("twenty", 0.5f, 1.5f)]
    [InlineData("low wall with gaps", 0.2f, 0), InlineData("low wall with gaps", 0.2f, 3)]
    [InlineData("low wall with gaps", 0.5f, 0), InlineData("low wall with gaps", 0.5f, 3)]
    [InlineData("wall with gaps", 0.2f, 0), InlineData("wall with gaps", 0.2f, 3), InlineData("wall with gaps", 0.5f, 0)]
    [InlineData("heavy", 0.2f, 3), InlineData("heavy", 0.5f, 3)]
    public void Nothing_sinks_on_a_carousel(string structure, float turn, float away)
    {
        using var world = new FloorWorld(Carousel(turn)).With(structure, away);
        AssertStands(world);
    }

    [Theory]
    [InlineData("one", 5, 0), InlineData("three", 5, 0), InlineData("low wall with gaps", 5, 0), InlineData("one", 3, 3)]
    [InlineData("three", 3, 3), InlineData("ten", 3, 3), InlineData("low wall with gaps", 3, 3)]
    public void Nothing_walks_down_a_deck(string structure, double degrees, float away)
    {
        using var world = new FloorWorld(Deck(degrees, 8, away > 0 ? Vector3.UnitX : Vector3.UnitZ)).With(structure, away);
        // A stack of ten is pulled aside by half of what tips it over and more, there and back seven times.
        AssertStands(world, structure == "ten" ? 1e-2 : 5e-3);
    }

    // Ten tip over at g / 10.
    [Theory, InlineData("ten"), InlineData("low wall with gaps"), InlineData("wall with gaps"), InlineData("heavy")]
    public void Nothing_falls_in_a_truck_that_takes_a_bend(string structure)
    {
        const float turn = 0.1f;
        using var world = new FloorWorld(time =>
        {
            // Five metres a second, from which it brakes gently to a stand on the same bend.
            var share = (float)Math.Clamp(1 - (time - 10) / 20, 0, 1);
            var angle = turn * (time < 10 ? time : 10 + 20 * (1 - share * share) / 2);
            var along = new Vector3((float)Math.Cos(angle), 0, -(float)Math.Sin(angle));
            return new BodyVelocity(along * 5 * share, new Vector3(0, turn * share, 0));
        }).With(structure, 1);
        AssertStands(world);
    }

    [Theory, InlineData("three"), InlineData("ten"), InlineData("low wall with gaps")]
    public void Nothing_falls_while_a_carousel_starts_and_stops(string structure)
    {
        using var world = new FloorWorld(time =>
            new BodyVelocity(default, new Vector3(0, 0.1f * (float)Math.Clamp(Math.Min(time, 40 - time), 0, 4), 0))).With(structure, 2);
        AssertStands(world);
    }

    void AssertStands(FloorWorld world, double mostMoved = 5e-3)
    {
        var (moved, lost) = world.Run(60);
        output.WriteLine($"moved {moved:e2} m, lost {lost:e2} m");
        Assert.InRange(lost, 0, 1e-3);
        Assert.InRange(moved, 0, mostMoved);
        // At rest: in the last second nothing goes on.
        var places = new Vector3[world.Count];
        for (int i = 0; i < places.Length; ++i)
            places[i] = world.Place(i);
        world.Run(1);
        for (int i = 0; i < places.Length; ++i)
            Assert.InRange((world.Place(i) - places[i]).Length(), 0, 1e-3);
    }

    /// <summary>Friction holds up to w^2 r = mu g.</summary>
    [Theory, InlineData(0.93f, true), InlineData(1.07f, false)]
    public void What_is_too_far_out_slides(float share, bool stays)
    {
        const float turn = 1.2f;
        var away = share * FloorWorld.Friction * FloorWorld.Gravity / (turn * turn);
        using var world = new FloorWorld(Carousel(turn));
        world.Add(new Vector3(0, 0.1f, away), new Vector3(0.4f, 0.2f, 0.4f));
        var moved = world.Run(10).Moved;
        output.WriteLine($"{moved:e2} m");
        Assert.InRange(moved, stays ? 0 : 1, stays ? 0.02 : double.MaxValue);
    }

    /// <summary>A stack of n cubes tips over where it is pulled aside by g / n.</summary>
    [Theory, InlineData("ten", 1, 1.3f), InlineData("twenty", 0.5f, 2.6f)]
    public void What_is_pulled_aside_too_much_falls(string structure, float turn, float away)
    {
        using var world = new FloorWorld(Carousel(turn)).With(structure, away);
        Assert.InRange(world.Run(10).Moved, 1, double.MaxValue);
    }

    /// <summary>On a deck that tips further and further a flat box slides at the angle of friction, and ten cubes tip over at an angle of 1 / 10.</summary>
    [Theory, InlineData("flat", 0.5f, 0.01), InlineData("ten", 0.1f, 0.02)]
    public void What_is_tipped_too_far_slides_or_falls(string structure, float tangent, double late)
    {
        const float turn = 0.02f;
        using var world = new FloorWorld(_ => new BodyVelocity(default, new Vector3(0, 0, turn)));
        if (structure == "flat")
            world.Add(new Vector3(0, 0.1f, 0), new Vector3(1, 0.2f, 1));
        else
            world.With(structure, 0);
        var limit = Math.Atan(tangent);
        var before = world.Run((limit - 0.01) / turn).Moved;
        output.WriteLine($"{before:e2} m before");
        Assert.InRange(before, 0, 0.01);
        world.Run((0.01 + late) / turn + 2);
        Assert.InRange(world.Run(2).Moved, 0.1, double.MaxValue);
    }

    [Fact]
    public void Threads_and_restoring_do_not_change_a_bit() => FloorWorld.AssertIsRepeatable(
        threads => new FloorWorld(
            time => new BodyVelocity(new Vector3(1, 0, 0), new Vector3(0.02f * (float)Math.Sin(time), 0.3f, 0)), threads: threads).With("wall with gaps", 2),
        2);

    [Fact]
    public void A_step_makes_no_garbage()
    {
        using var world = new FloorWorld(Carousel(0.3f)).With("wall with gaps", 2);
        world.Run(1);
        Assert.Equal(0, Garbage.Of(() => world.Run(0.5)));
    }
}
