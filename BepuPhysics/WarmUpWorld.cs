using System;
using System.Numerics;
using System.Threading;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A small world of its own in which each pair of convex shapes meets, so that a real one finds its code compiled.</summary>
readonly struct WarmUpWorld : IDisposable
{
    // Within so many, contacts are made, kept and lost.
    const int StepCount = 40;
    const float Spacing = 10;
    const int ThreadsBit = 1 << 31;

    // Shape types that this process has warmed up, as bits, and whether it did so with threads: what is compiled stays so.
    static int warmedUp;

    readonly BufferPool pool;
    readonly Simulation simulation;
    readonly ConvexHull hull;
    readonly TypedIndex[] shapes = new TypedIndex[ConvexHull.Id + 1];
    readonly BodyInertia[] inertias = new BodyInertia[ConvexHull.Id + 1];

    // All of the shapes are about one metre high.
    WarmUpWorld(BufferPool pool)
    {
        this.pool = pool;
        simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 2));
        Span<Vector3> corners =
            [new(-.5f, -.5f, -.5f), new(.5f, -.5f, -.4f), new(0, -.5f, .5f), new(-.4f, .5f, -.4f), new(.4f, .5f, -.4f), new(0, .5f, .4f)];
        hull = new ConvexHull(corners, pool, out _);
        Add(new Sphere(.5f));
        Add(new Capsule(.25f, .5f));
        Add(new Box(1, 1, 1));
        Add(new Triangle(new(-1, .4f, -1), new(-1, .4f, 1), new(1, .4f, 0)));
        Add(new Cylinder(.5f, 1));
        Add(hull);
    }

    void Add<TShape>(TShape shape) where TShape : unmanaged, IConvexShape
    {
        shapes[TShape.TypeId] = simulation.Shapes.Add(shape);
        inertias[TShape.TypeId] = shape.ComputeInertia(1);
    }

    /// <summary>Runs the world.</summary>
    /// <param name="types">Ids of the shape types that take part.</param>
    /// <param name="dispatcher">Threads to use; null for the calling thread alone.</param>
    internal static void Run(ReadOnlySpan<int> types, IThreadDispatcher? dispatcher)
    {
        var parts = dispatcher is null ? 0 : ThreadsBit;
        foreach (var type in types)
            parts |= 1 << type;
        if ((Interlocked.Or(ref warmedUp, parts) & parts) == parts)
            return;
        using var pool = new BufferPool();
        using var world = new WarmUpWorld(pool);
        var place = 0;
        foreach (var a in types)
        {
            foreach (var b in types)
            {
                if (a > b)
                    continue;
                world.Add(a, b, place++, Quaternion.Identity);
                world.Add(b, a, place++, Exact.Normalize(new Quaternion(.3f, .1f, .2f, 1)));
            }
        }
        for (int i = 0; i < StepCount; ++i)
            world.simulation.Timestep(1 / 60f, i % 2 == 0 ? null : dispatcher);
    }

    // Bodies over each other and over what does not move: contacts on one body and on two, new, kept and gone.
    void Add(int lower, int upper, int place, Quaternion orientation)
    {
        var at = new Vector3(place % 8 * Spacing, 0, place / 8 * Spacing);
        simulation.Statics.Add(new StaticDescription(at, shapes[lower]));
        simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(at + new Vector3(.1f, 1.05f, .05f), orientation), inertias[upper], shapes[upper], .01f));
        simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(at + new Vector3(0, 2.1f, .1f), orientation), inertias[lower], shapes[lower], .01f));
    }

    public void Dispose()
    {
        simulation.Dispose();
        hull.Dispose(pool);
    }
}
