using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Events;

/// <summary>What is told that a bounce has pushed is what it has changed of the momentum, friction included.</summary>
public class BounceImpulseTests
{
    const float Mass = 2;

    public enum Thrown
    {
        Ball,
        Box,
        FastBall,
    }

    [Theory]
    [InlineData(Thrown.Ball, .5f, .1f)]
    [InlineData(Thrown.Ball, .5f, 1)]
    [InlineData(Thrown.Ball, 1, .3f)]
    [InlineData(Thrown.Ball, 0, .3f)]
    [InlineData(Thrown.Box, .5f, .1f)]
    [InlineData(Thrown.Box, 0, .3f)]
    [InlineData(Thrown.FastBall, .5f, .1f)]
    public void Impulses_are_what_momentum_changes(Thrown thrown, float restitution, float friction)
    {
        var pool = new BufferPool();
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(friction, 2, SpringSettings.Rigid))
        {
            Surface = new() { Restitution = restitution, ExactImpacts = true },
        };
        using (var simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(Vector3.Zero), SolveDescription.Default))
        {
            simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), simulation.Shapes.Add(new Box(100, 1, 100))));
            var velocity = new Vector3(3, -4, 1) * (thrown == Thrown.FastBall ? 30 : 1);
            var body = thrown == Thrown.Box
                ? Add(simulation, new Box(.5f, .2f, .5f), velocity, default)
                : Add(simulation, new Sphere(.2f), velocity, thrown == Thrown.FastBall ? ContinuousDetection.Continuous() : default);
            simulation.Events.Listen(body, EventMask.Begin | EventMask.Persist);
            Vector3 told = default;
            for (int i = 0; i < 20; ++i)
            {
                simulation.Timestep(1 / 60f);
                foreach (ref readonly var touch in simulation.Events.Began)
                    told += touch.Normal * touch.Impulse + touch.FrictionImpulse;
                foreach (ref readonly var touch in simulation.Events.Persisting)
                    told += touch.Normal * touch.Impulse + touch.FrictionImpulse;
            }
            var change = (simulation.Bodies[body].Velocity.Linear - velocity) * Mass;
            Assert.True(change.Length() > Mass * 4);
            Assert.InRange((told - change).Length() / change.Length(), 0, 1e-4f);
        }
        pool.Clear();
    }

    static BodyHandle Add<TShape>(Simulation simulation, TShape shape, Vector3 velocity, ContinuousDetection continuity)
        where TShape : unmanaged, IConvexShape => simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(new Vector3(0, .2f, 0) - velocity / 40), velocity, shape.ComputeInertia(Mass),
            new CollidableDescription(simulation.Shapes.Add(shape), continuity), new BodyActivityDescription(-1)));
}
