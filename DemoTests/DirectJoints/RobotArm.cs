using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;

namespace DemoTests.DirectJoints;

/// <summary>Links along X from a kinematic base, in hinges with servos about Z and Y in turn, with a load at the tip.</summary>
sealed class RobotArm
{
    public const int LinkCount = 6;
    const float Length = .5f;

    readonly TestWorld world;
    readonly float load;
    readonly List<BodyHandle> bodies = [];
    readonly List<ConstraintHandle> servos = [];
    readonly TwistServo[] settings = new TwistServo[LinkCount];

    public RobotArm(TestWorld world, float load, SpringSettings spring, ServoSettings servo)
    {
        (this.world, this.load) = (world, load);
        var link = new Box(Length, .1f, .1f);
        bodies.Add(world.AddKinematic(link, new RigidPose(new Vector3(-Length / 2, 0, 0))));
        for (int i = 0; i < LinkCount; ++i)
        {
            bodies.Add(world.AddDynamic(link, 1, new RigidPose(new Vector3((i + .5f) * Length, 0, 0))));
            world.Solver.Add(bodies[i], bodies[i + 1], new Hinge
            {
                LocalOffsetA = new(Length / 2, 0, 0),
                LocalOffsetB = new(-Length / 2, 0, 0),
                LocalHingeAxisA = Axis(i),
                LocalHingeAxisB = Axis(i),
            });
            settings[i] = new() { LocalBasisA = Basis(i), LocalBasisB = Basis(i), SpringSettings = spring, ServoSettings = servo };
            servos.Add(world.Solver.Add(bodies[i], bodies[i + 1], settings[i]));
        }
        bodies.Add(world.AddDynamic(new Box(.3f, .3f, .3f), load, new RigidPose(new Vector3(LinkCount * Length, 0, 0))));
        world.Solver.Add(bodies[^2], bodies[^1], new Weld { LocalOffset = new(Length / 2, 0, 0), LocalOrientation = Quaternion.Identity });
    }

    // Weights are borne by those about Z.
    static Vector3 Axis(int i) => i % 2 == 0 ? Vector3.UnitZ : Vector3.UnitY;

    // Turns Z to the axis.
    static Quaternion Basis(int i) => i % 2 == 0 ? Quaternion.Identity : Quaternion.CreateFromAxisAngle(Vector3.UnitX, -MathF.PI / 2);

    public BodyHandle Tip => bodies[^1];

    public IReadOnlyList<ConstraintHandle> Servos => servos;

    public void Aim(int i, float angle)
    {
        settings[i].TargetAngle = angle;
        world.Solver.ApplyDescription(servos[i], settings[i]);
    }

    /// <summary>Where the load is when the servos have turned by some angles.</summary>
    public static Vector3 TipAt(double[] angles)
    {
        var turn = Quaternion.Identity;
        Vector3 place = default;
        for (int i = 0; i < LinkCount; ++i)
        {
            turn *= Quaternion.CreateFromAxisAngle(Axis(i), (float)angles[i]);
            place += Vector3.Transform(new Vector3(Length, 0, 0), turn);
        }
        return place;
    }

    /// <summary>Greatest gap of the hinges, m.</summary>
    public double Gap()
    {
        double greatest = 0;
        for (int i = 0; i < LinkCount; ++i)
        {
            var gap = DirectStructures.Point(world, bodies[i], Length / 2) - DirectStructures.Point(world, bodies[i + 1], -Length / 2);
            greatest = Math.Max(greatest, gap.Length());
        }
        return greatest;
    }

    /// <summary>Greatest error of the servos, rad.</summary>
    public double Turn() => DirectStructures.GreatestAngle(world, servos);

    /// <summary>How far the torques of the servos about Z are from what statics says, as a part of the greatest.</summary>
    public double TorqueError(double gravity)
    {
        double worst = 0, greatest = 0;
        for (int i = 0; i < LinkCount; i += 2)
        {
            double expected = load * gravity * (LinkCount - i) * Length;
            for (int k = i; k < LinkCount; ++k)
                expected += gravity * (k + .5 - i) * Length;
            var found = world.Solver.GetAccumulatedImpulseMagnitude(servos[i]) * world.Solver.SubstepCount / TestWorld.Dt;
            worst = Math.Max(worst, Math.Abs(found - expected));
            greatest = Math.Max(greatest, expected);
        }
        return worst / greatest;
    }
}
