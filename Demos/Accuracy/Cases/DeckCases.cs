using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>What stands on a deck that rolls, and what is held by the wall of a drum that turns (C12): it stays where it is on it.</summary>
/// <remarks>
/// On a deck at an angle of a sin(W t) friction has to bear g sin and W^2 a r, in parts of the load that is left, which the cases keep below three quarters of
/// what it can. In a drum the wall presses with m W^2 r, and friction bears the weight: it does so where mu W^2 r is above g.
/// </remarks>
static class DeckCases
{
    const double Seconds = 25;

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from roll in new (float Rate, float Angle, float Away)[] { (.5f, .3f, 2), (.25f, .2f, 4), (2, .3f, 2) }
           from one in AccuracySuite.AtBothEfforts("C12",
               FormattableString.Invariant($"box {roll.Away} m from the middle of a deck that rolls by {roll.Angle} rad at {roll.Rate} rad/s"),
               (settings, result) => Stand(settings, roll.Rate, roll.Angle, roll.Away, result))
           select one,
        .. from turn in new[] { 3f, 4f }
           from one in AccuracySuite.AtBothEfforts("C12", FormattableString.Invariant($"box on the wall of a drum of {turn} rad/s"),
               (settings, result) => Hold(settings, turn, result))
           select one,
    ];

    static void Stand(AccuracySettings settings, float rate, float greatest, float away, CaseResult result)
    {
        using var world = new AccuracyWorld(settings with { Friction = .8f });
        var deck = world.AddKinematic(new Box(12, .5f, 12), new RigidPose(new(0, -.25f, 0)));
        var box = world.AddDynamic(new Box(.5f, .5f, .5f), 1, new RigidPose(new(away, .25f, 0)));
        double AngleAfter(int steps) => greatest * Math.Sin(rate * steps * (double)settings.Dt);
        void Roll(int steps) => world.Bodies[deck].Velocity.Angular = new(0, 0, (float)((AngleAfter(steps + 1) - AngleAfter(steps)) / settings.Dt));
        Double3 OnDeck() => world.Orientation(deck).RotateBack(world.Position(box) - world.Position(deck));
        int count = 0;
        Roll(0);
        var start = OnDeck();
        world.Run(Seconds, () => Roll(++count));
        var moved = OnDeck() - start;
        result.Limit("outwards", moved.X, .003, "m").Limit("along", moved.Z, .002, "m");
    }

    static void Hold(AccuracySettings settings, float turn, CaseResult result)
    {
        const float inner = 2.9f, size = .25f, thickness = .2f;
        using var world = new AccuracyWorld(settings with { Friction = .8f });
        // Two walls across from each other, which turn about the middle between them.
        var wall = new Box(thickness, 9, .9f);
        var simulation = world.Simulation;
        using var builder = new CompoundBuilder(simulation.BufferPool, simulation.Shapes, 2);
        foreach (var side in new[] { -1, 1 })
            builder.AddForKinematic(wall, new RigidPose(new Vector3(side * (inner + thickness / 2), 0, 0)), 1);
        builder.BuildKinematicCompound(out var children);
        var shape = simulation.Shapes.Add(new Compound(children));
        var spin = new Vector3(0, turn, 0);
        var drum = world.Bodies.Add(BodyDescription.CreateKinematic(
            new RigidPose(default(Vector3)), new BodyVelocity(default, spin), new CollidableDescription(shape), new BodyActivityDescription(-1)));
        var rider = new Vector3(inner - size / 2, 0, 0);
        var box = world.AddDynamic(new Box(size, size, size), 1, new RigidPose(rider), new BodyVelocity(Vector3.Cross(spin, rider), spin));
        world.Run(1);
        var start = world.Position(box).Y;
        world.Run(3);
        result.Limit("slipped down", start - world.Position(box).Y, .02, "m");
        world.Bodies.Remove(drum);
        simulation.Shapes.RecursivelyRemoveAndDispose(shape, simulation.BufferPool);
    }
}
