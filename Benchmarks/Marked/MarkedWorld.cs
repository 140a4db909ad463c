using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace Benchmarks.Marked;

/// <summary>Balls in one of the scenes, all marked as continuous or none.</summary>
sealed class MarkedWorld : IDisposable
{
    const float Radius = .1f;
    const float Speed = 150;
    const float RoomPerBall = 10;
    const float Dt = 1 / 60f;
    // Of the balls of a heap before they fall, m.
    const float HeapSpacing = 2.2f * Radius;

    readonly BufferPool pool = new();
    readonly ThreadDispatcher? dispatcher;
    readonly Random random = new(5);
    TypedIndex shape;

    public MarkedWorld(MarkedScene scene, int count, bool isMarked, int threads)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var gravity = new Vector3(0, scene == MarkedScene.Heap ? -9.81f : 0, 0);
        Simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(gravity), new SolveDescription(1, 4));
        var mode = isMarked ? ContinuousDetection.Continuous() : ContinuousDetection.Passive;
        if (scene == MarkedScene.Heap)
            Pour(count, mode);
        else
            FillRoom(count, scene == MarkedScene.Posts ? count : 0, mode);
    }

    public Simulation Simulation { get; }

    public void Step() => Simulation.Timestep(Dt, dispatcher);

    void Pour(int count, ContinuousDetection mode)
    {
        var side = (int)Math.Ceiling(Math.Cbrt(count));
        var half = side * HeapSpacing / 2;
        AddWalls(new Vector3(half));
        for (int i = 0; i < count; ++i)
        {
            var place = new Vector3(i % side, i / (side * side), i / side % side) + new Vector3(.5f) + Any() * .04f;
            Add(place * HeapSpacing - new Vector3(half), default, mode);
        }
    }

    void FillRoom(int count, int posts, ContinuousDetection mode)
    {
        var half = MathF.Cbrt(count * RoomPerBall) / 2;
        AddWalls(new Vector3(half));
        var post = Simulation.Shapes.Add(new Box(.2f, .6f, .2f));
        var side = (int)Math.Ceiling(Math.Cbrt(count));
        var spacing = 2 * half / side;
        for (int i = 0; i < count; ++i)
        {
            var cell = (new Vector3(i % side, i / side % side, i / (side * side)) + new Vector3(.5f)) * spacing - new Vector3(half);
            Add(cell + Any() * (.2f * spacing), Vector3.Normalize(Any()) * Speed, mode);
            if (i < posts)
                Simulation.Statics.Add(new StaticDescription(cell + new Vector3(.5f * spacing, 0, 0), post));
        }
    }

    void AddWalls(Vector3 half)
    {
        foreach (var outwards in (Vector3[])[Vector3.UnitX, -Vector3.UnitX, Vector3.UnitY, -Vector3.UnitY, Vector3.UnitZ, -Vector3.UnitZ])
            Simulation.Statics.Add(new StaticDescription(outwards * half, Simulation.Shapes.Add(new HalfSpace(-outwards))));
    }

    void Add(Vector3 position, Vector3 velocity, ContinuousDetection mode)
    {
        var ball = new Sphere(Radius);
        if (!shape.Exists)
            shape = Simulation.Shapes.Add(ball);
        Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            position, new BodyVelocity(velocity), ball.ComputeInertia(1), new CollidableDescription(shape, mode), -1));
    }

    Vector3 Any() => new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f);

    public void Dispose()
    {
        Simulation.Dispose();
        dispatcher?.Dispose();
        pool.Clear();
    }
}
