using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>A box that lies there (C4): it stays where it was put.</summary>
public class RestTests(ITestOutputHelper output)
{
    [Theory]
    [InlineData(1, Effort.Accurate)]
    [InlineData(1000, Effort.Accurate)]
    [InlineData(1, Effort.Default)]
    [InlineData(1000, Effort.Default)]
    public void C4_BoxAtRest(float mass, Effort effort)
    {
        var settings = AccuracySettings.For(effort);
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        var body = world.AddDynamic(new Box(1, 1, 1), mass, new RigidPose(new Vector3(0, .5f, 0)));
        var start = world.Position(body);
        double moved = 0, speed = 0, turned = 0;
        world.Run(10, () =>
        {
            moved = Tally.Most(moved, (world.Position(body) - start).Length);
            turned = Tally.Most(turned, DoubleQuaternion.AngleBetween(world.Orientation(body), DoubleQuaternion.Identity));
            // The first second is for settling into the contact.
            if (world.Time > 1)
                speed = Tally.Most(speed, world.LinearVelocity(body).Length);
        });
        new CaseResult("C4", $"box of {mass} kg", settings)
            .Limit("moved", moved, .005, "m")
            .Limit("speed", speed, .001, "m/s")
            .Note("turned", turned, "rad")
            .Finish(output, enforce: effort == Effort.Accurate);
    }
}
