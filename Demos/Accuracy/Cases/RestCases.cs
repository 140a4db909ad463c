using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>A box that lies there (C4): it stays where it was put.</summary>
static class RestCases
{
    public static IEnumerable<AccuracyCase> All { get; } = new[] { 1f, 1000 }.SelectMany(mass =>
        AccuracySuite.AtBothEfforts("C4", FormattableString.Invariant($"box of {mass} kg"), (settings, result) => Run(settings, mass, result)));

    static void Run(AccuracySettings settings, float mass, CaseResult result)
    {
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
        result.Limit("moved", moved, .005, "m").Limit("speed", speed, .001, "m/s").Note("turned", turned, "rad");
    }
}
