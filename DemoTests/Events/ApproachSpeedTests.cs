using System;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Events;

/// <summary>The speed of approach that is told of a touch is that at which what falls meets the floor, not that at which the step began.</summary>
public class ApproachSpeedTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(Falling.Ball, 0)]
    [InlineData(Falling.FlatBox, 0)]
    [InlineData(Falling.BoxOnEdge, 0)]
    [InlineData(Falling.Ball, .5f)]
    [InlineData(Falling.FlatBox, .5f)]
    public void What_falls_is_told_of_at_the_speed_of_its_fall(Falling falling, float restitution)
    {
        double worst = 0;
        foreach (float height in new[] { .1f, .3f, 1, 5, 20 })
            foreach (int rate in new[] { 30, 60, 120, 240 })
                worst = Math.Max(worst, Math.Abs(SpeedOf(falling, restitution, height, 1f / rate) / Math.Sqrt(2 * FallingWorld.Gravity * height) - 1));
        output.WriteLine($"{worst:p2}");
        Assert.InRange(worst, 0, .01);
    }

    static float SpeedOf(Falling falling, float restitution, float height, float dt)
    {
        using var world = new FallingWorld(falling, height, restitution);
        float speed = 0;
        for (double time = 0; speed == 0 && time < 3; time += dt)
        {
            world.Simulation.Timestep(dt);
            foreach (ref readonly var touch in world.Simulation.Events.Began)
                speed = touch.ApproachSpeed;
        }
        return speed;
    }
}
