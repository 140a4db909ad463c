using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace DemoTests.Quality;

// Docs/Guides/Events.md and Levels.md.
static partial class DocSamples
{
    public static TypedIndex BuildLevel(Simulation simulation, Mesh terrain, Mesh bridge, Vector3 river)
    {
        using var builder = new CompoundBuilder(simulation.BufferPool, simulation.Shapes, 3);
        builder.AddForKinematic(simulation.Shapes.Add(terrain), RigidPose.Identity, 1);
        builder.AddForKinematic(simulation.Shapes.Add(bridge), new RigidPose(river), 1);
        builder.AddForKinematic(new Box(4, 1, 4), new RigidPose(new Vector3(0, 5, 0)), 1);
        builder.BuildKinematicCompound(out var parts);
        var level = simulation.Shapes.Add(new BigCompound(parts, simulation.Shapes, simulation.BufferPool));
        return level;
    }

    public static byte MaterialOf(Simulation simulation, TypedIndex level, Mesh terrain, int childIndex)
    {
        simulation.Shapes.GetShape<BigCompound>(level.Index).FindPiece(childIndex, out var part, out var triangle);
        var isTerrain = part == 0;
        var material = isTerrain ? terrain.GetMaterial(triangle) : (byte)0;
        return material;
    }

    public static void GiveLayers(Simulation simulation, StaticHandle ground, BodyHandle player, BodyHandle ghost)
    {
        const uint world = 1, players = 2, ghosts = 4;
        simulation.Layers[ground] = new CollisionLayers(world, uint.MaxValue);
        simulation.Layers[player] = new CollisionLayers(players, world | players);
        simulation.Layers[ghost] = new CollisionLayers(ghosts, world);
    }

    public static int Hear(Simulation simulation, BodyHandle player, Action<Vector3, float> PlaySound)
    {
        var standingOn = 0;
        simulation.Events.Listen(player, EventMask.Begin | EventMask.End | EventMask.Hit);
        simulation.Timestep(1 / 60f);
        foreach (ref readonly var hit in simulation.Events.Hits)
            PlaySound(hit.Position, hit.Impulse);
        foreach (ref readonly var contact in simulation.Events.Began)
            standingOn += contact.Normal.Y > 0.7f ? 1 : 0;
        return standingOn;
    }

    public static void MakeZone(Simulation simulation, StaticHandle zone)
    {
        simulation.Events.SetSensor(zone, true);
        simulation.Events.Listen(zone, EventMask.Begin | EventMask.End);
    }

    public static void DrawBetween(
        Simulation simulation, float timeSinceStep, float timeOfStep, BodyHandle[] handles, RigidPose[] poses, Action<BodyHandle, RigidPose> Draw)
    {
        var count = simulation.Bodies.GetInterpolatedPoses(timeSinceStep / timeOfStep, handles, poses);
        for (int i = 0; i < count; ++i)
            Draw(handles[i], poses[i]);
    }
}
