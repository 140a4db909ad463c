using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace DemoTests.Scenes;

/// <summary>A simulation with callbacks of a test's own, which it reaches where the narrow phase holds them.</summary>
sealed class CallbackWorld<TCallbacks> : IDisposable where TCallbacks : struct, INarrowPhaseCallbacks
{
    readonly BufferPool pool = new();
    readonly Simulation simulation;

    public CallbackWorld(TCallbacks callbacks) =>
        simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));

    public ref TCallbacks Callbacks => ref ((NarrowPhase<TCallbacks>)simulation.NarrowPhase).Callbacks;

    public StaticHandle AddStatic<TShape>(in TShape shape, Vector3 position) where TShape : unmanaged, IConvexShape =>
        simulation.Statics.Add(new StaticDescription(position, simulation.Shapes.Add(shape)));

    /// <summary>A ball of half a metre and one kilogram.</summary>
    public BodyHandle AddBall(Vector3 position, float verticalSpeed) => simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(
        position, new BodyVelocity(new Vector3(0, verticalSpeed, 0)), 1, simulation.Shapes, new Sphere(.5f)));

    public Vector3 Velocity(BodyHandle body) => simulation.Bodies[body].Velocity.Linear;

    public void Step() => simulation.Timestep(1 / 60f);

    public void Dispose()
    {
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
