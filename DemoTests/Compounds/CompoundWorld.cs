using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.Compounds;

/// <summary>A simulation with compounds; its pool must be empty in the end.</summary>
sealed class CompoundWorld : IDisposable
{
    readonly ThreadDispatcher? dispatcher;

    public CompoundWorld(int threads = 1, float gravity = -9.81f)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = Simulation.Create(
            Pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, gravity, 0)), new SolveDescription(1, 4));
    }

    public BufferPool Pool { get; } = new();

    public Simulation Simulation { get; }

    /// <summary>Adds a dynamic compound of boxes, of a density of one.</summary>
    public BodyHandle AddBody(RigidPose pose, BodyVelocity velocity, bool isBig, params (Vector3 Size, RigidPose Pose)[] boxes)
    {
        using var builder = new CompoundBuilder(Pool, Simulation.Shapes, boxes.Length);
        foreach (var (size, place) in boxes)
            builder.Add(new Box(size.X, size.Y, size.Z), place, size.X * size.Y * size.Z);
        builder.BuildDynamicCompound(out var children, out var inertia, out _);
        return Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, inertia, AddShape(children, isBig), -1f));
    }

    /// <summary>Adds a static compound of boxes.</summary>
    public StaticHandle AddStatic(bool isBig, params (Vector3 Size, RigidPose Pose)[] boxes)
    {
        using var builder = new CompoundBuilder(Pool, Simulation.Shapes, boxes.Length);
        foreach (var (size, place) in boxes)
            builder.AddForKinematic(new Box(size.X, size.Y, size.Z), place, 1);
        builder.BuildKinematicCompound(out var children);
        return Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, AddShape(children, isBig)));
    }

    TypedIndex AddShape(Buffer<CompoundChild> children, bool isBig) => isBig
        ? Simulation.Shapes.Add(new BigCompound(children, Simulation.Shapes, Pool))
        : Simulation.Shapes.Add(new Compound(children));

    public void Step(bool validate = false)
    {
        Simulation.Timestep(1 / 60f, dispatcher);
        if (validate)
            Simulation.Validate();
    }

    /// <summary>Bits of all bodies.</summary>
    public int[] State() => BodyBits.Of(Simulation);

    public void Dispose()
    {
        Simulation.Bodies.Clear();
        Simulation.Statics.Clear();
        CompoundWorkshop.RemoveAll(Simulation.Shapes, Pool);
        Simulation.Dispose();
        dispatcher?.Dispose();
        Pool.AssertEmpty();
        Pool.Clear();
    }
}
