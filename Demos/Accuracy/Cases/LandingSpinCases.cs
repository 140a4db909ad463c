using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Accuracy.Cases;

/// <summary>A solid sphere that spins falls on something and rolls on from there (C9): its speed.</summary>
/// <remarks>
/// Whatever rubs it does so at the point where it touches, about which its angular momentum stays what it was: I W = (I + m r^2) w, so that it rolls with
/// w r = 2/7 W r. That holds for all ways to get there, as long as friction acts at the surface.
/// </remarks>
static class LandingSpinCases
{
    // Along the ground, of the surface of what spins.
    const double SurfaceSpeed = 2;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from radius in new[] { .5f, .1f, .03f }
           from height in new[] { .5f, 3f }
           from one in AccuracySuite.AtBothEfforts("C9", FormattableString.Invariant($"ball of {radius} m spins and falls {height} m"),
               (settings, result) => Land(settings, radius, height, restitution: 0, result))
           select one,
        .. AccuracySuite.AtBothEfforts("C9", "ball of 0.1 m spins and bounces, e = 0.5", (settings, result) => Land(settings, .1f, 3, .5f, result)),
    ];

    static void Land(AccuracySettings settings, float radius, float height, float restitution, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Friction = 1, Restitution = restitution });
        world.AddGround();
        var spin = new BodyVelocity(default, new Vector3(0, 0, (float)(-SurfaceSpeed / radius)));
        var ball = world.AddDynamic(new Sphere(radius), 1, new RigidPose(new(0, height + radius, 0)), spin);
        world.Run(restitution > 0 ? 6 : 2);
        result.Limit("speed", world.LinearVelocity(ball).X / (SurfaceSpeed * 2 / 7) - 1, .03, "%")
            .Limit("aside", world.LinearVelocity(ball).Z / SurfaceSpeed, 1e-3, "%");
    }
}
