using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.JointTables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>A solid sphere swings in a trough of many flat sides (C7): its period, and its energy.</summary>
/// <remarks>
/// In a round trough nothing is lost. In one of N sides each edge is an impact, which takes the part sin(pi / N)^2 of what energy of motion crosses it, less
/// while it rolls: of 1,024 sides some hundredths in half a minute, of 64 a third. Nothing adds any.
/// </remarks>
static class TroughCases
{
    const double Gravity = 9.81f;
    const float Radius = .5f;
    const float TroughRadius = 5;
    // Of the line through the sphere, from the lowest point.
    const double Start = .3;

    public static IEnumerable<AccuracyCase> All { get; } = new[] { (64, 0f), (64, 1f), (1024, 0f), (1024, 1f) }.SelectMany(kind =>
        AccuracySuite.AtBothEfforts("C7", FormattableString.Invariant($"sphere in a trough of {kind.Item1} sides, mu {kind.Item2}"),
            (settings, result) => Run(settings, kind.Item1, kind.Item2, result)));

    static void Run(AccuracySettings settings, int sideCount, float friction, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Friction = friction });
        var pool = world.Simulation.BufferPool;
        var trough = FacetedCylinder.Create(pool, TroughRadius, halfLength: 2, sideCount, Math.PI);
        world.Simulation.Statics.Add(new StaticDescription(Vector3.Zero, world.Simulation.Shapes.Add(trough)));
        var arm = TroughRadius - Radius;
        var body = world.AddDynamic(new Sphere(Radius), 1, new RigidPose(new((float)(arm * Math.Sin(Start)), (float)(-arm * Math.Cos(Start)), 0)));
        var clock = new SwingClock();
        double inertia = .4 * Radius * Radius;
        double Energy() => world.Energy(body, 1, new Double3(inertia, inertia, inertia)) + Gravity * arm;
        world.Step(settings.Dt);
        double first = Energy();
        world.Run(30, () => clock.Observe(world.Time, world.Position(body).X));
        // Rolling, it has seven fifths of its mass along the way; large swings are slower by the square of their angle over sixteen.
        double mass = friction > 0 ? 1.4 : 1;
        double expected = 2 * Math.PI * Math.Sqrt(mass * arm / Gravity) * (1 + Start * Start / 16);
        double gained = Energy() / first - 1;
        result.Limit("period", clock.Mean(4) / expected - 1, .01, "%").Limit("energy", sideCount < 1024 ? Math.Max(0, gained) : gained, .05, "%");
        trough.Dispose(pool);
    }
}
