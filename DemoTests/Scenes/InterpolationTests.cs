using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Poses between two steps against what the poses before and after the step say.</summary>
public sealed class InterpolationTests : IDisposable
{
    readonly TestWorld world = new();

    public void Dispose() => world.Dispose();

    Dictionary<BodyHandle, RigidPose> Collect(float amount)
    {
        var handles = new BodyHandle[world.Bodies.ActiveSet.Count];
        var poses = new RigidPose[handles.Length];
        int count = world.Bodies.GetInterpolatedPoses(amount, handles, poses);
        var result = new Dictionary<BodyHandle, RigidPose>();
        for (int i = 0; i < count; ++i)
            result.Add(handles[i], poses[i]);
        return result;
    }

    [Fact]
    public void ATurnIsFollowedAtItsRateAndTheShorterWay()
    {
        // A sphere that turns 1 rad in a step about an axis, from either of the two quaternions of a place.
        foreach (float sign in new[] { 1f, -1f })
        {
            var start = new Vector3(3, 4, 5);
            var velocity = new BodyVelocity(new Vector3(6, 0, -12), new Vector3(0, 0, 60));
            var kinematic = world.AddKinematic(new Sphere(1), new RigidPose(start, new Quaternion(0, 0, 0, sign)));
            world.Bodies[kinematic].Velocity = velocity;
            world.Step();
            ref var pose = ref world.Bodies[kinematic].Pose;
            pose.Orientation = new(-pose.Orientation.X, -pose.Orientation.Y, -pose.Orientation.Z, -pose.Orientation.W);
            foreach (float amount in new[] { 0, .25f, .5f, .9f, 1 })
            {
                var between = world.Bodies.GetInterpolatedPose(kinematic, amount);
                var expected = start + new Vector3(6, 0, -12) / 60 * amount;
                Assert.InRange((between.Position - expected).Length(), 0, 1e-5f);
                var axis = Vector3.Transform(Vector3.UnitX, between.Orientation);
                Assert.InRange((axis - new Vector3(MathF.Cos(amount), MathF.Sin(amount), 0)).Length(), 0, 1e-5f);
            }
            Assert.Equal(pose.Position, world.Bodies.GetInterpolatedPose(kinematic, 1).Position);
            world.Bodies.Remove(kinematic);
        }
    }

    [Fact]
    public void OnlyBodiesThatMovedAreListed()
    {
        var moving = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var standing = world.AddKinematic(new Sphere(1), new RigidPose(new Vector3(50, 0, 0)));
        Assert.Empty(Collect(.5f));
        world.Step();
        var before = world.Bodies[moving].Pose.Position;
        world.Step();
        var after = world.Bodies[moving].Pose.Position;
        var added = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(0, 90, 0)));
        var listed = Collect(.5f);
        Assert.Equal([moving], listed.Keys);
        Assert.InRange((listed[moving].Position - (before + after) / 2).Length(), 0, 1e-6f);
        Assert.Equal(listed[moving].Position, world.Bodies.GetInterpolatedPose(moving, .5f).Position);
        Assert.Equal(new Vector3(0, 90, 0), world.Bodies.GetInterpolatedPose(added, .5f).Position);
        Assert.Equal(new Vector3(50, 0, 0), world.Bodies.GetInterpolatedPose(standing, .5f).Position);
    }

    [Fact]
    public void WhatIsWrittenJumps()
    {
        var written = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var described = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(20, 0, 0)));
        world.Step(3);
        var target = new RigidPose(new Vector3(7, 8, 9), Quaternion.CreateFromAxisAngle(Vector3.UnitX, 1));
        world.Bodies[written].Pose = target;
        var description = world.Bodies.GetDescription(described);
        description.Pose = target;
        world.Bodies.ApplyDescription(described, description);
        Assert.Equal(target, world.Bodies.GetInterpolatedPose(written, .3f));
        Assert.Equal(target, world.Bodies.GetInterpolatedPose(described, .3f));
        Assert.Empty(Collect(.3f));
        world.Bodies.Remove(described);
        // From the place that it was taken to, not from the one before.
        world.Step();
        Assert.InRange((world.Bodies.GetInterpolatedPose(written, 0).Position - target.Position).Length(), 0, 1e-6f);
        Assert.Equal([written], Collect(.3f).Keys);
    }

    [Fact]
    public void WhatSleepsIsWhereItsPoseSays()
    {
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        world.Step(3);
        var reference = world.Bodies[body];
        reference.Awake = false;
        Assert.Equal(world.Bodies[body].Pose, world.Bodies.GetInterpolatedPose(body, .5f));
        reference.Awake = true;
        Assert.Equal(world.Bodies[body].Pose.Position, world.Bodies.GetInterpolatedPose(body, 1).Position);
        world.Step();
        Assert.Equal([body], Collect(.5f).Keys);
    }

    [Fact]
    public void BadValuesAreRefusedAndNothingIsAllocated()
    {
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        world.Step();
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.GetInterpolatedPose(body, float.NaN));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.GetInterpolatedPose(body, 1.01f));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies.GetInterpolatedPoses(-.1f, new BodyHandle[1], new RigidPose[1]));
        Assert.Throws<ArgumentException>(() => world.Bodies.GetInterpolatedPoses(.1f, [], new RigidPose[1]));
        Assert.Throws<ArgumentException>(() => world.Bodies.GetInterpolatedPoses(.1f, new BodyHandle[1], []));
        var handles = new BodyHandle[1];
        var poses = new RigidPose[1];
        Assert.Equal(1, world.Bodies.GetInterpolatedPoses(.1f, handles, poses));
        long before = GC.GetAllocatedBytesForCurrentThread();
        int count = world.Bodies.GetInterpolatedPoses(.2f, handles, poses);
        long after = GC.GetAllocatedBytesForCurrentThread();
        Assert.Equal((1, before), (count, after));
        world.Bodies.Remove(body);
        Assert.Throws<ArgumentException>(() => world.Bodies.GetInterpolatedPose(body, .5f));
    }
}
