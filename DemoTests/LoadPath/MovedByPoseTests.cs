using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>Kinematic bodies that a game moves by their poses, with no velocity, push out what they are put into, at the default setting.</summary>
/// <remarks>
/// The load path took the speed at which contacts push out for a load and brought it to rest: a wall that was put a step further at 1 m/s lay .47 m deep in
/// the crate before it, one at 2 m/s passed through, and eight boxes on a lift of .2 m/s sank by 24 cm and fell.
/// </remarks>
public class MovedByPoseTests
{
    const float Dt = LoadPathWorld.Dt;

    static BodyHandle AddKinematic(LoadPathWorld world, Vector3 position, Vector3 size) => world.Simulation.Bodies.Add(
        BodyDescription.CreateKinematic(position, world.Simulation.Shapes.Add(new Box(size.X, size.Y, size.Z)), .01f));

    // Overlap is corrected at 2 m/s at most, so what comes slower is never deeper than it gets in a step or two.
    [Theory, InlineData(.1f), InlineData(.5f), InlineData(1), InlineData(1.9f)]
    public void A_wall_pushes_a_crate_along(float speed)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: .5f);
        var wall = AddKinematic(world, new Vector3(-.8f, 1, 0), new Vector3(.5f, 2, 3));
        var crate = world.Add(new Vector3(0, .5f, 0), Vector3.One, 10);
        float deepest = 0;
        for (int i = 0; i < 240; ++i)
        {
            world.Simulation.Bodies[wall].Pose.Position.X += speed * Dt;
            world.Step();
            deepest = MathF.Max(deepest, Of(world, wall).X + .25f - (Of(world, crate).X - .5f));
        }
        Assert.True(world.Simulation.Bodies[wall].Awake);
        Assert.InRange(deepest, 0, 2 * speed * Dt + .002f);
    }

    // Nothing is handed down to such a lift, so a stack stands on it as it does by sweeps.
    [Theory, InlineData(1, .2f), InlineData(3, .2f), InlineData(8, .2f), InlineData(3, 1), InlineData(8, 1)]
    public void What_stands_on_a_lift_sinks_in_no_deeper_than_by_sweeps(int count, float speed) =>
        Assert.InRange(Sunk(LoadPathMode.WhereNeeded, count, speed), 0, 2 * Sunk(LoadPathMode.Off, count, speed) + .001f);

    static float Sunk(LoadPathMode mode, int count, float speed) => LiftedStack.Sunk(mode, count, speed, world =>
    {
        var lift = AddKinematic(world, LiftedStack.Start, new Vector3(4, .5f, 4));
        return way => world.Simulation.Bodies[lift].Pose.Position += way;
    });

    /// <summary>A belt has a velocity and is put back to its place in each step: what stands on it stands as on the ground.</summary>
    [Fact]
    public void A_belt_that_is_put_back_is_a_floor()
    {
        var velocity = new Vector3(2, 0, 0);
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: .5f);
        var belt = AddKinematic(world, new Vector3(0, .75f, 0), new Vector3(60, .5f, 4));
        var boxes = Enumerable.Range(0, 20).Select(i => world.Add(new Vector3(-20, 1.5f + i, 0), Vector3.One, 1)).ToList();
        foreach (var box in boxes)
            world.Simulation.Bodies[box].Velocity.Linear = velocity;
        world.Simulation.Bodies[belt].Velocity.Linear = velocity;
        for (int i = 0; i < 300; ++i)
        {
            world.Simulation.Bodies[belt].Pose.Position = new Vector3(0, .75f, 0);
            world.Step();
        }
        for (int i = 0; i < boxes.Count; ++i)
            Assert.InRange((Of(world, boxes[i]) - new Vector3(-20 + 10, 1.5f + i, 0)).Length(), 0, .002f);
    }

    /// <summary>Poses that are written beside the velocities that lead to them, and differ by rounding, take nothing of what moves by velocity.</summary>
    [Fact]
    public void A_lift_whose_pose_is_written_beside_its_velocity_is_a_floor()
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: .5f);
        var lift = AddKinematic(world, new Vector3(0, .75f, 0), new Vector3(4, .5f, 4));
        var boxes = Enumerable.Range(0, 20).Select(i => world.Add(new Vector3(0, 1.5f + i, 0), Vector3.One, 1)).ToList();
        for (int i = 0; i < 300; ++i)
        {
            ref var motion = ref world.Simulation.Bodies[lift].MotionState;
            motion.Pose.Position = Path(i);
            motion.Velocity.Linear = (Path(i + 1) - Path(i)) / Dt;
            world.Step();
        }
        for (int i = 0; i < boxes.Count; ++i)
            Assert.InRange((Of(world, boxes[i]) - Of(world, lift) - new Vector3(0, .75f + i, 0)).Length(), 0, .002f);
    }

    static Vector3 Path(int step) => new(0, .75f + .5f * step * Dt, 0);

    static Vector3 Of(LoadPathWorld world, BodyHandle body) => world.Simulation.Bodies[body].Pose.Position;
}
