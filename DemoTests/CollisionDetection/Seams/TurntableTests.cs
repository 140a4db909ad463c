using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Kinematic tiles that turn as one are one floor, as those are that rest.</summary>
public class TurntableTests(ITestOutputHelper output)
{
    const float Speed = 5, StepLength = 1 / 60f, Friction = .5f;
    // That of the callbacks of the world.
    const float Gravity = 9.81f;
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

    /// <summary>
    /// With friction what lies flat slides, turns and is carried along as it is by one floor that turns; of tiles that go straight to where they are to be:
    /// with the velocity of the table at the beginning of the step they would go outwards.
    /// </summary>
    [Theory]
    [InlineData(SeamMover.Box), InlineData(SeamMover.TurnedBox), InlineData(SeamMover.StandingCylinder), InlineData(SeamMover.Hull)]
    public void Friction_of_a_turntable_of_tiles_is_that_of_one_floor(SeamMover mover)
    {
        foreach (var turn in new[] { .1f, .3f, 2 })
        {
            foreach (var spin in new[] { 0, 5 })
            {
                using var expected = new ClusterWorld(isCluster: true);
                using var actual = new ClusterWorld(isCluster: true);
                var table = AddTiles(expected, 24, 1);
                var tiles = AddTiles(actual, 1, 14);
                var (one, other) = (SeamMovers.Add(expected, mover, 3), SeamMovers.Add(actual, mover, 3));
                expected.Simulation.Bodies[one].Velocity.Angular.Y = actual.Simulation.Bodies[other].Velocity.Angular.Y = spin;
                float velocityError = 0, spinError = 0, turned = 0;
                for (int i = 0; i < 60; ++i)
                {
                    Turn(expected, table, turn, i, takesChord: true);
                    Turn(actual, tiles, turn, i, takesChord: true);
                    expected.Step(validate: false);
                    actual.Step(validate: i % 16 == 0);
                    var (a, b) = (expected.Simulation.Bodies[one].Velocity, actual.Simulation.Bodies[other].Velocity);
                    velocityError = Math.Max(velocityError, (a.Linear - b.Linear).Length());
                    spinError = Math.Max(spinError, Math.Abs(a.Angular.Y - b.Angular.Y));
                    turned += (a.Angular.Y - b.Angular.Y) * StepLength;
                }
                var away = (expected.Simulation.Bodies[one].Pose.Position - actual.Simulation.Bodies[other].Pose.Position).Length();
                output.WriteLine($"{turn} rad/s, spin {spin}: off by {velocityError} m/s, {spinError} rad/s; {away} m, {turned} rad");
                // What friction takes in a step, and a fifth of it from what slides and all but does not turn: of a disc of .3 m, m g mu r of a spin, which has
                // m r^2 / 2. Parts of a patch know when they are slow enough to be held by their own loads, so that the last substeps are not the same.
                var steps = spin == 0 && turn < 1 ? .2f : 1;
                Assert.InRange(velocityError, 0, steps * Friction * Gravity * StepLength);
                Assert.InRange(spinError, 0, steps * Friction * Gravity / .15f * StepLength);
                Assert.InRange(away, 0, .01f);
                Assert.InRange(turned, -.15f, .15f);
            }
        }
    }

    /// <summary>
    /// A table that hardly turns stops a box within v^2 / (2 mu g), less half of what it goes in a substep, as velocities change before positions.
    /// </summary>
    [Theory]
    [InlineData(2), InlineData(3), InlineData(4)]
    public void A_box_slides_as_far_over_turning_tiles_as_friction_says(float speed)
    {
        using var world = new ClusterWorld(isCluster: true);
        var tiles = AddTiles(world, 1, 14);
        var box = world.AddBody(new Box(.5f, .1f, .5f), new RigidPose(new Vector3(0, .05f, 0)), new BodyVelocity(new Vector3(speed, 0, 0)));
        for (int i = 0; i < 75; ++i)
        {
            Turn(world, tiles, .01f, i, takesChord: false);
            world.Step(validate: false);
        }
        var way = world.Simulation.Bodies[box].Pose.Position.X;
        var expected = speed * speed / (2 * Friction * Gravity) - .5f * speed * StepLength / 4;
        // The load is there when the contacts have given way.
        Assert.InRange(way, expected - .01f * expected, expected + .01f * expected);
    }

    /// <summary>One corner on each of four tiles: friction takes mu m g L from the spin, with L six tenths of the way from the middle to a corner.</summary>
    [Fact]
    public void A_box_that_spins_on_turning_tiles_stops_as_friction_says()
    {
        const float turn = .3f, width = .5f, relative = 10;
        using var world = new ClusterWorld(isCluster: true);
        var tiles = AddTiles(world, 1, 14);
        var corner = new Vector3(.03f, 0, -.09f);
        var angular = new Vector3(0, turn, 0);
        var box = world.AddBody(new Box(width, .1f, width), new RigidPose(Center + corner with { Y = .05f }),
            new BodyVelocity(Vector3.Cross(angular, corner), angular + new Vector3(0, relative, 0)));
        var deceleration = .6f * Friction * Gravity * (width / MathF.Sqrt(2)) / (width * width / 6);
        for (int i = 1; i <= 60; ++i)
        {
            Turn(world, tiles, turn, i - 1, takesChord: false);
            world.Step();
            var expected = turn + Math.Max(0, relative - deceleration * i / 60);
            Assert.InRange(world.Simulation.Bodies[box].Velocity.Angular.Y, expected - deceleration / 60, expected + deceleration / 60);
        }
        Assert.InRange(world.Simulation.Bodies[box].Velocity.Angular.Y, turn - 1e-3f, turn + 1e-3f);
    }

    /// <summary>
    /// An arm that turns about its end, which stands on four tiles: its foot is beside them. Friction of the end has a lever of .07 m, that of something that
    /// slid at the foot would have .5 m.
    /// </summary>
    [Fact]
    public void What_is_held_at_its_end_has_friction_where_it_touches()
    {
        const float turn = .3f;
        var spins = new List<float>();
        foreach (var (size, count) in new[] { (24f, 1), (1f, 14) })
        {
            using var world = new ClusterWorld(isCluster: true);
            var simulation = world.Simulation;
            var tiles = AddTiles(world, size, count);
            var corner = Center + new Vector3(.03f, 0, -.09f);
            simulation.BufferPool.Take<CompoundChild>(1, out var children);
            children[0] = new(new Vector3(-.5f, 0, 0), simulation.Shapes.Add(new Box(.1f, .4f, .1f)));
            var compound = new Compound(children);
            world.Own(compound);
            var arm = simulation.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(corner + new Vector3(.5f, .1999f, 0)),
                new BodyVelocity(new Vector3(0, 0, -.5f * 3), new Vector3(0, 3, 0)), new Sphere(.5f).ComputeInertia(1), simulation.Shapes.Add(compound), -1f));
            var anchor = simulation.Bodies.Add(BodyDescription.CreateKinematic(corner + new Vector3(0, 3, 0), simulation.Shapes.Add(new Sphere(.1f)), -1f));
            var spring = new SpringSettings(30, 1);
            simulation.Solver.Add(anchor, arm, new AngularHinge { LocalHingeAxisA = Vector3.UnitY, LocalHingeAxisB = Vector3.UnitY, SpringSettings = spring });
            simulation.Solver.Add(anchor, arm, new PointOnLineServo
            {
                LocalDirection = Vector3.UnitY,
                LocalOffsetB = new Vector3(-.5f, 0, 0),
                ServoSettings = ServoSettings.Default,
                SpringSettings = spring,
            });
            for (int i = 0; i < 30; ++i)
            {
                Turn(world, tiles, turn, i, takesChord: false);
                world.Step(validate: false);
            }
            spins.Add(simulation.Bodies[arm].Velocity.Angular.Y);
        }
        // A moment of mu m g .07 m for .5 s, where I = .4 m .25 + m .25; the other would be seven times that.
        var loss = Friction * Gravity * .0708f / .35f * .5f;
        Assert.All(spins, spin => Assert.InRange(spin, 3 - 1.5f * loss, 3 - .5f * loss));
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
