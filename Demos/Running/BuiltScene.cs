using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using Demos.Engine;

namespace Demos.Running;

/// <summary>A ball joint as it was given to the engine: anchors from the centres of mass, in the bodies' axes.</summary>
readonly record struct BuiltJoint(BodyHandle A, BodyHandle B, Vector3 AnchorA, Vector3 AnchorB);

/// <summary>What is measured on the bodies and joints of a scene, while it runs and at its end.</summary>
sealed class BuiltScene
{
    /// <summary>Height below which a body is lost, m.</summary>
    public const float LostBelow = -50;
    const float MovedDistance = 0.5f;

    readonly Simulation simulation;
    readonly List<BuiltJoint> joints;
    readonly BodyHandle[] handles;
    readonly Vector3[] startPositions;

    /// <param name="simulation">Holds the scene and nothing else.</param>
    /// <param name="joints">The scene's joints.</param>
    public BuiltScene(Simulation simulation, List<BuiltJoint> joints)
    {
        this.simulation = simulation;
        this.joints = joints;
        var found = new List<BodyHandle>();
        int highest = simulation.Bodies.HandlePool.HighestPossiblyClaimedId;
        for (int slot = 0; slot <= highest; ++slot)
        {
            if (EngineHandles.TryGetHandle(simulation.Bodies, slot, out BodyHandle handle))
                found.Add(handle);
        }
        handles = [.. found];
        startPositions = new Vector3[handles.Length];
        for (int i = 0; i < handles.Length; ++i)
            startPositions[i] = simulation.Bodies[handles[i]].Pose.Position;
    }

    /// <summary>Bodies, dynamic and kinematic.</summary>
    public int BodyCount => handles.Length;

    /// <summary>A body by its place in the order of the handles.</summary>
    public BodyReference this[int index] => simulation.Bodies[handles[index]];

    /// <summary>Hash of the bits of all poses and velocities, in the order of the handles.</summary>
    public ulong Hash()
    {
        var hash = new SceneHash();
        foreach (BodyHandle handle in handles)
        {
            BodyReference body = simulation.Bodies[handle];
            ref RigidPose pose = ref body.Pose;
            ref BodyVelocity velocity = ref body.Velocity;
            hash.Add(pose.Orientation);
            hash.Add(pose.Position);
            hash.Add(velocity.Linear);
            hash.Add(velocity.Angular);
        }
        return hash.Value;
    }

    /// <summary>Fills in the figures that follow from poses and velocities.</summary>
    public RunResult Measure(RunResult result)
    {
        double kinetic = 0, potential = 0;
        int moved = 0, lost = 0, notFinite = 0;
        for (int i = 0; i < handles.Length; ++i)
        {
            BodyReference body = simulation.Bodies[handles[i]];
            Vector3 position = body.Pose.Position;
            if (!IsFinite(body))
                ++notFinite;
            if (body.Kinematic)
                continue;
            if (position.Y < LostBelow)
                ++lost;
            if (Length(position - startPositions[i]) > MovedDistance)
                ++moved;
            double mass = body.LocalInertia.InverseMass > 0 ? 1.0 / body.LocalInertia.InverseMass : 0;
            kinetic += KineticEnergy(body, mass);
            potential -= mass * Scenes.SceneDescription.Gravity * position.Y;
        }
        result = result with
        {
            KineticEnergy = kinetic,
            PotentialEnergy = potential,
            Moved = moved,
            Lost = lost,
            NotFinite = notFinite,
        };
        return joints.Count > 0 ? MeasureJoints(result) : result;
    }

    RunResult MeasureJoints(RunResult result)
    {
        double greatest = 0, sumOfSquares = 0;
        foreach (BuiltJoint joint in joints)
        {
            RigidPose a = simulation.Bodies[joint.A].Pose, b = simulation.Bodies[joint.B].Pose;
            Vector3 anchorA = a.Position + SceneMath.Rotate(joint.AnchorA, a.Orientation);
            Vector3 anchorB = b.Position + SceneMath.Rotate(joint.AnchorB, b.Orientation);
            double error = Length(anchorB - anchorA);
            greatest = Math.Max(greatest, error);
            sumOfSquares += error * error;
        }
        return result with { MaximumJointError = greatest, RmsJointError = Math.Sqrt(sumOfSquares / joints.Count) };
    }

    static double KineticEnergy(BodyReference body, double mass)
    {
        BodyVelocity velocity = body.Velocity;
        double linear = Length(velocity.Linear);
        Vector3 w = SceneMath.Rotate(velocity.Angular, Quaternion.Conjugate(body.Pose.Orientation));
        ref var inverse = ref body.LocalInertia.InverseInertiaTensor;
        (double xx, double yx, double yy, double zx, double zy, double zz) =
            (inverse.XX, inverse.YX, inverse.YY, inverse.ZX, inverse.ZY, inverse.ZZ);
        double cofactorXX = yy * zz - zy * zy, cofactorYX = zy * zx - yx * zz, cofactorZX = yx * zy - yy * zx;
        double determinant = xx * cofactorXX + yx * cofactorYX + zx * cofactorZX;
        // A body whose rotation is locked about some axis has no finite inertia there; its energy of rotation is left out.
        if (determinant <= 0)
            return 0.5 * mass * linear * linear;
        double cofactorYY = xx * zz - zx * zx, cofactorZY = yx * zx - xx * zy, cofactorZZ = xx * yy - yx * yx;
        double twice = cofactorXX * w.X * w.X + cofactorYY * w.Y * w.Y + cofactorZZ * w.Z * w.Z
            + 2 * (cofactorYX * w.X * w.Y + cofactorZX * w.X * w.Z + cofactorZY * w.Y * w.Z);
        return 0.5 * (mass * linear * linear + twice / determinant);
    }

    static bool IsFinite(BodyReference body) => IsFinite(body.Pose.Position) && IsFinite(body.Velocity.Linear)
        && IsFinite(body.Velocity.Angular) && IsFinite(body.Pose.Orientation);

    static bool IsFinite(Vector3 v) => float.IsFinite(v.X) && float.IsFinite(v.Y) && float.IsFinite(v.Z);

    static bool IsFinite(Quaternion q) => float.IsFinite(q.X) && float.IsFinite(q.Y) && float.IsFinite(q.Z) && float.IsFinite(q.W);

    static double Length(Vector3 v) => Math.Sqrt((double)v.X * v.X + (double)v.Y * v.Y + (double)v.Z * v.Z);
}
