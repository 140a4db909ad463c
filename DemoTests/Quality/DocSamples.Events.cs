using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.CollisionDetection;

namespace DemoTests.Quality;

// Docs/Guides/Events.md.
static partial class DocSamples
{
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
