using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>A ball on the inside of a drum of many flat sides: what holds it is across its way, and takes nothing of its speed.</summary>
public class RoundTheDrumTests
{
    const float Radius = 2;

    // An edge of N sides takes what comes towards the next side, the part (2 pi / N)^2 / 2 of the speed: 2 pi^2 / N in a lap. A smooth drum takes nothing, and
    // none gives any.
    [Theory]
    [InlineData(1600, 4, 0), InlineData(1600, 16, 0), InlineData(3200, 4, 0), InlineData(1600, 4, 1), InlineData(3200, 8, 1)]
    public void A_ball_that_goes_round_keeps_its_speed(int sides, int substeps, float friction)
    {
        const float radius = .2f;
        const int laps = 3;
        var settings = new AccuracySettings { Friction = friction, Gravity = default, SubstepCount = substeps };
        using var world = new TestWorld(settings);
        using var drum = AddDrum(world, sides);
        var pose = new RigidPose(new Vector3(Radius - radius, 0, 0));
        // Rolling from the beginning: its surface does not slide.
        var velocity = new BodyVelocity(new Vector3(0, 5, 0), friction > 0 ? new Vector3(0, 0, -5 / radius) : default);
        // Its handle was another's before, and is no index.
        world.Bodies.Remove(world.AddDynamic(new Sphere(radius), 1, pose));
        var ball = world.AddDynamic(new Sphere(radius), 1, pose, velocity);
        var (turned, steps) = (0.0, 0);
        var before = world.Bodies[ball].Pose.Position;
        for (; turned < laps * Math.Tau && steps < 1000; ++steps)
        {
            world.Step();
            var now = world.Bodies[ball].Pose.Position;
            turned += Math.Atan2(before.X * now.Y - before.Y * now.X, before.X * now.X + before.Y * now.Y);
            before = now;
        }
        var share = world.Bodies[ball].Velocity.Linear.Length() / 5;
        Assert.InRange(share, 1 - laps * 2 * Math.PI * Math.PI / sides, 1.001);
        Assert.InRange(before.Length(), Radius - radius - .005, Radius - radius + .005);
    }

    // With gravity: so fast that the wall turns by 6 and 10 degrees in a step.
    [Theory]
    [InlineData(12, 512), InlineData(12, 2048), InlineData(20, 512), InlineData(20, 2048)]
    public void What_loops_the_loop_gains_nothing(float speed, int sides)
    {
        const float radius = .25f;
        using var world = new TestWorld(new AccuracySettings { Friction = 0 });
        using var drum = AddDrum(world, sides);
        var bottom = -(Radius - radius);
        var ball = world.AddDynamic(new Sphere(radius), 1, new RigidPose(new Vector3(0, bottom, 0)), new BodyVelocity(new Vector3(speed, 0, 0)));
        double Energy() => world.Bodies[ball].Velocity.Linear.LengthSquared() / 2 + 9.81 * (world.Bodies[ball].Pose.Position.Y - bottom);
        var first = Energy();
        var greatest = 0.0;
        for (int i = 0; i < 150; ++i)
        {
            world.Step();
            greatest = Math.Max(greatest, Energy());
        }
        Assert.InRange(greatest, .95 * first, 1.01 * first);
        // Edges take up to 4 pi^2 / N of it in each of five laps.
        Assert.InRange(Energy(), Math.Min(.9, Math.Pow(1 - 4 * Math.PI * Math.PI / sides, 5)) * first, 1.01 * first);
    }

    // What slides is pressed on by v^2 / r, which friction has its share of: dv/dt = -mu v^2 / r, so v = v0 / (1 + mu v0 t / r), and a ball turns by
    // 5/2 of what it loses.
    [Theory]
    [InlineData(.02f, 60, 4), InlineData(.02f, 60, 16), InlineData(.1f, 30, 4), InlineData(.1f, 30, 16), InlineData(.3f, 12, 4), InlineData(.3f, 12, 16)]
    public void What_slides_along_the_wall_is_slowed_by_friction_as_it_is_pressed_on(float friction, int steps, int substeps)
    {
        const float radius = .2f;
        const double speed = 5;
        using var world = new TestWorld(new AccuracySettings { Friction = friction, Gravity = default, SubstepCount = substeps });
        using var drum = AddDrum(world, 1600);
        var pose = new RigidPose(new Vector3(Radius - radius, 0, 0));
        var ball = world.AddDynamic(new Sphere(radius), 1, pose, new BodyVelocity(new Vector3(0, (float)speed, 0)));
        for (int i = 0; i < steps; ++i)
            world.Step();
        var wanted = speed / (1 + friction * speed * (steps / 60.0) / (Radius - radius));
        ref var velocity = ref world.Bodies[ball].Velocity;
        Assert.InRange(velocity.Linear.Length(), wanted * .995, wanted * 1.005);
        // What brings it to the wall in the first steps is pressed on less.
        var turned = velocity.Angular.Length() * radius / 2.5;
        Assert.InRange(turned, .93 * (speed - wanted), 1.02 * (speed - wanted));
    }

    static DrumShape AddDrum(TestWorld world, int sides)
    {
        var shape = world.Simulation.Shapes.Add(FacetedCylinder.Create(world.Pool, Radius, halfLength: 1, sides, Math.Tau));
        var handle = world.Statics.Add(new StaticDescription(Vector3.Zero, shape));
        return new(world, handle, shape);
    }

    readonly struct DrumShape(TestWorld world, StaticHandle handle, TypedIndex shape) : IDisposable
    {
        public void Dispose()
        {
            world.Statics.Remove(handle);
            world.Simulation.Shapes.RecursivelyRemoveAndDispose(shape, world.Pool);
        }
    }
}
