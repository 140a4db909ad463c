using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy;

/// <summary>A long plank, static or kinematic, tilted about Z so that it falls towards +X; its surface passes through an origin.</summary>
sealed class Incline
{
    readonly double angle;
    readonly Vector3 origin;

    /// <summary>Adds the plank: 10 m of it lie uphill of the origin, 130 m downhill.</summary>
    public Incline(AccuracyWorld world, double angle, Vector3 origin = default, bool kinematic = false)
    {
        this.angle = angle;
        this.origin = origin;
        var plank = new Box(140, 2, 20);
        if (kinematic)
            world.AddKinematic(plank, Pose(60, -1));
        else
            world.AddStatic(plank, Pose(60, -1));
    }

    /// <summary>A static slope of the same extent whose surface is one of <see cref="Floors.Flat"/>.</summary>
    public Incline(Solids solids, double angle, string floor)
    {
        this.angle = angle;
        Floors.Add(solids, floor, Pose(0, 0), -10, 130, 10);
    }

    public Double3 Downhill => new(Math.Cos(angle), -Math.Sin(angle), 0);

    /// <summary>A pose with the slope's axes: X downhill, Y its normal. Computed in double, rounded once.</summary>
    public RigidPose Pose(double downhill, double height) => new(
        origin + new Vector3(
            (float)(downhill * Math.Cos(angle) + height * Math.Sin(angle)),
            (float)(-downhill * Math.Sin(angle) + height * Math.Cos(angle)),
            0),
        Turn(-angle));

    /// <summary>As <see cref="Pose"/>, but turned in the plane of the slope first.</summary>
    public RigidPose TurnedPose(double height, double yaw)
    {
        var pose = Pose(0, height);
        var turned = DoubleQuaternion.FromAxisAngle(new(0, 0, 1), -angle) * DoubleQuaternion.FromAxisAngle(new(0, 1, 0), yaw);
        return pose with { Orientation = new((float)turned.X, (float)turned.Y, (float)turned.Z, (float)turned.W) };
    }

    /// <summary>A pose for a capsule or cylinder whose axis points downhill.</summary>
    public RigidPose LyingPose(double height) => Pose(0, height) with { Orientation = Turn(-angle - Math.PI / 2) };

    /// <summary>A pose for a capsule or cylinder whose axis lies across the slope.</summary>
    public RigidPose CrossPose(double height)
    {
        var turned = DoubleQuaternion.FromAxisAngle(new(0, 0, 1), -angle) * DoubleQuaternion.FromAxisAngle(new(1, 0, 0), Math.PI / 2);
        return Pose(0, height) with { Orientation = new((float)turned.X, (float)turned.Y, (float)turned.Z, (float)turned.W) };
    }

    static Quaternion Turn(double angle)
    {
        var q = DoubleQuaternion.FromAxisAngle(new(0, 0, 1), angle);
        return new((float)q.X, (float)q.Y, (float)q.Z, (float)q.W);
    }
}
