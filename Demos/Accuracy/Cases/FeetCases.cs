using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>What stands on feet, or is made of pieces, and slides and turns (C14): how far it comes, and by how much it turns, until it rests.</summary>
static class FeetCases
{
    const float Friction = .5f;
    const float Mass = 2;
    const float Height = .1f;

    // Equal pieces, and where they are.
    sealed record Things(string Name, float Width, float Depth, Kind Kind, Vector2[] Places);

    enum Kind
    {
        Boxes,
        Discs,
        Balls,
    }

    static readonly Things[] all =
    [
        new("a tripod", .16f, .16f, Kind.Discs, [.. Ring(3, .5f)]),
        new("a table", .1f, .1f, Kind.Boxes, [new(.45f, .3f), new(-.45f, .3f), new(.45f, -.3f), new(-.45f, -.3f)]),
        new("three balls", .1f, .1f, Kind.Balls, [.. Ring(3, .4f)]),
        new("two skis", 1, .2f, Kind.Boxes, [new(0, .2f), new(0, -.2f)]),
        new("nine pieces of a slab", 1 / 3f, 1 / 3f, Kind.Boxes,
            [.. from i in Enumerable.Range(-1, 3) from j in Enumerable.Range(-1, 3) select new Vector2(i, j) / 3]),
    ];

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from things in all
           from motion in new (float Speed, float Spin)[] { (0, 20), (.5f, 20), (3, 20), (3, 5) }
           from one in AccuracySuite.AtBothEfforts("C14", FormattableString.Invariant($"{things.Name}, {motion.Speed} m/s and {motion.Spin} rad/s"),
               (settings, result) => Slide(settings, things, tiles: false, motion.Speed, motion.Spin, result))
           select one,
        .. from things in all
           from one in AccuracySuite.AtBothEfforts("C14", $"{things.Name} on four tiles, 0 m/s and 20 rad/s",
               (settings, result) => Slide(settings, things, tiles: true, 0, 20, result))
           select one,
    ];

    static IEnumerable<Vector2> Ring(int count, float radius) =>
        from i in Enumerable.Range(0, count)
        let angle = i * MathF.Tau / count
        select new Vector2(MathF.Cos(angle), MathF.Sin(angle)) * radius;

    static void Slide(AccuracySettings settings, Things things, bool tiles, float speed, float spin, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Friction = Friction });
        if (!tiles)
            world.AddGround();
        for (int i = 0; tiles && i < 4; ++i)
            world.AddStatic(new Box(4, 1, 4), new RigidPose(new Vector3((i & 1) * 4 - 2, -.5f, (i & 2) * 2 - 2)));
        var pose = new RigidPose(new Vector3(0, Height / 2, 0));
        var velocity = new BodyVelocity(new Vector3(speed, 0, 0), new Vector3(0, spin, 0));
        Vector3[] places = [.. things.Places.Select(place => new Vector3(place.X, 0, place.Y))];
        var body = things.Kind switch
        {
            Kind.Discs => world.AddDynamicPieces(new Cylinder(things.Width / 2, Height), Mass, places, pose, velocity),
            Kind.Balls => world.AddDynamicPieces(new Sphere(Height / 2), Mass, places, pose, velocity),
            _ => world.AddDynamicPieces(new Box(things.Width, Height, things.Depth), Mass, places, pose, velocity),
        };
        var squaredGyration = places.Average(place => place.LengthSquared()) + things.Kind switch
        {
            Kind.Discs => things.Width * things.Width / 8,
            Kind.Balls => Height * Height / 10,
            _ => (things.Width * things.Width + things.Depth * things.Depth) / 12,
        };
        var isPoint = things.Kind == Kind.Balls;
        var (distance, angle) = EvenFriction.Feet(isPoint ? 0 : things.Width, isPoint ? 0 : things.Depth, things.Kind == Kind.Discs, things.Places)
            .Rest(-Friction * settings.Gravity.Y, squaredGyration, speed, spin);
        double turned = 0;
        world.Run(4, () => turned += world.AngularVelocity(body).Y * settings.Dt);
        if (speed > 0)
            result.Limit("slid", (world.Position(body) - (Double3)pose.Position).Length / distance - 1, .1, "%");
        else
            result.Limit("slid of itself", (world.Position(body) - (Double3)pose.Position).Length, .02, "m");
        result.Limit("turned", turned / angle - 1, .15, "%");
        var shape = world.Bodies[body].Collidable.Shape;
        world.Bodies.Remove(body);
        world.Simulation.Shapes.RecursivelyRemoveAndDispose(shape, world.Simulation.BufferPool);
    }
}
