using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace Demos.JointTables;

/// <summary>
/// Boxes that pins, rods and a guide hold together without friction, built twice from one list: with joints in a world of the engine, and as equations in
/// double precision. A point is looked at, which swings through a plane.
/// </summary>
/// <param name="name">As it is asked for.</param>
/// <param name="summary">What it is, in a line.</param>
sealed class Linkage(string name, string summary)
{
    /// <summary>The world, where a body is asked for.</summary>
    public const int World = -1;

    const float Gravity = 9.81f;

    readonly List<(Vector3 Size, float Mass, RigidPose Pose)> boxes = [];
    readonly List<(int A, int B, Vector3 OffsetA, Vector3 OffsetB)> pins = [], rods = [];
    readonly List<(int Body, Vector3 Offset, Vector3 Point)> guides = [];

    public string Name => name;

    public string Summary => summary;

    /// <summary>Body of the point that is looked at.</summary>
    public int WatchedBody { get; init; }

    /// <summary>Place of the point in its body.</summary>
    public Vector3 WatchedOffset { get; init; }

    /// <summary>Normal of the plane that it swings through.</summary>
    public Vector3 WatchedAxis { get; init; } = Vector3.UnitX;

    /// <summary>Where the plane is along its normal, m.</summary>
    public float WatchedLevel { get; init; }

    /// <summary>Whether it comes back to where it was, again and again: else it has no period.</summary>
    public bool IsPeriodic { get; init; } = true;

    public int BodyCount => boxes.Count;

    /// <summary>Adds a box at rest and returns its number.</summary>
    public int AddBox(Vector3 size, float mass, RigidPose pose)
    {
        boxes.Add((size, mass, pose));
        return boxes.Count - 1;
    }

    /// <summary>Adds a bar of a square section of .1 m in the plane of X and Y from one point to another, along its local X.</summary>
    public int AddBar(Vector2 from, Vector2 to, float mass)
    {
        double angle = Math.Atan2(to.Y - from.Y, to.X - from.X);
        var orientation = new Quaternion(0, 0, (float)Math.Sin(angle / 2), (float)Math.Cos(angle / 2));
        return AddBox(new Vector3((to - from).Length(), .1f, .1f), mass, new RigidPose(new Vector3((from + to) / 2, 0), orientation));
    }

    /// <summary>A hinge about Z where two bodies have a point now.</summary>
    public void Pin(int a, int b, Vector2 point) => pins.Add((a, b, Local(a, new Vector3(point, 0)), Local(b, new Vector3(point, 0))));

    /// <summary>A rod without mass from a point of a body to one of another.</summary>
    public void Rod(int a, int b, Vector3 pointA, Vector3 pointB) => rods.Add((a, b, Local(a, pointA), Local(b, pointB)));

    /// <summary>Keeps a point of a body on the line through it along X.</summary>
    public void Guide(int body, Vector2 point) => guides.Add((body, Local(body, new Vector3(point, 0)), new Vector3(point, 0)));

    /// <summary>Builds it as equations.</summary>
    public ConstrainedBodies CreateReference()
    {
        var reference = new ConstrainedBodies(Gravity);
        foreach ((Vector3 size, float mass, RigidPose pose) in boxes)
            reference.Add(ConstrainedBody.Box(mass, size, pose.Position, DoubleQuaternion.Normalize(pose.Orientation)));
        foreach ((int a, int b, Vector3 offsetA, Vector3 offsetB) in pins)
        {
            reference.AddPin(a, offsetA, b, offsetB, Vector3.UnitX);
            reference.AddPin(a, offsetA, b, offsetB, Vector3.UnitY);
        }
        foreach ((int a, int b, Vector3 offsetA, Vector3 offsetB) in rods)
            reference.AddRod(a, offsetA, b, offsetB);
        foreach ((int body, Vector3 offset, Vector3 point) in guides)
            reference.AddPin(World, point, body, offset, Vector3.UnitY);
        return reference;
    }

    /// <summary>Adds it to a world and returns its bodies.</summary>
    public BodyHandle[] AddTo(AccuracyWorld world, JointGaps gaps)
    {
        BodyHandle anchor = world.AddAnchor(default);
        BodyHandle[] handles = [.. boxes.ConvertAll(box => world.AddDynamic(new Box(box.Size.X, box.Size.Y, box.Size.Z), box.Mass, box.Pose))];
        Solver solver = world.Simulation.Solver;
        SpringSettings spring = world.Settings.Spring;
        var unlimited = new ServoSettings(float.MaxValue, 0, float.MaxValue);
        foreach ((int a, int b, Vector3 offsetA, Vector3 offsetB) in pins)
        {
            solver.Add(Handle(a), Handle(b), new Hinge
            {
                LocalOffsetA = offsetA,
                LocalHingeAxisA = Vector3.UnitZ,
                LocalOffsetB = offsetB,
                LocalHingeAxisB = Vector3.UnitZ,
                SpringSettings = spring,
            });
            gaps.Add(Handle(a), Handle(b), offsetA, offsetB);
        }
        foreach ((int a, int b, Vector3 offsetA, Vector3 offsetB) in rods)
        {
            float length = (float)(world.Point(Handle(b), offsetB) - world.Point(Handle(a), offsetA)).Length;
            solver.Add(Handle(a), Handle(b), new DistanceServo(offsetA, offsetB, length, spring, unlimited));
            gaps.Add(Handle(a), Handle(b), offsetA, offsetB, length);
        }
        foreach ((int body, Vector3 offset, Vector3 point) in guides)
        {
            solver.Add(anchor, Handle(body), new PointOnLineServo
            {
                LocalOffsetA = point,
                LocalOffsetB = offset,
                LocalDirection = Vector3.UnitX,
                ServoSettings = unlimited,
                SpringSettings = spring,
            });
        }
        return handles;

        BodyHandle Handle(int body) => body == World ? anchor : handles[body];
    }

    /// <summary>Kinetic and potential energy of its bodies in a world, which is zero at the height of the origin, J.</summary>
    public double Energy(AccuracyWorld world, BodyHandle[] handles)
    {
        double energy = 0;
        for (int i = 0; i < handles.Length; ++i)
        {
            (Vector3 size, float mass, _) = boxes[i];
            energy += world.Energy(handles[i], mass, TorqueFreeBody.BoxInertia(mass, size.X, size.Y, size.Z));
        }
        return energy;
    }

    Vector3 Local(int body, Vector3 point)
    {
        if (body == World)
            return point;
        Double3 local = DoubleQuaternion.Normalize(boxes[body].Pose.Orientation).RotateBack((Double3)point - boxes[body].Pose.Position);
        return new Vector3((float)local.X, (float)local.Y, (float)local.Z);
    }
}
