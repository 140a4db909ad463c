using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;

namespace DemoTests.FastBodies;

/// <summary>What flies about in a room.</summary>
public enum Flyer
{
    Ball,
    Box,
    Capsule,
}

/// <summary>What the room is closed by.</summary>
public enum RoomWalls
{
    Boxes,
    KinematicBoxes,
    Mesh,
    HalfSpaces,
}

/// <summary>A closed room full of marked bodies that meet each other and the walls.</summary>
sealed class ClosedRoom : IDisposable
{
    const float Thickness = .5f;

    static ReadOnlySpan<Vector3> Directions =>
        (Vector3[])[Vector3.UnitX, -Vector3.UnitX, Vector3.UnitY, -Vector3.UnitY, Vector3.UnitZ, -Vector3.UnitZ];

    readonly float half;
    readonly TestWorld world;
    readonly List<BodyHandle> flyers = [];
    Mesh? mesh;

    public ClosedRoom(Flyer flyer, RoomWalls walls, int count, float size, float speed, int seed, int threads = 1)
        : this(walls, size, threads) => Fill(flyer, count, speed, new Random(seed));

    /// <summary>A room with nothing in it.</summary>
    public ClosedRoom(RoomWalls walls, float size, int threads = 1)
    {
        world = new(new AccuracySettings { Gravity = default }, threads);
        half = size / 2;
        switch (walls)
        {
            case RoomWalls.Mesh:
                AddMesh();
                break;
            case RoomWalls.HalfSpaces:
                foreach (var outwards in Directions)
                    world.Statics.Add(new StaticDescription(outwards * half, Quaternion.Identity, Simulation.Shapes.Add(new HalfSpace(-outwards))));
                break;
            default:
                foreach (var outwards in Directions)
                    AddBox(outwards, walls == RoomWalls.KinematicBoxes);
                break;
        }
    }

    /// <summary>Adds a body that may not leave.</summary>
    public void Add(in BodyDescription description) => flyers.Add(world.Bodies.Add(description));

    /// <summary>Bodies whose centre was outside of the room after any step so far.</summary>
    public int OutsideCount { get; private set; }

    public Simulation Simulation => world.Simulation;

    /// <summary>Kinetic energy of all motion but spin, for bodies of 1 kg, J.</summary>
    public double Energy
    {
        get
        {
            var energy = 0.0;
            foreach (var flyer in flyers)
                energy += world.Bodies[flyer].Velocity.Linear.LengthSquared() / 2;
            return energy;
        }
    }

    public void Step(int count, float dt)
    {
        var outside = new HashSet<BodyHandle>();
        for (int i = 0; i < count; ++i)
        {
            world.Step(dt);
            foreach (var flyer in flyers)
            {
                var distance = Vector3.Abs(world.Bodies[flyer].Pose.Position);
                // What is not a number is outside.
                if (!(MathF.Max(distance.X, MathF.Max(distance.Y, distance.Z)) <= half))
                    outside.Add(flyer);
            }
        }
        OutsideCount = outside.Count;
    }

    void AddBox(Vector3 outwards, bool isKinematic)
    {
        var extents = new Vector3(2 * half + 2 * Thickness) + (Thickness - 2 * half - 2 * Thickness) * Vector3.Abs(outwards);
        var pose = new RigidPose(outwards * (half + Thickness / 2));
        if (isKinematic)
            world.AddKinematic(new Box(extents.X, extents.Y, extents.Z), pose);
        else
            world.AddStatic(new Box(extents.X, extents.Y, extents.Z), pose);
    }

    // Two triangles for each wall, whose fronts face inwards.
    void AddMesh()
    {
        world.Pool.Take<Triangle>(12, out var triangles);
        var next = 0;
        foreach (var outwards in Directions)
        {
            var (u, v) = (new Vector3(outwards.Y, outwards.Z, outwards.X) * half, new Vector3(outwards.Z, outwards.X, outwards.Y) * half);
            if (Vector3.Dot(Vector3.Cross(u, v), outwards) < 0)
                (u, v) = (v, u);
            var middle = outwards * half;
            triangles[next++] = new(middle - u - v, middle + u - v, middle + u + v);
            triangles[next++] = new(middle - u - v, middle + u + v, middle - u + v);
        }
        mesh = new Mesh(triangles, Vector3.One, world.Pool);
        world.Statics.Add(new StaticDescription(default, Quaternion.Identity, Simulation.Shapes.Add(mesh.Value)));
    }

    void Fill(Flyer flyer, int count, float speed, Random random)
    {
        var (ball, box, capsule) = (new Sphere(.1f), new Box(.2f, .1f, .3f), new Capsule(.06f, .2f));
        var (shape, inertia) = flyer switch
        {
            Flyer.Ball => (Simulation.Shapes.Add(ball), ball.ComputeInertia(1)),
            Flyer.Box => (Simulation.Shapes.Add(box), box.ComputeInertia(1)),
            _ => (Simulation.Shapes.Add(capsule), capsule.ComputeInertia(1)),
        };
        // On a lattice, so that none overlaps another or a wall at the beginning.
        var side = (int)Math.Ceiling(Math.Cbrt(count));
        var spacing = 2 * half / side;
        for (int i = 0; i < count; ++i)
        {
            var cell = new Vector3(i % side, i / side % side, i / (side * side)) + new Vector3(.5f);
            var position = cell * spacing - new Vector3(half) + TestWorld.Scatter(random, spacing * .2f);
            var velocity = new BodyVelocity(Vector3.Transform(new(speed, 0, 0), TestWorld.Turn(random)), TestWorld.Scatter(random, 40));
            flyers.Add(world.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(position, TestWorld.Turn(random)), velocity, inertia, new CollidableDescription(shape, ContinuousDetection.Continuous()), -1)));
        }
    }

    public void Dispose()
    {
        mesh?.Dispose(world.Pool);
        world.Dispose();
    }
}
