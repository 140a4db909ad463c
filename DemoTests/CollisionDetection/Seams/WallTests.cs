using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What slides to a wall that stands on the floor, or beside it, stops there: it does not climb, nor pass, whatever both are made of.</summary>
/// <remarks>
/// A box that meets the wall with a whole face, without friction, has its centre behind the middle of that face: its contacts hold it at once, and it neither
/// turns nor leaves the floor. So says an impact that is exact, and so do sixteen sweeps of the solver. One sweep takes the four corners one after the other,
/// and leaves a turn, by which the floor throws it up: which one, their order and the places of the seams decide.
/// </remarks>
public class WallTests
{
    const float Wall = 2;
    const float Half = .25f;
    // It goes on down to where it lies at rest, less than 5e-4 m below Half: nothing throws it up that should not.
    const float Height = Half - 1e-4f;
    const float Start = -1;

    public static TheoryData<LevelGround, float> Cases
    {
        get
        {
            var data = new TheoryData<LevelGround, float>();
            foreach (var wall in Enum.GetValues<LevelGround>())
            {
                foreach (var speed in (float[])[2, 8])
                    data.Add(wall, speed);
            }
            return data;
        }
    }

    /// <summary>Made at the time at which surfaces meet, the impact leaves nothing of the speed, and the box where the wall is.</summary>
    [Theory, MemberData(nameof(Cases))]
    public void An_exact_impact_stops_it_at_the_wall(LevelGround wall, float speed)
    {
        foreach (var floor in Enum.GetValues<LevelGround>())
        {
            var (highest, farthest) = Slide(floor, wall, speed, Start, isExact: true);
            Assert.InRange(highest, Half - 5e-4f, Half);
            Assert.InRange(farthest, Wall - Half - 1e-5f, Wall - Half + 1e-5f);
        }
    }

    /// <summary>
    /// What comes to the wall as a substep ends, to within rounding, is met by all of its corners: a few of them, which the others follow in the next
    /// substep, would turn it.
    /// </summary>
    // Of each hundred of these, at 2 and at 4 m/s, sixteen were thrown up by one or four centimetres at a mesh, and two at boxes.
    [Theory]
    [InlineData(LevelGround.Mesh, 2, 2007), InlineData(LevelGround.Mesh, 4, 2007)]
    [InlineData(LevelGround.Boxes, 2, 2009), InlineData(LevelGround.Boxes, 4, 2009)]
    public void An_exact_impact_at_the_end_of_a_substep_turns_nothing(LevelGround wall, float speed, int seed)
    {
        for (int i = -25; i < 25; ++i)
        {
            var (highest, farthest) = Slide(LevelGround.One, wall, speed, Start + i * 6e-8f, isExact: true, seed: seed);
            Assert.InRange(highest, Half - 5e-4f, Half);
            Assert.InRange(farthest, Wall - Half - 1e-5f, Wall - Half + 1e-5f);
        }
    }

    /// <summary>With as many sweeps of the solver as it takes it gives way as at one box, and does not rise by more than it sank.</summary>
    [Theory, MemberData(nameof(Cases))]
    public void Sixteen_sweeps_stop_it_as_one_box_does(LevelGround wall, float speed)
    {
        var (_, expected) = Slide(LevelGround.One, LevelGround.One, speed, Start, sweeps: 16);
        foreach (var floor in Enum.GetValues<LevelGround>())
        {
            var (highest, farthest) = Slide(floor, wall, speed, Start, sweeps: 16);
            Assert.InRange(highest, Half - 5e-4f, Half);
            Assert.InRange(farthest, expected - 5e-5f, expected + 5e-5f);
        }
    }

    /// <summary>With one sweep it is thrown up, by no more than by one box and what the order of its corners may add, and stops.</summary>
    [Theory, MemberData(nameof(Cases))]
    public void One_sweep_stops_it(LevelGround wall, float speed)
    {
        var (expectedHighest, expectedFarthest) = Slide(LevelGround.One, LevelGround.One, speed, Start);
        foreach (var floor in Enum.GetValues<LevelGround>())
        {
            var (highest, farthest) = Slide(floor, wall, speed, Start);
            Assert.InRange(farthest, expectedFarthest - 1e-3f, expectedFarthest + 1e-3f);
            Assert.InRange(highest, Half - 5e-4f, expectedHighest + 2e-3f);
        }
    }

    /// <summary>
    /// A wall of which one block is met by an edge, at the foot, and others above it by a corner each, is a wall, and not a lip over which the edge
    /// stumbles.
    /// </summary>
    // By 8.5 mm and 18 cm, and 1.6 and 3.5 mm before the wall.
    [Theory, InlineData(2), InlineData(8)]
    public void A_wall_of_blocks_is_no_lip(float speed)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        var (shapes, statics) = (world.Simulation.Shapes, world.Simulation.Statics);
        statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), shapes.Add(new Box(16, 1, 16))));
        statics.Add(new StaticDescription(new Vector3(Wall + .5f, .1f, 0), shapes.Add(new Box(1, .4f, 4))));
        statics.Add(new StaticDescription(new Vector3(Wall + .5f, 1.3f, 1.05f), shapes.Add(new Box(1, 2, 2))));
        statics.Add(new StaticDescription(new Vector3(Wall + .5f, 1.3f, -.95f), shapes.Add(new Box(1, 2, 2))));
        var (highest, farthest) = Run(world, speed, Start);
        // Where it is thrown up, one sweep does it.
        Assert.InRange(farthest, Wall - Half, Wall - Half + speed / 60 / 4);
        Assert.InRange(highest, Half - 5e-4f, Half + .01f + speed * speed * 2e-4f);
    }

    static (float Highest, float Farthest) Slide(
        LevelGround floor, LevelGround wall, float speed, float start, int sweeps = 1, bool isExact = false, int seed = 2007)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        world.Behaviour.HasExactImpacts = isExact;
        world.Simulation.Solver.VelocityIterationCount = sweeps;
        LevelTests.AddPlane(world, floor, Quaternion.Identity, new(-4, 0, 0), seed - 1);
        LevelTests.AddPlane(world, wall, Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2), new(Wall, 0, 0), seed);
        return Run(world, speed, start);
    }

    static (float Highest, float Farthest) Run(ClusterWorld world, float speed, float start)
    {
        var box = world.AddBody(
            new Box(2 * Half, 2 * Half, 2 * Half), new RigidPose(new Vector3(start, Height, 0)), new BodyVelocity(new Vector3(speed, 0, 0)));
        var (highest, farthest) = (0f, 0f);
        for (int i = 0; i < 120; ++i)
        {
            world.Step(validate: false);
            var position = world.Simulation.Bodies[box].Pose.Position;
            (highest, farthest) = (Math.Max(highest, position.Y), Math.Max(farthest, position.X));
        }
        return (highest, farthest);
    }
}
