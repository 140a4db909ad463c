using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace DemoTests.Events;

/// <summary>What falls on a floor.</summary>
public enum Falling
{
    Ball,
    FlatBox,
    BoxOnEdge,
    BallOnMesh,
}

/// <summary>A body of half a metre above a floor, at the default settings, that is listened to.</summary>
sealed class FallingWorld : IDisposable
{
    internal const float Gravity = 9.81f;
    internal const float Mass = 2;
    const float Size = .5f;

    readonly BufferPool pool = new();

    /// <param name="falling">What falls, and on what.</param>
    /// <param name="height">Height of its lowest point, m.</param>
    /// <param name="restitution">Coefficient of restitution.</param>
    internal FallingWorld(Falling falling, float height, float restitution = 0)
    {
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(.5f, 2, SpringSettings.Rigid))
        {
            Surface = new() { Restitution = restitution },
        };
        Simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)), SolveDescription.Default);
        if (falling == Falling.BallOnMesh)
        {
            pool.Take<Triangle>(2, out var triangles);
            triangles[0] = new(new(-50, 0, -50), new(50, 0, -50), new(50, 0, 50));
            triangles[1] = new(new(-50, 0, -50), new(50, 0, 50), new(-50, 0, 50));
            Simulation.Statics.Add(new(Vector3.Zero, Simulation.Shapes.Add(new Mesh(triangles, Vector3.One, pool))));
        }
        else
        {
            Simulation.Statics.Add(new(new Vector3(0, -.5f, 0), Simulation.Shapes.Add(new Box(100, 1, 100))));
        }
        var isOnEdge = falling == Falling.BoxOnEdge;
        var turn = isOnEdge ? Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 4) : Quaternion.Identity;
        var pose = new RigidPose(new Vector3(0, height + (isOnEdge ? Size * MathF.Sqrt(.5f) : Size / 2), 0), turn);
        Body = falling is Falling.Ball or Falling.BallOnMesh
            ? Simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(pose, Mass, Simulation.Shapes, new Sphere(Size / 2)))
            : Simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(pose, Mass, Simulation.Shapes, new Box(Size, Size, Size)));
        Simulation.Events.Listen(Body, EventMask.Begin | EventMask.End | EventMask.Hit);
    }

    internal Simulation Simulation { get; }

    internal BodyHandle Body { get; }

    internal float Velocity => Simulation.Bodies[Body].Velocity.Linear.Y;

    public void Dispose()
    {
        Simulation.Dispose();
        pool.Dispose();
    }
}
