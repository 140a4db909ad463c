using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What rolls and slides over the seams of a flat floor moves as on one that has none.</summary>
public class SeamMotionTests(ITestOutputHelper output)
{
    // m/s.
    const float GreatestUpward = 5e-3f;

    public enum Mover
    {
        SmallSphere,
        Sphere,
        LargeSphere,
        RollingCapsule,
        SlidingCapsule,
        Box,
        TurnedBox,
        StandingCylinder,
        RollingCylinder,
        Hull,
        TwoBoxes,
    }

    static readonly Vector3[] HullPoints = [.. Enumerable.Range(0, 16).Select(i =>
    {
        var (sin, cos) = MathF.SinCos(MathF.PI * 2 * (i % 8) / 8);
        return i < 8 ? new Vector3(.3f * cos, -.2f, .3f * sin) : new Vector3(.2f * cos, .2f, .2f * sin);
    })];

    static BodyHandle AddMover(ClusterWorld world, Mover mover, float speed)
    {
        var velocity = new BodyVelocity(new Vector3(speed, 0, 0));
        var across = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2);
        var along = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 2);
        // A tenth of a millimetre in the floor, as what rests there is.
        RigidPose At(float height, Quaternion orientation) => new(new Vector3(0, height - 1e-4f, 0), orientation);
        switch (mover)
        {
            case Mover.SmallSphere or Mover.Sphere or Mover.LargeSphere:
                var radius = mover == Mover.SmallSphere ? .1f : mover == Mover.Sphere ? .5f : 2;
                return world.AddBody(new Sphere(radius), At(radius, Quaternion.Identity), velocity with { Angular = new(0, 0, -speed / radius) });
            case Mover.RollingCapsule:
                return world.AddBody(new Capsule(.2f, .8f), At(.2f, across), velocity with { Angular = new(0, 0, -speed / .2f) });
            case Mover.SlidingCapsule:
                return world.AddBody(new Capsule(.2f, .8f), At(.2f, along), velocity);
            case Mover.Box:
                return world.AddBody(new Box(.5f, .5f, .5f), At(.25f, Quaternion.Identity), velocity);
            case Mover.TurnedBox:
                return world.AddBody(new Box(.7f, .3f, .5f), At(.15f, Quaternion.CreateFromAxisAngle(Vector3.UnitY, .7f)), velocity);
            case Mover.StandingCylinder:
                return world.AddBody(new Cylinder(.3f, .4f), At(.2f, Quaternion.Identity), velocity);
            case Mover.RollingCylinder:
                return world.AddBody(new Cylinder(.3f, .4f), At(.3f, across), velocity with { Angular = new(0, 0, -speed / .3f) });
            case Mover.TwoBoxes:
                var half = world.Simulation.Shapes.Add(new Box(.4f, .3f, .5f));
                var both = world.AddCluster([new(half, new RigidPose(new Vector3(-.2f, 0, 0))), new(half, new RigidPose(new Vector3(.2f, 0, 0)))]);
                return world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                    At(.15f, Quaternion.CreateFromAxisAngle(Vector3.UnitY, .7f)), velocity, new Box(.8f, .3f, .5f).ComputeInertia(1), both, -1f));
            default:
                var hull = new ConvexHull(HullPoints, world.Simulation.BufferPool, out var center);
                world.Own(hull);
                return world.AddBody(hull, At(.2f + center.Y, Quaternion.Identity), velocity);
        }
    }

    public static TheoryData<SeamFloor, Mover> Cases
    {
        get
        {
            var data = new TheoryData<SeamFloor, Mover>();
            foreach (var floor in Enum.GetValues<SeamFloor>().Where(floor => floor != SeamFloor.One))
            {
                foreach (var mover in Enum.GetValues<Mover>())
                    data.Add(floor, mover);
            }
            return data;
        }
    }

    [Theory, MemberData(nameof(Cases))]
    public void Seams_are_not_felt(SeamFloor floor, Mover mover)
    {
        foreach (var friction in new[] { 0f, .5f })
        {
            foreach (var speed in new[] { 1f, 5, 20 })
            {
                if (!IsBeyond(floor, mover, friction, speed))
                    Compare(floor, mover, friction, speed);
            }
        }
    }

    // What is not yet as it should be. Slowing down from 20 m/s what stands is tilted, and hops by 7 mm/s on boxes; by 17 and 36 mm/s where triangles know
    // of no neighbours, as those of a mesh do. A mover of two boxes on a floor of boxes may still hit one.
    static bool IsBeyond(SeamFloor floor, Mover mover, float friction, float speed) =>
        (floor == SeamFloor.Boxes && mover == Mover.TwoBoxes) || (friction > 0 && speed == 20 && (
            (floor == SeamFloor.Boxes && mover == Mover.StandingCylinder) ||
            (floor == SeamFloor.LooseTriangles && mover is (Mover.StandingCylinder or Mover.Hull))));

    void Compare(SeamFloor floor, Mover mover, float friction, float speed)
    {
        var stepCount = (int)(Math.Min(20 / speed, 2) * 60);
        using var expected = new ClusterWorld(isCluster: true);
        using var actual = new ClusterWorld(isCluster: true);
        expected.Behaviour.Friction = actual.Behaviour.Friction = friction;
        SeamFloors.Add(expected, SeamFloor.One);
        SeamFloors.Add(actual, floor);
        var (one, other) = (AddMover(expected, mover, speed), AddMover(actual, mover, speed));
        float velocityError = 0, sideways = 0, heightError = 0, upward = 0;
        for (int i = 0; i < stepCount; ++i)
        {
            expected.Step(validate: false);
            actual.Step(validate: false);
            var (a, b) = (expected.Simulation.Bodies[one], actual.Simulation.Bodies[other]);
            velocityError = Math.Max(velocityError, Math.Abs(a.Velocity.Linear.X - b.Velocity.Linear.X));
            sideways = Math.Max(sideways, Math.Abs(a.Velocity.Linear.Z - b.Velocity.Linear.Z));
            heightError = Math.Max(heightError, Math.Abs(a.Pose.Position.Y - b.Pose.Position.Y));
            upward = Math.Max(upward, b.Velocity.Linear.Y - Math.Max(0, a.Velocity.Linear.Y));
        }
        output.WriteLine($"friction {friction} speed {speed}: along {velocityError / speed:g3}, sideways {sideways / speed:g3}, " +
            $"height {heightError * 1000:g3} mm, up {upward * 1000:g3} mm/s");
        // What may be left of up and down is a load that friction takes its part of.
        var allowed = 1e-3f * speed + friction * GreatestUpward;
        Assert.InRange(velocityError, 0, allowed);
        Assert.InRange(sideways, 0, 5e-3f * speed);
        Assert.InRange(heightError, 0, 2e-4f);
        Assert.InRange(upward, 0, GreatestUpward);
    }

    /// <summary>A lip of five centimetres is no seam.</summary>
    [Theory, InlineData(Mover.Sphere), InlineData(Mover.Box)]
    public void A_lip_is_hit(Mover mover)
    {
        using var world = new ClusterWorld(isCluster: true);
        SeamFloors.Add(world, SeamFloor.Boxes, lip: .05f);
        var body = AddMover(world, mover, 5);
        world.Simulation.Bodies[body].Pose.Position.Y += .051f;
        var (least, most) = (5f, 0f);
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            var velocity = world.Simulation.Bodies[body].Velocity.Linear;
            (least, most) = (Math.Min(least, velocity.X), Math.Max(most, velocity.Y));
        }
        Assert.True(least < 4 || most > .3f, $"least speed {least}, greatest upward {most}");
    }
}
