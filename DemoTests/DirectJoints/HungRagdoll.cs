using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;

namespace DemoTests.DirectJoints;

/// <summary>
/// A body of six parts whose hand is held, straight out to the side at first: each joint swings and twists a little, and then its limits bear.
/// </summary>
sealed class HungRagdoll
{
    readonly TestWorld world;
    readonly List<(BodyHandle A, BodyHandle B, Vector3 OffsetA, Vector3 OffsetB)> sockets = [];
    readonly List<ConstraintHandle> limits = [];

    public HungRagdoll(TestWorld world)
    {
        this.world = world;
        var hand = world.AddKinematic(new Sphere(.1f), new RigidPose(Vector3.Zero));
        var forearm = Add(hand, default, new Box(.3f, .08f, .08f), 1.5f, new Vector3(.15f, 0, 0));
        var arm = Add(forearm, new Vector3(.3f, 0, 0), new Box(.3f, .1f, .1f), 2.5f, new Vector3(.45f, 0, 0));
        var chest = Add(arm, new Vector3(.6f, 0, 0), new Box(.3f, .4f, .2f), 30, new Vector3(.75f, -.1f, 0));
        Add(chest, new Vector3(.75f, .1f, 0), new Box(.2f, .25f, .2f), 5, new Vector3(.75f, .25f, 0));
        Add(chest, new Vector3(.68f, -.3f, 0), new Box(.12f, .8f, .12f), 10, new Vector3(.68f, -.7f, 0));
        Add(chest, new Vector3(.82f, -.3f, 0), new Box(.12f, .8f, .12f), 10, new Vector3(.82f, -.7f, .02f));
    }

    BodyHandle Add(BodyHandle parent, Vector3 point, Box shape, float mass, Vector3 place)
    {
        var child = world.AddDynamic(shape, mass, new RigidPose(place));
        var (offsetA, offsetB) = (point - world.Bodies[parent].Pose.Position, point - place);
        world.Solver.Add(parent, child, new BallSocket { LocalOffsetA = offsetA, LocalOffsetB = offsetB });
        sockets.Add((parent, child, offsetA, offsetB));
        limits.Add(world.Solver.Add(parent, child, new SwingLimit { AxisLocalA = Vector3.UnitX, AxisLocalB = Vector3.UnitX, MaximumSwingAngle = .3f }));
        var alongX = Quaternion.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 2);
        limits.Add(world.Solver.Add(
            parent, child, new TwistLimit { LocalBasisA = alongX, LocalBasisB = alongX, MinimumAngle = -.2f, MaximumAngle = .2f }));
        return child;
    }

    /// <summary>Greatest gap of the sockets, m.</summary>
    public double Gap()
    {
        double greatest = 0;
        foreach (var (a, b, offsetA, offsetB) in sockets)
        {
            var (poseA, poseB) = (world.Bodies[a].Pose, world.Bodies[b].Pose);
            var gap = poseA.Position + Vector3.Transform(offsetA, poseA.Orientation) - poseB.Position - Vector3.Transform(offsetB, poseB.Orientation);
            greatest = Math.Max(greatest, gap.Length());
        }
        return greatest;
    }

    /// <summary>By how much a limit is overstepped at most, rad.</summary>
    public double Limit() => DirectStructures.GreatestAngle(world, limits);
}
