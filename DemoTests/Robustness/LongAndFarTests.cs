using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Robustness;

/// <summary>A stack that rests for a very long time, and one that rests very far from the origin, at the default setting.</summary>
public class LongAndFarTests(ITestOutputHelper output)
{
    const float Gravity = 9.81f;
    const int BoxCount = 3;

    /// <summary>
    /// A resting stack is where it was put: nothing adds up. The bound is twice the band about zero, .5 mm for a box of 1 m, in which a held contact knows no
    /// overlap.
    /// </summary>
    /// <remarks>PHYSICS_FULL_TESTS: a million steps, four and a half hours of the game's time, in place of five thousand.</remarks>
    [Fact]
    public void A_stack_that_rests_for_long_stays_where_it_is()
    {
        int steps = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is { Length: > 0 } ? 1_000_000 : 5_000;
        double moved = 0, speed = 0;
        Run(default, steps, boxes =>
        {
            foreach (var (body, start) in boxes)
            {
                moved = Math.Max(moved, (body.Pose.Position - start).Length());
                speed = Math.Max(speed, body.Velocity.Linear.Length());
            }
        });
        output.WriteLine(FormattableString.Invariant($"{steps} steps: moved {moved} m, speed {speed} m/s"));
        Assert.InRange(moved, 0, 1e-3);
        Assert.InRange(speed, 0, 1e-2);
    }

    /// <summary>
    /// 1e7 m from the origin a float has a step of 1 m: half a box is rounded away and a box of 1 m may lie on the floor or in it. What holds is that numbers
    /// stay finite, nothing is quarantined, and no box has more energy than what a step of rounding on each axis may give.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(10)]
    public void Ten_thousand_kilometres_away_nothing_breaks(float size)
    {
        const float rounding = 1;
        Run(new Vector3(1e7f), 600, boxes =>
        {
            foreach (var (body, start) in boxes)
            {
                var velocity = body.Velocity.Linear;
                double energy = velocity.LengthSquared() / 2.0 + Gravity * ((double)body.Pose.Position.Y - start.Y);
                Assert.True(double.IsFinite(energy), $"{energy} J/kg");
                // Height by a step of rounding for each box below, and the speed at which overlaps are taken out, 2 m/s.
                Assert.InRange(energy, double.NegativeInfinity, Gravity * rounding * (BoxCount + 1) + 2);
            }
        }, size);
    }

    static void Run(Vector3 origin, int steps, Action<List<(BodyReference Body, Vector3 Start)>> look, float size = 1)
    {
        using var pool = new BufferPool();
        using (var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)), SolveDescription.Default))
        {
            simulation.Statics.Add(new StaticDescription(origin - new Vector3(0, 10, 0), simulation.Shapes.Add(new Box(400, 20, 400))));
            var box = new Box(size, size, size);
            var shape = simulation.Shapes.Add(box);
            var boxes = new List<(BodyReference, Vector3)>();
            for (int i = 0; i < BoxCount; ++i)
            {
                var body = simulation.Bodies[simulation.Bodies.Add(BodyDescription.CreateDynamic(
                    origin + new Vector3(0, (i + .5f) * size, 0), box.ComputeInertia(1), shape, -1))];
                boxes.Add((body, body.Pose.Position));
            }
            for (int step = 0; step < steps; ++step)
            {
                simulation.Timestep(1 / 60f);
                look(boxes);
            }
            Assert.Equal(0, simulation.Quarantine.Count);
            simulation.Validate();
        }
        pool.AssertEmpty();
    }
}
