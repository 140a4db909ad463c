using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>What lies flat, slides and turns (C13): how far it comes, and by how much it turns, until it rests.</summary>
static class SlidingSpinCases
{
    const float Friction = .5f;
    const float Mass = 2;
    const float Size = 1;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from flat in new[] { "disc", "slab", "plank", "crate" }
           from motion in new (float Speed, float Spin)[] { (0, 20), (.5f, 20), (3, 20), (3, 5), (3, 0) }
           from one in AccuracySuite.AtBothEfforts("C13", FormattableString.Invariant($"{flat}, {motion.Speed} m/s and {motion.Spin} rad/s"),
               (settings, result) => Slide(settings, flat, motion.Speed, motion.Spin, result))
           select one,
    ];

    static void Slide(AccuracySettings settings, string flat, float speed, float spin, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Friction = Friction });
        world.AddGround();
        var height = flat == "crate" ? .6f : .1f;
        var depth = flat == "plank" ? .2f : Size;
        var pose = new RigidPose(new Vector3(0, height / 2, 0));
        var velocity = new BodyVelocity(new Vector3(speed, 0, 0), new Vector3(0, spin, 0));
        var isDisc = flat == "disc";
        var body = isDisc
            ? world.AddDynamic(new Cylinder(Size / 2, height), Mass, pose, velocity)
            : world.AddDynamic(new Box(Size, height, depth), Mass, pose, velocity);
        var surface = isDisc ? EvenFriction.Disc(Size / 2) : EvenFriction.Rectangle(Size, depth);
        var squaredGyration = isDisc ? Size * Size / 8 : (Size * Size + depth * depth) / 12;
        var (distance, angle) = surface.Rest(-Friction * settings.Gravity.Y, squaredGyration, speed, spin);
        double turned = 0;
        world.Run(4, () => turned += world.AngularVelocity(body).Y * settings.Dt);
        if (speed > 0)
            result.Limit("slid", (world.Position(body) - (Double3)pose.Position).Length / distance - 1, .1, "%");
        if (spin > 0)
            result.Limit("turned", turned / angle - 1, .15, "%");
        result.Limit("slid of itself", speed > 0 ? 0 : (world.Position(body) - (Double3)pose.Position).Length, .01, "m")
            .Limit("turned of itself", spin > 0 ? 0 : turned, .01, "rad");
    }
}
