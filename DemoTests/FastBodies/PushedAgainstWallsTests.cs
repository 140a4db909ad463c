using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>
/// Who is held by a wall, and pushed against it by others again and again within one substep, is not let through when its impacts do not end: a mesh is
/// one wall to all sides, and all impacts with it are those of one pair.
/// </summary>
public class PushedAgainstWallsTests
{
    const float Speed = 300;
    const float Spin = 100;
    const int Count = 8;

    static Vector3 Next(Random random) => new(random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1);

    /// <summary>Eight dumbbells of two balls fly into the corner of a room of 10 m.</summary>
    // Two and one of them left it.
    [Theory]
    [InlineData(RoomWalls.Mesh, 1), InlineData(RoomWalls.Mesh, 9), InlineData(RoomWalls.Boxes, 1), InlineData(RoomWalls.KinematicBoxes, 7)]
    public void Nobody_is_pushed_out_of_a_corner(RoomWalls walls, int seed)
    {
        using var room = new ClosedRoom(walls, 10);
        var random = new Random(seed);
        var (shapes, pool) = (room.Simulation.Shapes, room.Simulation.BufferPool);
        var ball = shapes.Add(new Sphere(.05f));
        pool.Take<CompoundChild>(2, out var children);
        children[0] = new(new RigidPose(new Vector3(-.12f, 0, 0)), ball);
        children[1] = new(new RigidPose(new Vector3(.12f, 0, 0)), ball);
        var dumbbell = shapes.Add(new Compound(children));
        for (int i = 0; i < Count; ++i)
        {
            var velocity = Vector3.Normalize(Vector3.One + Next(random) * .1f) * Speed;
            var turn = Quaternion.Normalize(
                new(random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1, random.NextSingle() * 2 - 1));
            room.Add(BodyDescription.CreateDynamic(
                new RigidPose(new Vector3((i & 1) - .5f, (i >> 1 & 1) - .5f, (i >> 2) - .5f) * 2, turn), new BodyVelocity(velocity, Next(random) * Spin),
                new Cylinder(.05f, .3f).ComputeInertia(1), new CollidableDescription(dumbbell, ContinuousDetection.Continuous()), -1));
        }
        room.Step(30, 1 / 60f);
        Assert.Equal(0, room.OutsideCount);
        pool.Return(ref children);
    }
}
