using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Of what four boxes consist that meet at the origin.</summary>
public enum FourTiles
{
    /// <summary>Statics.</summary>
    Statics,
    /// <summary>Kinematic bodies that rest.</summary>
    Kinematics,
    /// <summary>Two statics and two kinematic bodies that rest.</summary>
    Both,
    /// <summary>Kinematic bodies that move alike.</summary>
    Platform,
    /// <summary>Kinematic bodies that move upwards.</summary>
    Lift,
}

/// <summary>Friction on several things that do not give way is that of one patch on one static.</summary>
public class SharedFrictionTests
{
    const float Gravity = 10, Friction = .5f, Width = .5f;
    // Of what presses on its corners alone.
    static readonly float AngularDeceleration = Friction * Gravity * (Width / MathF.Sqrt(2)) / (Width * Width / 6);

    static Vector3 VelocityOf(FourTiles tiles) => tiles switch
    {
        FourTiles.Platform => new(1.5f, 0, -.7f),
        FourTiles.Lift => new(0, .8f, .3f),
        _ => default,
    };

    static ClusterWorld Create(FourTiles? tiles)
    {
        var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = Friction;
        if (tiles == null)
            world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), world.Simulation.Shapes.Add(new Box(16, 1, 16))));
        for (int i = 0; i < 4 && tiles != null; ++i)
            AddTile(world, tiles.Value, i, Quaternion.Identity);
        return world;
    }

    static void AddTile(ClusterWorld world, FourTiles tiles, int i, Quaternion turn)
    {
        var shape = world.Simulation.Shapes.Add(new Box(8, 1, 8));
        var pose = new RigidPose(Vector3.Transform(new Vector3(i % 2 * 8 - 4, -.5f, i / 2 * 8 - 4), turn), turn);
        if (tiles == FourTiles.Statics || (tiles == FourTiles.Both && i is 0 or 3))
            world.Simulation.Statics.Add(new StaticDescription(pose, shape));
        else
            world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(pose, new BodyVelocity(VelocityOf(tiles)), shape, -1f));
    }

    static BodyHandle AddBox(ClusterWorld world, Vector3 linear, float spin) =>
        world.AddBody(new Box(Width, .1f, Width), new RigidPose(new Vector3(0, .05f, 0)), new BodyVelocity(linear, new Vector3(0, spin, 0)));

    /// <summary>
    /// Each of the four corners has a static of its own, so each constraint has one contact. Friction takes mu m g L from the spin, and the box has m w^2 / 6;
    /// of a face that presses evenly L is .54 of the way from the middle to a corner if it is a square and two thirds if it is a disc, and .6 is taken.
    /// </summary>
    [Theory]
    [InlineData(FourTiles.Statics), InlineData(FourTiles.Kinematics), InlineData(FourTiles.Both), InlineData(FourTiles.Platform), InlineData(FourTiles.Lift)]
    public void A_box_that_spins_on_four_things_stops_as_friction_says(FourTiles tiles)
    {
        using var world = Create(tiles);
        var box = AddBox(world, VelocityOf(tiles), 10);
        var deceleration = .6f * AngularDeceleration;
        for (int i = 1; i <= 60; ++i)
        {
            world.Step();
            var expected = Math.Max(0, 10 - deceleration * i / 60);
            // A step of friction: the load is there when the contacts have given way, and the last of it is held at the corners.
            Assert.InRange(world.Simulation.Bodies[box].Velocity.Angular.Y, expected - deceleration / 60, expected + deceleration / 60);
        }
        Assert.InRange(world.Simulation.Bodies[box].Velocity.Angular.Y, -1e-4f, 1e-4f);
    }

    public static TheoryData<FourTiles, float, float, float> Motions
    {
        get
        {
            var data = new TheoryData<FourTiles, float, float, float>();
            foreach (var tiles in Enum.GetValues<FourTiles>())
            {
                foreach (var (x, z, spin) in new[] { (1, 0, 0), (1, .3f, 8), (.2f, -.5f, -15), (3, 1, 30) })
                    data.Add(tiles, x, z, spin);
            }
            return data;
        }
    }

    [Theory, MemberData(nameof(Motions))]
    public void A_box_that_slides_and_spins_does_as_on_one_static(FourTiles tiles, float x, float z, float spin)
    {
        using var several = Create(tiles);
        using var one = Create(null);
        var frame = VelocityOf(tiles);
        var (actual, expected) = (AddBox(several, new Vector3(x, 0, z) + frame, spin), AddBox(one, new(x, 0, z), spin));
        for (int i = 0; i < 90; ++i)
        {
            several.Step();
            one.Step();
            var (a, b) = (several.Simulation.Bodies[actual], one.Simulation.Bodies[expected]);
            // A fifth of what friction takes in a step: as the box turns, other contacts are chosen at another time.
            Assert.InRange((a.Velocity.Linear - frame - b.Velocity.Linear).Length(), 0, .2f * Friction * Gravity / 60);
            Assert.InRange(Math.Abs(a.Velocity.Angular.Y - b.Velocity.Angular.Y), 0, .2f * AngularDeceleration / 60);
        }
    }

    /// <summary>On a slope below the angle of friction a box stays where it is; above it slides as it would on one static.</summary>
    [Theory]
    [InlineData(FourTiles.Statics, .98f), InlineData(FourTiles.Statics, 1.02f)]
    [InlineData(FourTiles.Kinematics, .98f), InlineData(FourTiles.Kinematics, 1.02f)]
    [InlineData(FourTiles.Both, .98f), InlineData(FourTiles.Both, 1.02f)]
    public void Four_tiles_hold_as_much_as_one(FourTiles tiles, float part)
    {
        var angle = MathF.Atan(part * Friction);
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = Friction;
        var turn = Quaternion.CreateFromAxisAngle(Vector3.Normalize(new Vector3(.6f, 0, .8f)), angle);
        for (int i = 0; i < 4; ++i)
            AddTile(world, tiles, i, turn);
        var start = Vector3.Transform(new Vector3(0, .05f, 0), turn);
        var box = world.AddBody(new Box(Width, .1f, Width), new RigidPose(start, turn));
        for (int i = 0; i < 180; ++i)
            world.Step();
        var acceleration = Gravity * (MathF.Sin(angle) - Friction * MathF.Cos(angle));
        var expected = Math.Max(0, .5f * acceleration * 9);
        Assert.InRange((world.Simulation.Bodies[box].Pose.Position - start).Length(), expected * .95f - 1e-3f, expected * 1.05f + 1e-3f);
    }

    /// <summary>The sign of a coefficient says whose friction it is, so that of zero must not: what a game gives is without one.</summary>
    [Fact]
    public void A_coefficient_of_minus_zero_is_zero()
    {
        Assert.Equal(Run(0), Run(-0f));

        static BodyVelocity[] Run(float friction)
        {
            using var world = new ClusterWorld(isCluster: true);
            world.Behaviour.Friction = friction;
            // Turns, so that its place makes a difference; what leans on it moves on.
            world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(
                new Vector3(1, -.5f, 0), new BodyVelocity(default, new Vector3(.2f, 3, 0)), world.Simulation.Shapes.Add(new Box(4, 1, 4)), -1f));
            var shape = new Box(Width, .2f, Width);
            BodyHandle[] boxes = [.. Enumerable.Range(0, 3).Select(i => world.AddBody(
                shape, new RigidPose(new Vector3(.1f * i, .1f + .2f * i, 0)), new BodyVelocity(new Vector3(i, 0, 0), new Vector3(0, i, 0))))];
            for (int i = 0; i < 40; ++i)
                world.Step();
            return [.. boxes.Select(box => world.Simulation.Bodies[box].Velocity)];
        }
    }
}
