using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>Who is thrown aside within bounds that it has already meets whatever is there, though it is not told anew what that is.</summary>
public class UnwatchedNeighbourTests
{
    const float Radius = .1f;

    static TestWorld CreateWorld()
    {
        var world = new TestWorld(new AccuracySettings { Gravity = default, Friction = 0 }, restitution: 1);
        // Only where there was a fast pair in the last step is it noted who has slow ones. This one flies along a plate, whose bounds it never leaves.
        Vector3 far = new(0, -1000, 0), along = Vector3.Normalize(new(1, 1, 0)), beside = Vector3.Normalize(new(-1, 1, 0));
        world.AddStatic(new Box(400, .1f, 1), new RigidPose(far, Quaternion.CreateFromAxisAngle(Vector3.UnitZ, float.Pi / 4)));
        AddBall(world, far + beside - 50 * along, 300 * along);
        return world;
    }

    static BodyHandle AddBall(TestWorld world, Vector3 position, Vector3 velocity) => world.AddMarked(new Sphere(Radius), 1, position, velocity);

    // A plate that a ball touches at a place with the normal that turns it from one direction into another.
    static void AddMirror(TestWorld world, Vector3 place, Vector3 before, Vector3 after)
    {
        const float half = .05f;
        var normal = Vector3.Normalize(after - before);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, float.Atan2(normal.Y, normal.X));
        world.AddStatic(new Box(2 * half, .8f, .8f), new RigidPose(place - normal * (Radius + half), turn));
    }

    /// <summary>Who is woken by a touch is thrown within the bounds that it slept with, and is stopped by the plate before which it slept.</summary>
    [Fact]
    public void WhoWakesInAStepMeetsWhatItSleptBefore()
    {
        using var world = CreateWorld();
        var body = world.Bodies[AddBall(world, default, new Vector3(60, 0, 0))];
        world.Step();
        // Back to where it came from, and to rest: its bounds are those of the way that it has gone.
        (body.Pose.Position, body.Velocity.Linear) = (default, default);
        const float plate = .5f;
        world.AddStatic(new Box(.02f, 4, 4), new RigidPose(new Vector3(plate, 0, 0)));
        body.Awake = false;
        world.Step();
        Assert.False(body.Awake);
        // As heavy, and without loss: it stays behind.
        AddBall(world, new Vector3(-2 * Radius, 0, 0), new Vector3(50, 0, 0));
        world.Step();
        Assert.True(body.Awake);
        Assert.InRange(body.Pose.Position.X, -plate, plate);
    }

    /// <summary>A box around the way that was foreseen and the next one contains more than both: what is there is met by the way after these.</summary>
    [Fact]
    public void ASecondThrowWithinGrownBoundsMeetsWhatIsThere()
    {
        const float speed = 600;
        using var world = CreateWorld();
        Vector3 first = Vector3.UnitX, second = Vector3.Normalize(new(-.3f, .954f, 0)), third = Vector3.Normalize(new(.55f, .835f, 0));
        // In the first of four substeps, and in the second.
        Vector3 turnsAt = .5f * first, turnsAgainAt = turnsAt + 2.6f * second;
        AddMirror(world, turnsAt, first, second);
        AddMirror(world, turnsAgainAt, second, third);
        const float plate = 2;
        world.AddStatic(new Box(.02f, 3.5f, 4), new RigidPose(new Vector3(plate, 5.75f, 0)));
        world.Step();
        var ball = AddBall(world, default, first * speed);
        world.Step();
        var body = world.Bodies[ball];
        // Of 10 m there are 6.9 left after the second turn, at the end of which it is beyond the plate unless that throws it back.
        var end = turnsAgainAt + 6.9f * third;
        Assert.InRange(body.Pose.Position.Y, end.Y - .1f, end.Y + .1f);
        var mirrored = 2 * (plate - .01f - Radius) - end.X;
        Assert.InRange(body.Pose.Position.X, mirrored - .1f, mirrored + .1f);
        Assert.InRange(body.Velocity.Linear.X, -.56f * speed, -.54f * speed);
    }
}
