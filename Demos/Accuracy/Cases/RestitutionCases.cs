using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>Bounces (C3): the height of the first rebound is e^2 of the drop, and a tumbling box never gains energy.</summary>
static class RestitutionCases
{
    const double Gravity = 9.81f;
    const double DropHeight = 2;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. new[] { "sphere", "capsule", "box" }.SelectMany(shape => new[] { 0, .5f, 1 }.SelectMany(restitution =>
            AccuracySuite.AtBothEfforts("C3", FormattableString.Invariant($"{shape}, e = {restitution}"),
                (settings, result) => RunRebound(settings, shape, restitution, result)))),
        .. new[] { 0, .5f }.SelectMany(friction => AccuracySuite.AtBothEfforts("C3", FormattableString.Invariant($"tumbling box, e = 1, mu {friction}"),
            (settings, result) => RunTumbling(settings, friction, result))),
    ];

    static void RunRebound(AccuracySettings settings, string shape, float restitution, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Restitution = restitution });
        world.AddGround();
        const float lowest = .25f;
        var start = new Vector3(0, (float)DropHeight + lowest, 0);
        var lying = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        var body = shape switch
        {
            "sphere" => world.AddDynamic(new Sphere(lowest), 1, new RigidPose(start)),
            // Lying: two contacts share the blow.
            "capsule" => world.AddDynamic(new Capsule(lowest, 1), 1, new RigidPose(start, lying)),
            "box" => world.AddDynamic(new Box(1, 2 * lowest, .8f), 1, new RigidPose(start)),
            _ => throw new ArgumentOutOfRangeException(nameof(shape), shape, null),
        };
        double impactSpeed = Math.Sqrt(2 * Gravity * DropHeight);
        double fallTime = Math.Sqrt(2 * DropHeight / Gravity);
        double peak = 0;
        bool landed = false;
        world.Run(FallingOracle.ReboundPeakTime(Gravity, DropHeight, restitution) + .3, () =>
        {
            landed |= world.Time > fallTime / 2 && world.LinearVelocity(body).Y > -.1 * impactSpeed;
            if (landed)
                peak = Tally.Most(peak, world.Position(body).Y - lowest);
        });
        // What has not come down has no rebound: not-a-number is a failure.
        double error = landed ? (peak - FallingOracle.ReboundHeight(DropHeight, restitution)) / DropHeight : double.NaN;
        result.Limit("rebound error", error, .05).Note("kept", peak / DropHeight, "%");
    }

    static void RunTumbling(AccuracySettings settings, float friction, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Restitution = 1, Friction = friction });
        world.AddGround(extent: 1000);
        var body = world.AddDynamic(
            new Box(1, .6f, .4f), 1, new RigidPose(new Vector3(0, 3, 0), Quaternion.CreateFromYawPitchRoll(.3f, .5f, .7f)),
            new BodyVelocity(new Vector3(1, 0, .5f), new Vector3(2, 3, 1)));
        var inertia = TorqueFreeBody.BoxInertia(1, 1, .6, .4);
        double start = world.Energy(body, 1, inertia), most = start;
        world.Run(20, () => most = Tally.Most(most, world.Energy(body, 1, inertia)));
        result.Limit("energy gained", most / start - 1, .05, "%").Note("energy left", world.Energy(body, 1, inertia) / start, "%");
    }
}
