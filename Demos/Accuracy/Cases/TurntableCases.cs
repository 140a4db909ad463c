using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>What stands and what rolls on a platform that turns (C10).</summary>
/// <remarks>
/// What stands on a turntable stays where it is on it, as long as friction bears m W^2 r. A solid sphere that rolls on one without slipping goes round in a
/// circle, wherever it is, at 2/7 of the turntable's W: the surface moves with W x r at the contact, and m dv/dt = F and I dw/dt = a x F give
/// dv/dt = 2/7 W x v.
/// </remarks>
static class TurntableCases
{
    const float Away = 3;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from kind in new[] { "box", "cylinder" }
           from turn in new[] { .5f, 1.5f }
           from one in AccuracySuite.AtBothEfforts("C10", FormattableString.Invariant($"{kind} on a carousel of {turn} rad/s"),
               (settings, result) => Stand(settings, kind == "box", turn, result))
           select one,
        .. AccuracySuite.AtBothEfforts("C10", "box on a turntable of 50 kg that a hinge holds and a motor turns", StandOnBody),
        .. new[] { 1f, 3f }.SelectMany(turn => AccuracySuite.AtBothEfforts("C10", FormattableString.Invariant($"ball rolls on a turntable of {turn} rad/s"),
            (settings, result) => Roll(settings, turn, result))),
    ];

    static BodyHandle AddDisc(AccuracyWorld world, float turn)
    {
        var disc = world.AddKinematic(new Cylinder(20, 1), new RigidPose(new(0, -.5f, 0)));
        world.Bodies[disc].Velocity.Angular = new(0, turn, 0);
        return disc;
    }

    static void Stand(AccuracySettings settings, bool isBox, float turn, CaseResult result)
    {
        const double seconds = 20;
        using var world = new AccuracyWorld(settings with { Friction = 1 });
        var disc = AddDisc(world, turn);
        var pose = new RigidPose(new(Away, .25f, 0));
        var velocity = new BodyVelocity(new(0, 0, -turn * Away), new(0, turn, 0));
        var body = isBox ? world.AddDynamic(new Box(.5f, .5f, .5f), 1, pose, velocity) : world.AddDynamic(new Cylinder(.3f, .5f), 1, pose, velocity);
        world.Run(seconds);
        var place = world.Orientation(disc).RotateBack(world.Position(body));
        result.Limit("outwards", Math.Sqrt(place.X * place.X + place.Z * place.Z) - Away, 2e-3, "m")
            .Limit("along", Away * Math.Atan2(-place.Z, place.X), 2e-3, "m");
    }

    // A body as a platform, which what it carries turns back a little.
    static void StandOnBody(AccuracySettings settings, CaseResult result)
    {
        const float turn = 1;
        using var world = new AccuracyWorld(settings with { Friction = 1 });
        var disc = world.AddDynamic(new Cylinder(5, 1), 50, new RigidPose(new(0, -.5f, 0)), new BodyVelocity(default, new(0, turn, 0)));
        var anchor = world.AddAnchor(new(0, -.5f, 0));
        var axis = new Vector3(0, 1, 0);
        world.Simulation.Solver.Add(anchor, disc, new Hinge { LocalHingeAxisA = axis, LocalHingeAxisB = axis, SpringSettings = settings.Spring });
        world.Simulation.Solver.Add(disc, anchor, new AngularAxisMotor
        {
            LocalAxisA = axis,
            TargetVelocity = turn,
            Settings = new MotorSettings(1e6f, 1e-6f),
        });
        var box = world.AddDynamic(new Box(.5f, .5f, .5f), 1, new RigidPose(new(Away, .25f, 0)), new BodyVelocity(new(0, 0, -turn * Away), new(0, turn, 0)));
        world.Run(20);
        var place = world.Orientation(disc).RotateBack(world.Position(box) - world.Position(disc));
        result.Limit("outwards", Math.Sqrt(place.X * place.X + place.Z * place.Z) - Away, 2e-3, "m")
            .Limit("along", Away * Math.Atan2(-place.Z, place.X), 2e-3, "m")
            .Note("turn", world.AngularVelocity(disc).Y, "rad/s");
    }

    static void Roll(AccuracySettings settings, float turn, CaseResult result)
    {
        const float radius = .5f;
        const float speed = 1;
        using var world = new AccuracyWorld(settings with { Friction = 1 });
        AddDisc(world, turn);
        // What rolls has the surface's velocity where it touches: v + w x (0, -r, 0) = (0, 0, -W x).
        var spin = new Vector3(turn * Away / radius, 0, -speed / radius);
        var ball = world.AddDynamic(new Sphere(radius), 1, new RigidPose(new(Away, radius, 0)), new BodyVelocity(new(speed, 0, 0), spin));
        var rate = 2 * turn / 7.0;
        world.Run(2 * Math.PI / rate);
        var velocity = world.LinearVelocity(ball);
        // A turn from the start's, as it took that long to the step.
        var heading = Math.IEEERemainder(Math.Atan2(-velocity.Z, velocity.X) - rate * world.Time, 2 * Math.PI);
        result.Limit("speed", velocity.Length / speed - 1, .2, "%")
            .Limit("heading", heading, 1e-2, "rad")
            .Limit("place", (world.Position(ball) - new Double3(Away, radius, 0)).Length * rate / speed, 5e-2, "of the circle's radius");
    }
}
