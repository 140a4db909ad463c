using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>A simulation with voxels, or with big compounds of the same cubes in their place; its pool must be empty in the end.</summary>
sealed class VoxelWorld : IDisposable
{
    readonly ThreadDispatcher? dispatcher;
    readonly List<TypedIndex> owned = [];

    public VoxelWorld(bool isOfCubes = false, int threads = 1, float gravity = -9.81f)
    {
        IsOfCubes = isOfCubes;
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        Simulation = Simulation.Create(
            Pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, gravity, 0)), new SolveDescription(1, 4));
        Simulation.NarrowPhase.CollisionTaskRegistry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>();
    }

    public bool IsOfCubes { get; }

    public BufferPool Pool { get; } = new();

    public Simulation Simulation { get; }

    public Shapes Shapes => Simulation.Shapes;

    /// <summary>Voxels, those of a grid that a rule chooses.</summary>
    public Voxels Create(int width, int height, int length, float size, Vector3 corner, Func<int, int, int, bool> isThere)
    {
        var voxels = new Voxels(width, height, length, size, corner, Pool);
        for (int z = 0; z < length; ++z)
        {
            for (int y = 0; y < height; ++y)
            {
                for (int x = 0; x < width; ++x)
                    voxels[x, y, z] = isThere(x, y, z);
            }
        }
        return voxels;
    }

    /// <summary>Adds voxels as they are, or as a big compound.</summary>
    public TypedIndex Add(Voxels voxels)
    {
        var name = IsOfCubes ? AddCubes(voxels) : Shapes.Add(voxels);
        owned.Add(name);
        return name;
    }

    TypedIndex AddCubes(Voxels voxels)
    {
        var cube = Shapes.Add(new Box(voxels.Size, voxels.Size, voxels.Size));
        List<CompoundChild> cubes = [];
        for (int i = 0; i < voxels.ChildCount; ++i)
        {
            voxels.GetPosedLocalChild(i, out _, out var pose);
            if (voxels.Cells[i])
                cubes.Add(new(pose, cube));
        }
        Pool.Take(cubes.Count, out Buffer<CompoundChild> children);
        CollectionsMarshal.AsSpan(cubes).CopyTo(children.AsSpan());
        voxels.Dispose(Pool);
        return Shapes.Add(new BigCompound(children, Shapes, Pool));
    }

    public StaticHandle AddStatic(Voxels voxels, RigidPose pose) => Simulation.Statics.Add(new StaticDescription(pose, Add(voxels)));

    public BodyHandle AddBody(Voxels voxels, RigidPose pose, BodyVelocity velocity = default)
    {
        var inertia = HomogeneousCompound.ComputeInertia<Voxels, Box, BoxWide>(voxels, voxels.Size * voxels.Size * voxels.Size, Pool, out var center);
        voxels.Corner -= center;
        return Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, inertia, Add(voxels), -1f));
    }

    public BodyHandle AddBody<TShape>(in TShape shape, RigidPose pose, BodyVelocity velocity = default) where TShape : unmanaged, IConvexShape =>
        Simulation.Bodies.Add(BodyDescription.CreateDynamic(pose, velocity, shape.ComputeInertia(1), Shapes.Add(shape), -1f));

    /// <summary>Remembers a shape with memory of its own, to be removed at the end.</summary>
    public TypedIndex Own(TypedIndex name)
    {
        owned.Add(name);
        return name;
    }

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
        foreach (var name in owned)
            Shapes.RemoveAndDispose(name, Pool);
        Simulation.Dispose();
        dispatcher?.Dispose();
        Pool.AssertEmpty();
        Pool.Clear();
    }
}
