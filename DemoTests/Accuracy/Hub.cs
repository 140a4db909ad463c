using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace DemoTests.Accuracy;

/// <summary>How the arms of a hub are held.</summary>
public enum HubJoint
{
    Weld,
    Hinge,
    Ball,
    Rod,
}

/// <summary>
/// A box that carries arms all around. Free, it floats without gravity, and the arms begin with velocities of their own; as a post it is welded to
/// the world and the arms begin at rest, sticking out, to be held by welds and to swing in other joints. Nothing collides.
/// </summary>
sealed class Hub
{
    const float Size = .5f, ArmLength = 1, ArmWidth = .2f;

    readonly AccuracyWorld world;
    readonly float mass, armMass;
    readonly Double3[] moments;

    /// <param name="world">World to add to.</param>
    /// <param name="joint">What holds the arms.</param>
    /// <param name="armCount">Number of arms.</param>
    /// <param name="armMass">Mass of each arm, kg.</param>
    /// <param name="mass">Mass of the hub, kg.</param>
    /// <param name="isPost">Whether the hub is welded to the world.</param>
    /// <param name="seed">Of the velocities of a free hub's arms.</param>
    public Hub(AccuracyWorld world, HubJoint joint, int armCount, float armMass, float mass, bool isPost, int seed = 1)
    {
        this.world = world;
        this.mass = mass;
        this.armMass = armMass;
        var random = new Random(seed);
        var hub = world.AddDynamic(new Box(Size, Size, Size), mass, RigidPose.Identity);
        if (isPost)
            world.Simulation.Solver.Add(
                world.AddAnchor(new(0, -Size, 0)), hub, new Weld { LocalOffset = new(0, Size, 0), LocalOrientation = Quaternion.Identity });
        for (int i = 0; i < armCount; ++i)
        {
            var direction = isPost ? AroundTheWaist(i, armCount) : AllAround(i, armCount);
            var side = Vector3.Normalize(Vector3.Cross(MathF.Abs(direction.Y) < .9f ? Vector3.UnitY : Vector3.UnitX, direction));
            var orientation = Quaternion.CreateFromRotationMatrix(Rows(direction, Vector3.Cross(side, direction), side));
            var velocity = isPost ? default : new BodyVelocity(Any(random), Any(random));
            var pose = new RigidPose(direction * ((Size + ArmLength) / 2), orientation);
            Join(hub, world.AddDynamic(new Box(ArmLength, ArmWidth, ArmWidth), armMass, pose, velocity), joint, pose, direction, side);
        }
        moments = [Moments(mass, Size, Size, Size), Moments(armMass, ArmLength, ArmWidth, ArmWidth)];
    }

    /// <summary>Weight of all arms times their length, J: what a post could gain by dropping them.</summary>
    public double Scale => (world.Dynamics.Count - 1) * armMass * 9.81 * ArmLength;

    /// <summary>Kinetic and potential energy, J.</summary>
    public double Energy
    {
        get
        {
            double sum = 0;
            for (int i = 0; i < world.Dynamics.Count; ++i)
                sum += world.Energy(world.Dynamics[i], i == 0 ? mass : armMass, moments[Math.Min(i, 1)]);
            return sum;
        }
    }

    /// <summary>Greatest speed of a body, m/s.</summary>
    public double Speed
    {
        get
        {
            double most = 0;
            foreach (var body in world.Dynamics)
                most = Tally.Most(most, world.LinearVelocity(body).Length);
            return most;
        }
    }

    void Join(BodyHandle hub, BodyHandle arm, HubJoint joint, in RigidPose pose, Vector3 direction, Vector3 side)
    {
        var solver = world.Simulation.Solver;
        var (offsetHub, offsetArm) = (direction * (Size / 2), new Vector3(-ArmLength / 2, 0, 0));
        if (joint == HubJoint.Weld)
            solver.Add(hub, arm, new Weld { LocalOffset = pose.Position, LocalOrientation = pose.Orientation });
        else if (joint == HubJoint.Rod)
            solver.Add(hub, arm, new DistanceLimit(offsetHub, default, ArmLength / 2, ArmLength / 2, default));
        else if (joint == HubJoint.Ball)
            solver.Add(hub, arm, new BallSocket { LocalOffsetA = offsetHub, LocalOffsetB = offsetArm });
        else
            solver.Add(hub, arm, new Hinge
            { LocalOffsetA = offsetHub, LocalHingeAxisA = side, LocalOffsetB = offsetArm, LocalHingeAxisB = Vector3.UnitZ });
    }

    static Double3 Moments(double mass, double x, double y, double z) =>
        new Double3(y * y + z * z, x * x + z * z, x * x + y * y) * (mass / 12);

    static Vector3 Any(Random random) => new(2 * random.NextSingle() - 1, 2 * random.NextSingle() - 1, 2 * random.NextSingle() - 1);

    static Vector3 AroundTheWaist(int index, int count)
    {
        var (sine, cosine) = Math.SinCos(Math.Tau * index / count);
        return new((float)cosine, 0, (float)sine);
    }

    /// <summary>Evenly over the sphere, on a spiral.</summary>
    static Vector3 AllAround(int index, int count)
    {
        double y = 1 - 2 * (index + .5) / count, across = Math.Sqrt(1 - y * y), angle = Math.PI * (3 - Math.Sqrt(5)) * index;
        return new((float)(across * Math.Cos(angle)), (float)y, (float)(across * Math.Sin(angle)));
    }

    /// <summary>Takes the axes of a body to three directions.</summary>
    static Matrix4x4 Rows(Vector3 x, Vector3 y, Vector3 z) =>
        new(x.X, x.Y, x.Z, 0, y.X, y.Y, y.Z, 0, z.X, z.Y, z.Z, 0, 0, 0, 0, 1);
}
