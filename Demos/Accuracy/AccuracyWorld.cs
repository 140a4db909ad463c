using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Demos.References;

namespace Demos.Accuracy;

/// <summary>
/// A simulation with one material and constant gravity, on one thread and without sleeping, and what the cases read from it.
/// </summary>
sealed class AccuracyWorld : IDisposable
{
    static readonly BodyActivityDescription neverSleep = new(-1);
    readonly BufferPool pool = new();
    readonly List<BodyHandle> dynamics = [];

    public AccuracyWorld(AccuracySettings settings)
    {
        Settings = settings;
        Simulation = Simulation.Create(pool, EngineTraits.Contacts(settings), new WorldGravity(settings), EngineTraits.Solve(settings));
    }

    public AccuracySettings Settings { get; }

    public Simulation Simulation { get; }

    public Bodies Bodies => Simulation.Bodies;

    /// <summary>Dynamic bodies in the order in which they were added.</summary>
    public IReadOnlyList<BodyHandle> Dynamics => dynamics;

    public double Time { get; private set; }

    public BodyHandle AddDynamic<TShape>(in TShape shape, float mass, RigidPose pose, BodyVelocity velocity = default)
        where TShape : unmanaged, IConvexShape
    {
        var collidable = new CollidableDescription(Simulation.Shapes.Add(shape));
        var handle = Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(mass), collidable, neverSleep));
        dynamics.Add(handle);
        return handle;
    }

    /// <summary>A body of equal pieces of one convex shape.</summary>
    /// <param name="piece">The shape.</param>
    /// <param name="mass">Mass of all, kg.</param>
    /// <param name="places">Where the pieces are from their middle, which is at the centre of mass.</param>
    /// <param name="pose">Where that is.</param>
    /// <param name="velocity">How it moves.</param>
    public BodyHandle AddDynamicPieces<TShape>(in TShape piece, float mass, IReadOnlyCollection<Vector3> places, RigidPose pose, BodyVelocity velocity)
        where TShape : unmanaged, IConvexShape
    {
        using var builder = new CompoundBuilder(Simulation.BufferPool, Simulation.Shapes, places.Count);
        foreach (var place in places)
            builder.Add(piece, new RigidPose(place), mass / places.Count);
        builder.BuildDynamicCompound(out var children, out var inertia);
        var collidable = new CollidableDescription(Simulation.Shapes.Add(new Compound(children)));
        var handle = Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, inertia, collidable, neverSleep));
        dynamics.Add(handle);
        return handle;
    }

    public BodyHandle AddKinematic<TShape>(in TShape shape, RigidPose pose) where TShape : unmanaged, IConvexShape =>
        Bodies.Add(BodyDescription.CreateKinematic(pose, new CollidableDescription(Simulation.Shapes.Add(shape)), neverSleep));

    /// <summary>A body of infinite mass that nothing touches, for joints.</summary>
    public BodyHandle AddAnchor(Vector3 position) =>
        Bodies.Add(BodyDescription.CreateKinematic(new RigidPose(position), default(CollidableDescription), neverSleep));

    public StaticHandle AddStatic<TShape>(in TShape shape, RigidPose pose) where TShape : unmanaged, IConvexShape =>
        Simulation.Statics.Add(new StaticDescription(pose.Position, pose.Orientation, Simulation.Shapes.Add(shape)));

    /// <summary>A flat floor whose surface is at y = 0 of an origin.</summary>
    public void AddGround(float extent = 200, float thickness = 2, Vector3 origin = default) =>
        AddStatic(new Box(extent, thickness, extent), new RigidPose(origin - new Vector3(0, thickness / 2, 0)));

    public Double3 Position(BodyHandle body) => Bodies[body].Pose.Position;

    public DoubleQuaternion Orientation(BodyHandle body) => Bodies[body].Pose.Orientation;

    /// <summary>Where a point of a body is.</summary>
    public Double3 Point(BodyHandle body, Vector3 offset) => Position(body) + Orientation(body).Rotate(offset);

    public Double3 LinearVelocity(BodyHandle body) => Bodies[body].Velocity.Linear;

    public Double3 AngularVelocity(BodyHandle body) => Bodies[body].Velocity.Angular;

    /// <summary>
    /// Kinetic and potential energy of a body with the given principal moments; potential is zero at the origin's height.
    /// </summary>
    public double Energy(BodyHandle body, double mass, Double3 principalInertia)
    {
        var spin = Orientation(body).RotateBack(AngularVelocity(body));
        return mass * LinearVelocity(body).LengthSquared / 2
            + Double3.Dot(Double3.Scale(principalInertia, spin), spin) / 2
            - mass * Double3.Dot(Settings.Gravity, Position(body));
    }

    /// <summary>Steps until at least this much time has passed since the last call, with a look at the world after each step.</summary>
    public void Run(double seconds, Action? afterStep = null)
    {
        int count = (int)Math.Round(seconds / Settings.Dt);
        for (int i = 0; i < count; ++i)
        {
            Step(Settings.Dt);
            afterStep?.Invoke();
        }
    }

    public void Step(float dt)
    {
        Simulation.Timestep(dt);
        Time += dt;
    }

    public void Dispose()
    {
        Simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
