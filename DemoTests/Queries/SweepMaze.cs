using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Demos.Accuracy;
using DemoTests.Scenes;

namespace DemoTests.Queries;

/// <summary>A world with everything in it that a sweep may hit, and what it is made of.</summary>
sealed class SweepMaze : IDisposable
{
    public const float Extent = 8;

    readonly Random random;
    readonly TypedIndex[] convex;
    readonly TypedIndex[] containers;
    readonly List<Action> disposals = [];

    /// <param name="seed">Chooses what there is and where.</param>
    /// <param name="reversed">Whether it is added last to first.</param>
    public SweepMaze(int seed, bool reversed = false)
    {
        random = new(seed);
        convex =
        [
            Shapes.Add(new Sphere(.6f)), Shapes.Add(new Capsule(.3f, 1)), Shapes.Add(new Box(1, .6f, 1.4f)), Shapes.Add(new Cylinder(.5f, .8f)),
            Own(new ConvexHull(Cloud(20, .8f), World.Pool, out _)), Shapes.Add(new Triangle(new(-1, 0, -.7f), new(1, .2f, -.6f), new(.1f, 0, 1))),
        ];
        containers = [AddCompound(4), AddBigCompound(12), AddMesh(), AddNested(), AddField()];
        var places = new List<(RigidPose Pose, int Kind)>();
        for (int i = 0; i < 90; ++i)
            places.Add((new(TestWorld.Scatter(random, 2 * Extent), TestWorld.Turn(random)), i));
        if (reversed)
            places.Reverse();
        foreach (var (pose, kind) in places)
            Add(pose, kind);
        var ground = new StaticDescription(new RigidPose(new(0, -Extent - 3, 0), TestWorld.Turn(new Random(1))), Shapes.Add(new HalfSpace(new(.1f, 1, 0))));
        ground.Pose.Orientation = Quaternion.Identity;
        Note(new(World.Statics.Add(ground)), 100);
    }

    public TestWorld World { get; } = new(new AccuracySettings { Contacts = ContactScope.None });

    public Simulation Simulation => World.Simulation;

    public List<CollidableReference> Collidables { get; } = [];

    /// <summary>By collidable, a number that does not depend on the order of adding.</summary>
    public Dictionary<CollidableReference, int> Names { get; } = [];

    Shapes Shapes => World.Simulation.Shapes;

    void Add(in RigidPose pose, int kind)
    {
        var isContainer = kind % 3 == 0;
        var shape = isContainer ? containers[kind / 3 % containers.Length] : convex[kind % convex.Length];
        var isField = isContainer && kind / 3 % containers.Length == 4;
        Note((kind % 4) switch
        {
            0 when !isField => new(
                CollidableMobility.Kinematic, World.Bodies.Add(BodyDescription.CreateKinematic(pose, shape, new BodyActivityDescription(-1)))),
            1 when !isContainer && kind % convex.Length != 5 => new(CollidableMobility.Dynamic, World.Bodies.Add(BodyDescription.CreateDynamic(
                pose, new Sphere(1).ComputeInertia(1), shape, new BodyActivityDescription(-1)))),
            _ => new(World.Statics.Add(new StaticDescription(pose, shape))),
        }, kind);
    }

    void Note(CollidableReference collidable, int name)
    {
        Collidables.Add(collidable);
        Names.Add(collidable, name);
    }

    Vector3[] Cloud(int count, float size)
    {
        var points = new Vector3[count];
        for (int i = 0; i < count; ++i)
            points[i] = TestWorld.Scatter(random, 2 * size);
        return points;
    }

    Buffer<CompoundChild> Children(int count, float extent)
    {
        World.Pool.Take<CompoundChild>(count, out var children);
        for (int i = 0; i < count; ++i)
            children[i] = new(new RigidPose(TestWorld.Scatter(random, extent), TestWorld.Turn(random)), convex[i % convex.Length]);
        return children;
    }

    TypedIndex Own<TShape>(TShape shape) where TShape : unmanaged, IDisposableShape
    {
        disposals.Add(() => shape.Dispose(World.Pool));
        return Shapes.Add(shape);
    }

    TypedIndex AddCompound(int count) => Own(new Compound(Children(count, 3)));

    TypedIndex AddBigCompound(int count) => Own(new BigCompound(Children(count, 5), Shapes, World.Pool));

    TypedIndex AddMesh()
    {
        // A closed body of 80 triangles, and two more that are no part of it.
        var triangles = new List<Triangle>();
        const int Sides = 20;
        for (int i = 0; i < Sides; ++i)
        {
            Vector3 a = Rim(i, 1), b = Rim(i + 1, 1), c = Rim(i, -1), d = Rim(i + 1, -1);
            triangles.AddRange([new(a, c, b), new(b, c, d), new(new(0, 1, 0), a, b), new(new(0, -1, 0), d, c)]);
        }
        triangles.AddRange([new(new(2, 0, 0), new(3, 0, 1), new(3, 1, -1)), new(new(-2, 0, 0), new(-3, 0, 1), new(-3, 1, -1))]);
        return Own(new Mesh(triangles.ToArray().AsSpan(), new Vector3(1.2f, .9f, 1), World.Pool));

        static Vector3 Rim(int i, float y) => new(1.3f * MathF.Cos(i * MathF.Tau / Sides), y, 1.3f * MathF.Sin(i * MathF.Tau / Sides));
    }

    TypedIndex AddNested()
    {
        World.Pool.Take<CompoundChild>(3, out var children);
        children[0] = new(new RigidPose(new(-1, 0, 0), TestWorld.Turn(random)), AddMesh());
        children[1] = new(new RigidPose(new(1, .3f, 0), TestWorld.Turn(random)), AddCompound(3));
        children[2] = new(new RigidPose(new(0, 1, 1)), convex[2]);
        return Own(new Compound(children));
    }

    TypedIndex AddField()
    {
        var heights = new float[7 * 6];
        for (int i = 0; i < heights.Length; ++i)
            heights[i] = random.NextSingle();
        return Own(new HeightField(7, 6, .7f, .6f, heights, World.Pool));
    }

    /// <summary>Numbers of all convex pieces of a collidable; null for one without children.</summary>
    public int[]? Children(CollidableReference collidable)
    {
        Simulation.GetPoseAndShape(collidable, out _, out var shape);
        if (Shapes.GetBatch(shape.Type) is not IContainerBatch container)
            return null;
        var found = new QuickList<int>(16, World.Pool);
        container.FindOverlaps(shape.Index, new(-1e6f), new(1e6f), ref found, World.Pool);
        var children = new int[found.Count];
        for (int i = 0; i < children.Length; ++i)
            children[i] = found[i];
        found.Dispose(World.Pool);
        return children;
    }

    /// <summary>The core of a piece of a collidable, and its pose in the collidable.</summary>
    public unsafe ImpactCore PieceOf(CollidableReference collidable, int child, out RigidPose local)
    {
        var scratch = stackalloc byte[IContainer.ScratchByteCount + 16];
        scratch = (byte*)(((nuint)scratch + 15) & ~(nuint)15);
        Simulation.GetPoseAndShape(collidable, out _, out var shape);
        var batch = Shapes.GetBatch(shape.Type);
        if (batch is not IContainerBatch container)
        {
            local = RigidPose.Identity;
            return ImpactCore.Of(shape.Type, batch.GetPointer(shape.Index));
        }
        container.GetChild(shape.Index, child, scratch, out var found);
        local = found.Pose;
        return ImpactCore.Of(found.TypeId, found.Shape);
    }

    /// <summary>A sweep of some shape.</summary>
    public readonly record struct Case(int Shape, RigidPose Pose, BodyVelocity Velocity, float MaximumT);

    public const int SweptShapeCount = 6;

    public static Case NextCase(Random random)
    {
        var direction = Vector3.Normalize(TestWorld.Scatter(random, 1) + new Vector3(1e-3f));
        var spin = random.Next(3) == 0 ? default : TestWorld.Scatter(random, random.Next(3) == 0 ? 30 : 6);
        return new(random.Next(SweptShapeCount), new(TestWorld.Scatter(random, 2 * Extent), TestWorld.Turn(random)),
            new(direction * (random.Next(10) == 0 ? 0 : 15), spin), random.Next(4) == 0 ? 1e-3f : random.NextSingle() * 1.5f);
    }

    static readonly Sphere sphere = new(.4f);
    static readonly Capsule capsule = new(.25f, .7f);
    static readonly Box box = new(.5f, .9f, .3f);
    static readonly Cylinder cylinder = new(.3f, .5f);
    static readonly Triangle triangle = new(new(-.5f, 0, -.3f), new(.5f, .2f, -.3f), new(.1f, 0, .6f)) { TwoSided = true };

    ConvexHull Hull => Shapes.GetShape<ConvexHull>(convex[4].Index);

    /// <summary>What is to be done with a shape, whatever its type.</summary>
    interface IShapeUser
    {
        void Use<TShape>(TShape shape) where TShape : unmanaged, IConvexShape;
    }

    void WithShape<TUser>(int shape, ref TUser user) where TUser : struct, IShapeUser, allows ref struct
    {
        switch (shape)
        {
            case 0:
                user.Use(sphere);
                break;
            case 1:
                user.Use(capsule);
                break;
            case 2:
                user.Use(box);
                break;
            case 3:
                user.Use(cylinder);
                break;
            case 4:
                user.Use(Hull);
                break;
            default:
                user.Use(triangle);
                break;
        }
    }

    public void Sweep<THandler>(in Case sweep, ref THandler handler) where THandler : ISweepHitHandler
    {
        var user = new Sweeper<THandler>(this, sweep, ref handler);
        WithShape(sweep.Shape, ref user);
    }

    readonly ref struct Sweeper<THandler>(SweepMaze maze, in Case sweep, ref THandler handler) : IShapeUser where THandler : ISweepHitHandler
    {
        readonly ref readonly Case sweep = ref sweep;
        readonly ref THandler handler = ref handler;

        public void Use<TShape>(TShape shape) where TShape : unmanaged, IConvexShape =>
            maze.Simulation.Sweep(shape, sweep.Pose, sweep.Velocity, sweep.MaximumT, maze.World.Pool, ref handler);
    }

    /// <summary>Asks what is near to the shape of a case where it starts; its longest time is the greatest distance.</summary>
    public void FindNear<THandler>(in Case near, BufferPool pool, ref THandler handler) where THandler : IProximityHandler
    {
        var user = new Seeker<THandler>(this, near, pool, ref handler);
        WithShape(near.Shape, ref user);
    }

    readonly ref struct Seeker<THandler>(SweepMaze maze, in Case near, BufferPool pool, ref THandler handler) : IShapeUser
        where THandler : IProximityHandler
    {
        readonly ref readonly Case near = ref near;
        readonly ref THandler handler = ref handler;

        public void Use<TShape>(TShape shape) where TShape : unmanaged, IConvexShape =>
            maze.Simulation.FindNear(shape, near.Pose, near.MaximumT, pool, ref handler);
    }

    /// <summary>The shape of a case, as it starts.</summary>
    public ImpactBody SweptBody(in Case sweep, in SweepMotion motion)
    {
        var maker = new BodyMaker { Motion = motion };
        WithShape(sweep.Shape, ref maker);
        return maker.Body;
    }

    /// <summary>The motion of a case beside a collidable.</summary>
    public SweepMotion MotionOf(in Case sweep, CollidableReference collidable)
    {
        Simulation.GetPoseAndShape(collidable, out var pose, out _);
        return new()
        {
            OrientationA = DoubleMatrix3x3.FromQuaternion(sweep.Pose.Orientation),
            OrientationB = DoubleMatrix3x3.FromQuaternion(pose.Orientation),
            LinearA = new(sweep.Velocity.Linear),
            AngularA = new(sweep.Velocity.Angular),
            OffsetB = new DoubleVector3(pose.Position) - new DoubleVector3(sweep.Pose.Position),
            MaximumT = sweep.MaximumT,
            Accuracy = ImpactAccuracy.Default,
        };
    }

    struct BodyMaker : IShapeUser
    {
        public SweepMotion Motion;
        public ImpactBody Body;

        public unsafe void Use<TShape>(TShape shape) where TShape : unmanaged, IConvexShape =>
            Body = new(ImpactCore.Of(TShape.TypeId, &shape), Motion.OrientationA, Motion.AngularA);
    }

    public void Dispose()
    {
        foreach (var dispose in disposals)
            dispose();
        World.Dispose();
    }
}
