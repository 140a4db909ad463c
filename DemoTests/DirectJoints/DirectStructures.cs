using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;

namespace DemoTests.DirectJoints;

/// <summary>Structures of joints for tests of who solves them.</summary>
static class DirectStructures
{
    static readonly Box link = new(.8f, .2f, .3f);

    /// <summary>Links of 1 kg, a metre long, from a kinematic one on.</summary>
    /// <param name="world">World to add to.</param>
    /// <param name="start">Where the kinematic one is.</param>
    /// <param name="count">Number of the others.</param>
    /// <param name="load">Mass of the last, kg.</param>
    /// <param name="spring">Of the joints; rigid unless said.</param>
    /// <param name="downwards">Whether it hangs; it is straight out otherwise.</param>
    public static List<BodyHandle> AddChain(
        TestWorld world, Vector3 start, int count, float load = 1, SpringSettings spring = default, bool downwards = false)
    {
        var turn = downwards ? Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -System.MathF.PI / 2) : Quaternion.Identity;
        var along = downwards ? -Vector3.UnitY : Vector3.UnitX;
        var bodies = new List<BodyHandle> { world.AddKinematic(link, new RigidPose(start, turn)) };
        for (int i = 1; i <= count; ++i)
        {
            bodies.Add(world.AddDynamic(link, i == count ? load : 1, new RigidPose(start + i * along, turn)));
            var socket = new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0), SpringSettings = spring };
            world.Solver.Add(bodies[i - 1], bodies[i], socket);
        }
        return bodies;
    }

    /// <summary>Boxes welded to each other in a row.</summary>
    public static void AddLoose(TestWorld world, Vector3 start, int count)
    {
        var last = world.AddDynamic(link, 1, new RigidPose(start));
        for (int i = 1; i < count; ++i)
        {
            var next = world.AddDynamic(link, 1, new RigidPose(start + new Vector3(i, 0, 0)));
            world.Solver.Add(last, next, new Weld { LocalOffset = new(1, 0, 0), LocalOrientation = Quaternion.Identity });
            last = next;
        }
    }

    /// <summary>A kinematic trunk from which branches of several types of joints hang, with a heavy end.</summary>
    public static List<BodyHandle> AddTree(TestWorld world, Vector3 start)
    {
        var bodies = new List<BodyHandle> { world.AddKinematic(link, new RigidPose(start)) };
        for (int i = 1; i <= 7; ++i)
        {
            var parent = (i - 1) / 2;
            var offset = new Vector3(i % 2, -1, 0);
            var pose = new RigidPose(world.Bodies[bodies[parent]].Pose.Position + offset);
            bodies.Add(world.AddDynamic(link, i == 7 ? 60 : i, pose));
            if (i % 3 == 0)
                world.Solver.Add(bodies[parent], bodies[i], new Weld { LocalOffset = offset, LocalOrientation = Quaternion.Identity });
            else if (i % 3 == 1)
                world.Solver.Add(bodies[parent], bodies[i], new BallSocket { LocalOffsetA = offset / 2, LocalOffsetB = -offset / 2 });
            else
            {
                world.Solver.Add(bodies[parent], bodies[i], new Hinge
                {
                    LocalOffsetA = offset / 2,
                    LocalOffsetB = -offset / 2,
                    LocalHingeAxisA = Vector3.UnitX,
                    LocalHingeAxisB = Vector3.UnitX,
                });
            }
        }
        return bodies;
    }

    /// <summary>A point on the long axis of a body.</summary>
    public static Vector3 Point(TestWorld world, BodyHandle body, float along)
    {
        var pose = world.Bodies[body].Pose;
        return pose.Position + Vector3.Transform(new Vector3(along, 0, 0), pose.Orientation);
    }

    /// <summary>Greatest error of joints, rad.</summary>
    public static double GreatestAngle(TestWorld world, List<ConstraintHandle> joints)
    {
        double greatest = 0;
        foreach (var joint in joints)
            greatest = Math.Max(greatest, world.Solver.GetSeparation(joint).Angular);
        return greatest;
    }

    /// <summary>Greatest gap of the joints of a chain.</summary>
    public static float Gap(TestWorld world, IReadOnlyList<BodyHandle> chain)
    {
        float greatest = 0;
        for (int i = 1; i < chain.Count; ++i)
            greatest = System.MathF.Max(greatest, (Point(world, chain[i - 1], .5f) - Point(world, chain[i], -.5f)).Length());
        return greatest;
    }

    /// <summary>Lets a bar turn about a point beside its centre for ten seconds. There is to be no gravity.</summary>
    /// <returns>What is left of its speed.</returns>
    public static float TurnRotor(TestWorld world)
    {
        const float offset = .25f, speed = 20;
        var bar = new Box(1, .2f, .2f);
        var anchor = world.AddKinematic(bar, new RigidPose(Vector3.Zero));
        var rotor = world.AddDynamic(bar, 10, new RigidPose(new Vector3(offset, 0, 0)));
        world.Bodies[rotor].Velocity = new(new Vector3(0, speed * offset, 0), new Vector3(0, 0, speed));
        world.Solver.Add(anchor, rotor, new Hinge { LocalOffsetB = new(-offset, 0, 0), LocalHingeAxisA = Vector3.UnitZ, LocalHingeAxisB = Vector3.UnitZ });
        world.Step(600);
        return world.Bodies[rotor].Velocity.Angular.Z / speed;
    }
}
