using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;

namespace DemoTests.LoadPath;

/// <summary>Unit boxes on a lift that a game moves by its pose.</summary>
static class LiftedStack
{
    /// <summary>Where the middle of a lift is that is .5 m thick: boxes begin on it.</summary>
    public static readonly Vector3 Start = new(0, .75f, 0);

    /// <summary>Adds boxes that stand on one another on the lift.</summary>
    public static BodyHandle[] Add(LoadPathWorld world, int count) =>
        [.. Enumerable.Range(0, count).Select(i => world.Add(new Vector3(0, 1.5f + i, 0), Vector3.One, 1))];

    /// <summary>The most by which a box gets nearer to the lift than it was while that goes up for three seconds, m.</summary>
    /// <param name="mode">The load path.</param>
    /// <param name="count">Number of boxes.</param>
    /// <param name="speed">How fast the lift goes up, m/s.</param>
    /// <param name="addLift">Adds the lift, and gives what moves it.</param>
    public static float Sunk(LoadPathMode mode, int count, float speed, Func<LoadPathWorld, Action<Vector3>> addLift)
    {
        using var world = new LoadPathWorld(mode, friction: .5f);
        var move = addLift(world);
        var boxes = Add(world, count);
        var (lift, deepest) = (Start.Y, 0f);
        for (int i = 0; i < 180; ++i)
        {
            move(new Vector3(0, speed * LoadPathWorld.Dt, 0));
            lift += speed * LoadPathWorld.Dt;
            world.Step();
            for (int box = 0; box < count; ++box)
                deepest = MathF.Max(deepest, .75f + box - (world.Simulation.Bodies[boxes[box]].Pose.Position.Y - lift));
        }
        return deepest;
    }
}
