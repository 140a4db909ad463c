using System;
using System.Collections.Concurrent;
using System.Numerics;
using DemoTests.CollisionDetection.Children;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>How movers go over a floor without seams: worked out once for all floors that are compared with it.</summary>
/// <param name="addFloor">Adds that floor, whose top is at y = 0.</param>
sealed class SeamlessWays(Action<ClusterWorld> addFloor)
{
    readonly ConcurrentDictionary<(SeamMover Mover, float Friction, float Speed), (Vector3 Position, Vector3 Velocity)[]> ways = [];

    /// <summary>Two seconds of a way, or twenty metres.</summary>
    public static int StepCountOf(float speed) => (int)(Math.Min(20 / speed, 2) * 60);

    /// <summary>Where a mover is after each step, and how fast.</summary>
    public (Vector3 Position, Vector3 Velocity)[] Of(SeamMover mover, float friction, float speed) => ways.GetOrAdd((mover, friction, speed), Go);

    (Vector3 Position, Vector3 Velocity)[] Go((SeamMover Mover, float Friction, float Speed) way)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = way.Friction;
        addFloor(world);
        var body = world.Simulation.Bodies[SeamMovers.Add(world, way.Mover, way.Speed)];
        var places = new (Vector3, Vector3)[StepCountOf(way.Speed)];
        for (int i = 0; i < places.Length; ++i)
        {
            world.Step(validate: false);
            places[i] = (body.Pose.Position, body.Velocity.Linear);
        }
        return places;
    }
}
