using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// Surfaces were asked about by the tests of a step, and pairs that wake in that step had not been tested: a row of balls that slept and touched
/// did not pass on the blow that woke it, and swallowed half of its energy. A rack of billiard balls has come to rest before the break.
/// </summary>
public class WokenBounceTests
{
    [Theory]
    [InlineData(false, 1), InlineData(false, 3), InlineData(true, 1), InlineData(true, 3)]
    public void ABlowPassesThroughARowThatSlept(bool boxes, int threads)
    {
        using var dispatcher = new ThreadDispatcher(threads);
        using var world = new World(1, 0, boxes ? Kind.Box : Kind.Sphere, .01f);
        for (int i = 0; i < 60; ++i)
            world.Simulation.Timestep(1 / 60f, dispatcher);
        Assert.All(world.Row, body => Assert.False(world.Simulation.Bodies[body].Awake));
        var striker = world.Strike();

        for (int i = 0; i < 20; ++i)
            world.Simulation.Timestep(1 / 60f, dispatcher);

        // Equal masses at e = 1: each stops and hands all on.
        Assert.InRange(world.SpeedOf(world.Row[^1]), World.Speed * .9999f, World.Speed * 1.0001f);
        foreach (var body in world.Row[..^1].Append(striker))
            Assert.InRange(MathF.Abs(world.SpeedOf(body)), 0, World.Speed * 1e-4f);
    }

    [Theory]
    [InlineData(Kind.Sphere), InlineData(Kind.Box), InlineData(Kind.Compound)]
    public void WhatSleptBouncesAsWhatLayAwake(Kind kind)
    {
        using var slept = new World(.6f, .3f, kind, .01f);
        using var awake = new World(.6f, .3f, kind, -1);
        World[] both = [slept, awake];
        foreach (var world in both)
        {
            for (int i = 0; i < 60; ++i)
                world.Simulation.Timestep(1 / 60f);
            Assert.Equal(world == awake, world.Simulation.Bodies[world.Row[0]].Awake);
            world.Strike();
            for (int i = 0; i < 12; ++i)
                world.Simulation.Timestep(1 / 60f);
        }
        foreach (var (a, b) in slept.Row.Zip(awake.Row))
            Assert.InRange(slept.SpeedOf(a) - awake.SpeedOf(b), World.Speed * -1e-4f, World.Speed * 1e-4f);
        Assert.True(slept.SpeedOf(slept.Row[^1]) > World.Speed * .2f);
    }

    public enum Kind { Sphere, Box, Compound }

    sealed class World : IDisposable
    {
        public const float Speed = 3;

        readonly BufferPool pool = new();
        readonly TypedIndex shape;
        readonly BodyInertia inertia;
        public readonly Simulation Simulation;
        public readonly BodyHandle[] Row = new BodyHandle[4];

        public World(float restitution, float friction, Kind kind, float sleepThreshold)
        {
            var surfaces = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(friction, 2, SpringSettings.Rigid))
            {
                Surface = new() { Restitution = restitution },
            };
            Simulation = Simulation.Create(pool, surfaces, new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 4));
            (shape, inertia) = kind switch
            {
                Kind.Sphere => (Simulation.Shapes.Add(new Sphere(.5f)), new Sphere(.5f).ComputeInertia(1)),
                Kind.Box => (Simulation.Shapes.Add(new Box(1, 1, 1)), new Box(1, 1, 1).ComputeInertia(1)),
                _ => AddCompound(),
            };
            for (int i = 0; i < Row.Length; ++i)
                Row[i] = Simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(i, 0, 0), inertia, shape, sleepThreshold));
        }

        // Two slabs, one on the other: each neighbour is touched by both.
        (TypedIndex Shape, BodyInertia Inertia) AddCompound()
        {
            using var builder = new CompoundBuilder(pool, Simulation.Shapes, 2);
            builder.Add(new Box(1, .5f, 1), new RigidPose(new Vector3(0, .25f, 0)), .5f);
            builder.Add(new Box(1, .5f, 1), new RigidPose(new Vector3(0, -.25f, 0)), .5f);
            builder.BuildDynamicCompound(out var children, out var both);
            return (Simulation.Shapes.Add(new Compound(children)), both);
        }

        public BodyHandle Strike() => Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(-1.3f, 0, 0), new BodyVelocity(new Vector3(Speed, 0, 0)), inertia, shape, -1));

        public float SpeedOf(BodyHandle body) => Simulation.Bodies[body].Velocity.Linear.X;

        public void Dispose()
        {
            Simulation.Dispose();
            pool.Dispose();
        }
    }
}
