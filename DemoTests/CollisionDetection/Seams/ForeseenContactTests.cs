using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Contacts that are foreseen stop what will hit them, in the direction in which it will, and nothing else.</summary>
public class ForeseenContactTests(ITestOutputHelper output)
{
    // Fifths of a step by which what comes is farther away: it hits at any time within a step.
    static readonly float[] Phases = [0, .2f, .4f, .6f, .8f];

    // A floor at y = 0 up to x = 1, and one that is higher from there.
    static void AddLip(ClusterWorld world, bool isMesh, float lip)
    {
        var (shapes, statics) = (world.Simulation.Shapes, world.Simulation.Statics);
        if (!isMesh)
        {
            var box = shapes.Add(new Box(10, 1, 10));
            statics.Add(new StaticDescription(new Vector3(-4, -.5f, 0), box));
            statics.Add(new StaticDescription(new Vector3(6, lip - .5f, 0), box));
            return;
        }
        Vector3[] corners =
        [
            new(-9, 0, -5), new(1, 0, -5), new(-9, 0, 5), new(1, 0, 5), new(1, lip, -5), new(11, lip, -5), new(1, lip, 5), new(11, lip, 5)
        ];
        int[] indices = [0, 1, 2, 1, 3, 2, 1, 4, 3, 4, 6, 3, 4, 5, 6, 5, 7, 6];
        var mesh = new Mesh(corners, indices, Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        statics.Add(new StaticDescription(Vector3.Zero, shapes.Add(mesh)));
    }

    static (float Slowest, float Upward, float Sunk) RollOverLip(
        bool isMesh, SeamMover mover, float radius, float speed, float lip, float friction, float phase)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = friction;
        AddLip(world, isMesh, lip);
        var body = SeamMovers.Add(world, mover, speed);
        world.Simulation.Bodies[body].Pose.Position.X = 1 - radius - (3 + phase) * speed / 60;
        var (slowest, upward, lowest) = (speed, 0f, radius);
        for (int i = 0; i < Math.Min(40, 8 + 24 / speed); ++i)
        {
            world.Step(validate: false);
            lowest = Math.Min(lowest, world.Simulation.Bodies[body].Pose.Position.Y);
            var velocity = world.Simulation.Bodies[body].Velocity.Linear;
            (slowest, upward) = (Math.Min(slowest, velocity.X), Math.Max(upward, velocity.Y));
        }
        return (slowest, upward, radius - lowest);
    }

    public static TheoryData<bool, SeamMover, float, float> Rollers
    {
        get
        {
            var data = new TheoryData<bool, SeamMover, float, float>();
            foreach (var isMesh in new[] { false, true })
            {
                foreach (var friction in new[] { 0, .5f })
                {
                    data.Add(isMesh, SeamMover.SmallSphere, .1f, friction);
                    data.Add(isMesh, SeamMover.Sphere, .5f, friction);
                    data.Add(isMesh, SeamMover.RollingCapsule, .2f, friction);
                    data.Add(isMesh, SeamMover.RollingCylinder, .3f, friction);
                }
            }
            return data;
        }
    }

    // Parts of the speed that are left along the floor and upwards.
    static (float Forward, float Up) LeftOf(SeamMover mover, float height, float friction)
    {
        // Square of the radius of gyration, over that of the radius.
        var inertia = mover is SeamMover.SmallSphere or SeamMover.Sphere ? .4f : mover == SeamMover.RollingCylinder ? .5f : .47f;
        var cosine = 1 - height;
        var left = friction == 0 ? cosine : (inertia + cosine) / (inertia + 1);
        return (left * cosine, left * MathF.Sqrt(1 - cosine * cosine));
    }

    /// <summary>
    /// A round body of radius r meets a step of height h along a normal whose cosine is 1 - h/r. Of its speed v that along the normal is lost, and where it is
    /// rough, angular momentum about the edge is kept. Whether it is slow and climbs, or fast and flies, it goes on with what is left.
    /// </summary>
    [Theory, MemberData(nameof(Rollers))]
    public void What_rolls_loses_at_a_lip_what_a_rigid_body_does(bool isMesh, SeamMover mover, float radius, float friction)
    {
        foreach (var speed in new[] { 1f, 5, 20 })
        {
            // Down to what is more than a thousandth of the radius: less is no lip.
            foreach (var lip in new[] { 1.2e-3f * radius, .01f, .001f, .005f })
            {
                var (forward, up) = LeftOf(mover, lip / radius, friction);
                var (loss, rise) = (0f, 0f);
                foreach (var phase in Phases)
                {
                    var (slowest, upward, sunk) = RollOverLip(isMesh, mover, radius, speed, lip, friction, phase);
                    // What has sunk into the floor meets more of the lip, and climbs on the energy that is left.
                    var (least, most) = LeftOf(mover, (lip + sunk) / radius, friction);
                    least = MathF.Sqrt(MathF.Max(0, least * least - 2 * 10 * (lip + sunk) / (speed * speed)));
                    var text = $"{speed} m/s, {lip} m, {phase}: slowest {slowest / speed} of {forward}, {least}, up {upward / speed} of {up}, {most}";
                    Assert.True(slowest / speed > least - .25f * (1 - least) - 2e-3f, text);
                    Assert.True(upward / speed < 1.1f * most + 2e-3f, text);
                    (loss, rise) = (loss + 1 - slowest / speed, rise + upward / speed);
                }
                output.WriteLine($"{speed} m/s, {lip} m: lost {loss / Phases.Length} of {1 - forward}, up {rise / Phases.Length} of {up}");
                // A real lip is hit. Within the step of the hit a substep may end it early.
                if (lip < 1e-3f || speed == 1)
                    continue;
                // Of one pair, what is within four degrees is one patch with one normal: that of the floor keeps the speed, and lifts.
                var leastLoss = isMesh && 1 - lip / radius > PatchSet.SameNormal ? 0 : .4f * (1 - forward);
                Assert.InRange(loss / Phases.Length, leastLoss, 1.2f * (1 - forward) + 1e-3f);
                Assert.InRange(rise / Phases.Length, .5f * up, 1.1f * up);
            }
        }
    }

    /// <summary>What comes down on the floor within the step in which it gets to a lip does not meet that lower than the floor lets it.</summary>
    [Theory, InlineData(.001f), InlineData(.005f)]
    public void What_comes_down_before_a_lip_meets_it_from_the_floor(float lip)
    {
        const float Radius = .1f, Speed = 5;
        foreach (var phase in Phases)
        {
            using var world = new ClusterWorld(isCluster: true);
            world.Behaviour.Friction = 0;
            AddLip(world, isMesh: false, lip);
            // It is over the edge of the lip after a step; on the floor after half of that, or sooner.
            var place = new Vector3(1 - MathF.Sqrt(2 * Radius * lip) - (.9f + .1f * phase) * Speed / 60, Radius + (.1f + .4f * phase) * 2 / 60, 0);
            var ball = world.AddBody(new Sphere(Radius), new RigidPose(place), new BodyVelocity(new Vector3(Speed, -2, 0)));
            for (int i = 0; i < 3; ++i)
                world.Step(validate: false);
            var left = world.Simulation.Bodies[ball].Velocity.Linear.X / Speed;
            var (least, _) = LeftOf(SeamMover.SmallSphere, lip / Radius, 0);
            output.WriteLine($"{lip} m, {phase}: {left} of {least}");
            Assert.InRange(left, least - .25f * (1 - least) - 2e-3f, 1);
        }
    }

    /// <summary>What goes past a post on the floor by a millimetre goes straight on; what is a millimetre nearer does not.</summary>
    [Theory]
    [InlineData(SeamMover.SmallSphere, .1f), InlineData(SeamMover.RollingCylinder, .2f), InlineData(SeamMover.RollingCapsule, .6f)]
    [InlineData(SeamMover.Box, .25f), InlineData(SeamMover.StandingCylinder, .3f)]
    public void What_passes_a_post_goes_straight_on(SeamMover mover, float half)
    {
        foreach (var speed in new[] { 5f, 20 })
        {
            foreach (var phase in Phases)
            {
                var (aside, slowest) = PassPost(mover, half, speed, phase, .001f);
                var text = $"{speed} m/s, {phase}: aside {aside}, slowest {slowest}";
                Assert.True(aside < 1e-4f * speed && slowest > .9999f * speed, text);
            }
            var (hit, slow) = PassPost(mover, half, speed, 0, -.03f);
            Assert.True(hit > .02f * speed || slow < .98f * speed, $"{speed} m/s: hit {hit}, slow {slow}");
        }
    }

    /// <summary>So does what would be across the nearest corner of a post, to a thousandth of its way, just when the step is over.</summary>
    // It kept the plane that it had far ahead: of a thousand phases 18, 6 and 3 hit it, and lost up to a quarter, a twentieth and three quarters of the speed.
    [Theory]
    [InlineData(SeamMover.RollingCapsule, .6f, 20, .063f), InlineData(SeamMover.RollingCapsule, .6f, 20, .067f)]
    [InlineData(SeamMover.RollingCapsule, .6f, 5, .642f), InlineData(SeamMover.RollingCapsule, .6f, 5, .994f)]
    [InlineData(SeamMover.RollingCylinder, .2f, 20, .727f)]
    public void What_is_beside_a_post_at_the_end_of_the_step_goes_straight_on(SeamMover mover, float half, float speed, float phase)
    {
        var (aside, slowest) = PassPost(mover, half, speed, phase, .001f);
        Assert.True(aside < 1e-4f * speed && slowest > .9999f * speed, $"aside {aside}, slowest {slowest}");
    }

    static (float Aside, float Slowest) PassPost(SeamMover mover, float half, float speed, float phase, float gap)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = 0;
        var (shapes, statics) = (world.Simulation.Shapes, world.Simulation.Statics);
        statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), shapes.Add(new Box(20, 1, 20))));
        statics.Add(new StaticDescription(new Vector3(1.1f, 1, half + gap + .1f), shapes.Add(new Box(.2f, 2, .2f))));
        var body = SeamMovers.Add(world, mover, speed);
        world.Simulation.Bodies[body].Pose.Position.X = .7f - (3 + phase) * speed / 60;
        var (aside, slowest) = (0f, speed);
        for (int i = 0; i < 8 + 90 / speed; ++i)
        {
            world.Step(validate: false);
            var velocity = world.Simulation.Bodies[body].Velocity.Linear;
            (aside, slowest) = (Math.Max(aside, Math.Abs(velocity.Z)), Math.Min(slowest, velocity.X));
        }
        return (aside, slowest);
    }

    /// <summary>A thin plate that stands on the floor is not passed at any speed that a margin covers.</summary>
    [Theory, InlineData(5f), InlineData(20f), InlineData(60f)]
    public void A_plate_on_a_floor_holds(float speed)
    {
        SeamMover[] movers =
            [SeamMover.SmallSphere, SeamMover.RollingCapsule, SeamMover.Box, SeamMover.RollingCylinder, SeamMover.Hull, SeamMover.Compound];
        foreach (var mover in movers)
        {
            foreach (var height in new[] { .15f, 1 })
            {
                foreach (var phase in Phases)
                {
                    // What is round climbs over a plate that is lower than its centre.
                    if (height < 1 && mover != SeamMover.SmallSphere)
                        continue;
                    using var world = new ClusterWorld(isCluster: true);
                    // With friction what rolls goes up a wall with 2/7 of its speed, and is above a low one within the step.
                    if (height < 1)
                        world.Behaviour.Friction = 0;
                    var (shapes, statics) = (world.Simulation.Shapes, world.Simulation.Statics);
                    statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), shapes.Add(new Box(20, 1, 20))));
                    statics.Add(new StaticDescription(new Vector3(1.005f, height / 2, 0), shapes.Add(new Box(.01f, height, 10))));
                    var body = SeamMovers.Add(world, mover, speed);
                    world.Simulation.Bodies[body].Pose.Position.X = .2f - (1 + phase) * speed / 60;
                    for (int i = 0; i < 12; ++i)
                    {
                        world.Step(validate: false);
                        Assert.True(world.Simulation.Bodies[body].Pose.Position.X < 1, $"{mover} {speed} {height} {phase} step {i}");
                    }
                }
            }
        }
    }
}
