using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.FastBodies;

/// <summary>What is shot at a wall.</summary>
public enum Shot
{
    Ball,
    Pellet,
    SpinningBox,
    SpinningRod,
    Hammer,
}

/// <summary>A wall of a centimetre, or of no thickness.</summary>
public enum Wall
{
    Box,
    Mesh,
    HeightField,
    HalfSpace,
    Heavy,
}

/// <summary>How many of many shots pass a wall, and what becomes of the others.</summary>
sealed class ThinWall : IDisposable
{
    const float Dt = 1 / 60f;
    const float HalfThickness = .005f;
    const float HalfExtent = 60;
    const float Spacing = 150;

    readonly BufferPool pool = new();
    readonly ThreadDispatcher? dispatcher;
    readonly List<BodyHandle> shots = [];
    readonly List<BodyHandle> walls = [];
    readonly List<Vector3> velocities = [];
    readonly List<Action> disposals = [];

    public Simulation Simulation { get; }

    /// <summary>Shots whose centre was behind the wall after any step.</summary>
    public int PassedCount { get; private set; }

    /// <summary>Greatest speed along the wall's normal that was left, of the speed before; of balls without friction nothing is.</summary>
    public float GreatestNormalSpeed { get; private set; }

    /// <summary>Greatest part of the way along the wall that is missing at the end.</summary>
    public float GreatestLostWay { get; private set; }

    /// <summary>How many lost more than a hundredth of their way.</summary>
    public int DelayedCount { get; private set; }

    /// <summary>Rounds that sweeps took in any step at most.</summary>
    public long GreatestRoundCount { get; private set; }

    public ThinWall(Shot shot, Wall wall, float speed, ContinuousDetection continuity, int count, ulong seed, float restitution = 0, int threads = 1)
    {
        dispatcher = threads > 1 ? new ThreadDispatcher(threads) : null;
        var wallCount = wall == Wall.Heavy ? count : 0;
        Simulation = Simulation.Create(
            pool, new FastCallbacks(wallCount, 0, restitution), new DefaultPoseIntegratorCallbacks(default), new SolveDescription(1, 4));
        AddWalls(wall, count);
        var random = new ConvexRandom(seed, (ulong)shot * 16 + (ulong)wall);
        for (int i = 0; i < count; ++i)
            Add(shot, random, CenterOf(wall, i, count), speed, continuity);
        Run(speed);
    }

    static Vector3 CenterOf(Wall wall, int index, int count)
    {
        var side = (int)Math.Ceiling(Math.Sqrt(count));
        return wall == Wall.Heavy ? new Vector3(index % side - side / 2, 0, index / side - side / 2) * Spacing : default;
    }

    void AddWalls(Wall wall, int count)
    {
        var shapes = Simulation.Shapes;
        switch (wall)
        {
            case Wall.Box:
                var plate = new Box(2 * HalfExtent, 2 * HalfThickness, 2 * HalfExtent);
                Simulation.Statics.Add(new StaticDescription(default, Quaternion.Identity, shapes.Add(plate)));
                break;
            case Wall.HalfSpace:
                Simulation.Statics.Add(new StaticDescription(default, Quaternion.Identity, shapes.Add(new HalfSpace(Vector3.UnitY))));
                break;
            case Wall.Mesh:
                Simulation.Statics.Add(new StaticDescription(default, Quaternion.Identity, shapes.Add(CreateMesh())));
                break;
            case Wall.HeightField:
                const int samples = 41;
                const float cell = 2 * HalfExtent / (samples - 1);
                var field = new HeightField(samples, samples, cell, cell, new float[samples * samples], pool);
                disposals.Add(() => field.Dispose(pool));
                Simulation.Statics.Add(new StaticDescription(new Vector3(-HalfExtent, 0, -HalfExtent), Quaternion.Identity, shapes.Add(field)));
                break;
            default:
                var box = new Box(2 * HalfExtent, 2 * HalfThickness, 2 * HalfExtent);
                var collidable = new CollidableDescription(shapes.Add(box));
                for (int i = 0; i < count; ++i)
                {
                    walls.Add(Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                        CenterOf(wall, i, count), box.ComputeInertia(1000), collidable, new BodyActivityDescription(-1))));
                }
                break;
        }
    }

    Mesh CreateMesh()
    {
        const int cells = 30;
        var corners = new List<Vector3>();
        var indices = new List<int>();
        for (int z = 0; z <= cells; ++z)
        {
            for (int x = 0; x <= cells; ++x)
                corners.Add(new Vector3(x * 2f / cells - 1, 0, z * 2f / cells - 1) * HalfExtent);
        }
        for (int z = 0; z < cells; ++z)
        {
            for (int x = 0; x < cells; ++x)
            {
                var first = z * (cells + 1) + x;
                indices.AddRange([first, first + 1, first + cells + 1, first + 1, first + cells + 2, first + cells + 1]);
            }
        }
        var mesh = new Mesh(corners.ToArray(), indices.ToArray(), Vector3.One, pool);
        disposals.Add(() => mesh.Dispose(pool));
        return mesh;
    }

    void Add(Shot shot, ConvexRandom random, Vector3 center, float speed, ContinuousDetection continuity)
    {
        // Within 60 degrees of straight on, from up to three steps away.
        var angle = Math.Acos(random.Next(.5, 1));
        var turn = random.Next(0, 2 * Math.PI);
        var direction = new Vector3((float)(Math.Sin(angle) * Math.Cos(turn)), -(float)Math.Cos(angle), (float)(Math.Sin(angle) * Math.Sin(turn)));
        var target = center + new Vector3((float)random.Next(-1, 1), 0, (float)random.Next(-1, 1)) * (HalfExtent / 20);
        var distance = 1 + speed * Dt * (float)random.Next(0, 2);
        var pose = new RigidPose(target - direction * distance, random.NextOrientation());
        var velocity = new BodyVelocity(direction * speed);
        var spin = ConvexGenerator.ToVector(random.NextDirection());
        switch (shot)
        {
            case Shot.Ball:
                AddConvex(new Sphere(.1f), pose, velocity, continuity);
                break;
            case Shot.Pellet:
                AddConvex(new Sphere(.005f), pose, velocity, continuity);
                break;
            case Shot.SpinningBox:
                velocity.Angular = spin * 50;
                AddConvex(new Box(.2f, .2f, .2f), pose, velocity, continuity);
                break;
            case Shot.SpinningRod:
                velocity.Angular = spin * 50;
                AddConvex(new Box(.01f, 1, .01f), pose, velocity, continuity);
                break;
            default:
                velocity.Angular = spin * 20;
                AddHammer(pose, velocity, continuity);
                break;
        }
        velocities.Add(velocity.Linear);
    }

    void AddConvex<TShape>(in TShape shape, in RigidPose pose, in BodyVelocity velocity, ContinuousDetection continuity)
        where TShape : unmanaged, IConvexShape =>
        shots.Add(Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            pose, velocity, shape.ComputeInertia(1), new CollidableDescription(Simulation.Shapes.Add(shape), continuity), new BodyActivityDescription(-1))));

    void AddHammer(in RigidPose pose, in BodyVelocity velocity, ContinuousDetection continuity)
    {
        using var builder = new CompoundBuilder(pool, Simulation.Shapes, 2);
        builder.Add(new Box(.02f, .4f, .02f), RigidPose.Identity, .5f);
        builder.Add(new Box(.06f, .06f, .12f), new RigidPose(new Vector3(0, .2f, 0)), .5f);
        builder.BuildDynamicCompound(out var children, out var inertia, out _);
        var shape = Simulation.Shapes.Add(new Compound(children));
        var compound = new Compound(children);
        disposals.Add(() => compound.Dispose(pool));
        shots.Add(Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            pose, velocity, inertia, new CollidableDescription(shape, continuity), new BodyActivityDescription(-1))));
    }

    void Run(float speed)
    {
        var passed = new bool[shots.Count];
        // To the wall, and two steps more.
        const int steps = 6;
        var starts = new Vector3[shots.Count];
        for (int i = 0; i < shots.Count; ++i)
            starts[i] = Simulation.Bodies[shots[i]].Pose.Position;
        var count = (int)(1 / (speed * Dt) * 2) + steps;
        for (int step = 0; step < count; ++step)
        {
            Simulation.Timestep(Dt, dispatcher);
            GreatestRoundCount = Math.Max(GreatestRoundCount, Simulation.NarrowPhase.FastPairs.RoundCount);
            for (int i = 0; i < shots.Count; ++i)
                passed[i] |= HeightOf(i) < 0;
        }
        for (int i = 0; i < shots.Count; ++i)
        {
            if (passed[i])
            {
                ++PassedCount;
                continue;
            }
            var velocity = velocities[i];
            var along = new Vector3(velocity.X, 0, velocity.Z);
            var way = Simulation.Bodies[shots[i]].Pose.Position - starts[i];
            var expected = along * (count * Dt);
            GreatestNormalSpeed = Math.Max(GreatestNormalSpeed, Math.Abs(Simulation.Bodies[shots[i]].Velocity.Linear.Y) / speed);
            var lost = 1 - Vector3.Dot(way, expected) / expected.LengthSquared();
            GreatestLostWay = Math.Max(GreatestLostWay, lost);
            DelayedCount += lost > .01f ? 1 : 0;
        }
    }

    // Of the centre of a shot above the middle of its wall.
    float HeightOf(int shot)
    {
        var pose = Simulation.Bodies[shots[shot]].Pose;
        if (walls.Count == 0)
            return pose.Position.Y;
        var wall = Simulation.Bodies[walls[shot]].Pose;
        return Vector3.Dot(Vector3.Transform(Vector3.UnitY, wall.Orientation), pose.Position - wall.Position);
    }

    public void Dispose()
    {
        foreach (var dispose in disposals)
            dispose();
        Simulation.Dispose();
        dispatcher?.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
