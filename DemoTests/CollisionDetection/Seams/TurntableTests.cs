using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Kinematic tiles that turn as one are one floor, as those are that rest.</summary>
public class TurntableTests(ITestOutputHelper output)
{
    const float Speed = 5, StepLength = 1 / 60f;
    static readonly Vector3 Center = new(3, 0, 0);

    /// <summary>
    /// Without friction what moves over a turntable moves straight on. Whether a game gives tiles the velocity of the table at their centre, or the one
    /// that takes them to where they are to be, they fit each other.
    /// </summary>
    [Theory]
    [InlineData(SeamMover.SmallSphere), InlineData(SeamMover.Sphere), InlineData(SeamMover.RollingCapsule), InlineData(SeamMover.Box)]
    [InlineData(SeamMover.TurnedBox), InlineData(SeamMover.StandingCylinder), InlineData(SeamMover.RollingCylinder), InlineData(SeamMover.Hull)]
    [InlineData(SeamMover.Compound)]
    public void The_seams_of_a_turntable_of_tiles_are_not_felt(SeamMover mover)
    {
        foreach (var turn in new[] { .3f, 2 })
        {
            foreach (var takesChord in new[] { false, true })
            {
                using var expected = new ClusterWorld(isCluster: true);
                using var actual = new ClusterWorld(isCluster: true);
                expected.Behaviour.Friction = actual.Behaviour.Friction = 0;
                var table = AddTiles(expected, 24, 1);
                var tiles = AddTiles(actual, 1, 14);
                var (one, other) = (SeamMovers.Add(expected, mover, Speed), SeamMovers.Add(actual, mover, Speed));
                float velocityError = 0, heightError = 0, upward = 0;
                for (int i = 0; i < 60; ++i)
                {
                    Turn(expected, table, turn, i, takesChord);
                    Turn(actual, tiles, turn, i, takesChord);
                    expected.Step(validate: false);
                    actual.Step(validate: i % 16 == 0);
                    var (a, b) = (expected.Simulation.Bodies[one], actual.Simulation.Bodies[other]);
                    var difference = a.Velocity.Linear - b.Velocity.Linear;
                    velocityError = Math.Max(velocityError, (difference with { Y = 0 }).Length());
                    heightError = Math.Max(heightError, Math.Abs(a.Pose.Position.Y - b.Pose.Position.Y));
                    upward = Math.Max(upward, b.Velocity.Linear.Y - Math.Max(0, a.Velocity.Linear.Y));
                }
                output.WriteLine($"{turn} rad/s, chord {takesChord}: off by {velocityError} m/s, height {heightError}, up {upward}");
                Assert.InRange(velocityError, 0, 1e-3f * Speed);
                Assert.InRange(heightError, 0, 2e-4f);
                Assert.InRange(upward, 0, 5e-3f);
            }
        }
    }

    /// <summary>Tiles that turn each about its own middle do not move as one: an edge that comes round is a wall.</summary>
    [Fact]
    public void Tiles_that_turn_alone_are_walls()
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        var shapes = world.Simulation.Shapes;
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), shapes.Add(new Box(20, 1, 20))));
        var turning = new BodyVelocity(default, new Vector3(0, 2, 0));
        // Above the floor by less than the tolerance of the cube.
        world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(new Vector3(0, -.4998f, 0)), turning, shapes.Add(new Box(4, 1, 1)), -1f));
        var cube = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(1.4f, .2499f, -.9f)));
        var fastest = 0f;
        for (int i = 0; i < 30; ++i)
        {
            world.Step();
            fastest = Math.Max(fastest, world.Simulation.Bodies[cube].Velocity.Linear.Length());
        }
        Assert.InRange(fastest, 1, 6);
    }

    // Tiles of a table that turns about Y, and where they are when it has not turned yet.
    static List<(BodyHandle Tile, Vector3 Place)> AddTiles(ClusterWorld world, float size, int count)
    {
        var tiles = new List<(BodyHandle, Vector3)>();
        var shape = world.Simulation.Shapes.Add(new Box(size, 1, size));
        for (int i = 0; i < count * count; ++i)
        {
            var place = new Vector3((i % count + .5f - .5f * count) * size + .03f, -.5f, (i / count + .5f - .5f * count) * size - .09f);
            tiles.Add((world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(Center + place, shape, -1f)), place));
        }
        return tiles;
    }

    static void Turn(ClusterWorld world, List<(BodyHandle Tile, Vector3 Place)> tiles, float turn, int step, bool takesChord)
    {
        var now = Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn * step * StepLength);
        var next = Quaternion.CreateFromAxisAngle(Vector3.UnitY, turn * (step + 1) * StepLength);
        foreach (var (tile, place) in tiles)
        {
            var body = world.Simulation.Bodies[tile];
            var (from, to) = (Vector3.Transform(place, now), Vector3.Transform(place, next));
            var angular = new Vector3(0, turn, 0);
            body.Pose = new(Center + from, now);
            body.Velocity = new(takesChord ? (to - from) / StepLength : Vector3.Cross(angular, from), angular);
            body.UpdateBounds();
        }
    }
}
