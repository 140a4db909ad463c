using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace Benchmarks.Sweeps.Shared;

/// <summary>
/// A world of statics, and shapes that are swept through it from places where they touch nothing: the same numbers in every engine.
/// </summary>
sealed class SweepWorld : IDisposable
{
    /// <summary>Names of the worlds.</summary>
    public static readonly string[] Names = ["shapes", "terrain"];

    /// <summary>Names of the shapes.</summary>
    public static readonly string[] Shapes = ["sphere", "box", "capsule", "cylinder", "hull"];

    /// <summary>Names of the motions.</summary>
    public static readonly string[] Motions = ["straight", "turning"];

    const int StaticCount = 4096;
    /// <summary>Half the width of the world, m.</summary>
    const float Extent = 16;
    /// <summary>Cells of a square metre along each side of the terrain.</summary>
    const int CellCount = 256;
    /// <summary>Length of a sweep that goes on for a second, m.</summary>
    const float Length = 10;

    readonly Random random = new(11);
    readonly bool isTerrain;

    public SweepWorld(string name)
    {
        Simulation = Simulation.Create(Pool, new NoContacts(), new NoMotion(), new SolveDescription(1, 1));
        isTerrain = name == Names[1];
        if (isTerrain)
            AddTerrain();
        else
            AddShapes();
        // As steps would leave the tree, and as a world that is only asked should: adding alone makes one that is dearer to search. A few dozen times,
        // since the peer mends its tree little by little.
        for (int update = 0; update < 64; ++update)
            Simulation.BroadPhase.Update();
        Hull = CreateHull(.25f);
        Reach = isTerrain ? CellCount * .4f : Extent;
        Floor = isTerrain ? 0 : -Extent;
        Ceiling = isTerrain ? 8 : Extent;
    }

    /// <summary>Ends the world with all its memory, that of its shapes included.</summary>
    public void Dispose()
    {
        Simulation.Dispose();
        Pool.Clear();
    }

    /// <summary>Memory of the world, and of its queries.</summary>
    public BufferPool Pool { get; } = new();

    /// <summary>The world itself.</summary>
    public Simulation Simulation { get; }

    /// <summary>The sphere that goes through the world.</summary>
    public static Sphere Sphere => new(.25f);

    /// <summary>The box that goes through the world.</summary>
    public static Box Box => new(.5f, .3f, .4f);

    /// <summary>The hull that goes through the world.</summary>
    public ConvexHull Hull { get; }

    float Reach { get; }

    float Floor { get; }

    float Ceiling { get; }

    void AddShapes()
    {
        var boxes = new TypedIndex[16];
        for (int i = 0; i < boxes.Length; ++i)
        {
            boxes[i] = (i % 4) switch
            {
                0 => Simulation.Shapes.Add(new Sphere(Size())),
                1 => Simulation.Shapes.Add(new Capsule(Size() * .5f, Size())),
                2 => Simulation.Shapes.Add(new Cylinder(Size(), Size())),
                _ => Simulation.Shapes.Add(new Box(2 * Size(), 2 * Size(), 2 * Size())),
            };
        }
        for (int i = 0; i < StaticCount; ++i)
            Simulation.Statics.Add(new StaticDescription(new RigidPose(Place(Extent, -Extent, Extent), Turn()), boxes[i % boxes.Length]));
    }

    void AddTerrain()
    {
        Pool.Take<Triangle>(2 * CellCount * CellCount, out var triangles);
        for (int i = 0; i < CellCount * CellCount; ++i)
        {
            int x = i / CellCount, z = i % CellCount;
            Vector3 a = Hill(x, z), b = Hill(x, z + 1), c = Hill(x + 1, z), d = Hill(x + 1, z + 1);
            // Clockwise seen from above.
            triangles[2 * i] = new Triangle(a, c, b);
            triangles[2 * i + 1] = new Triangle(b, c, d);
        }
        var mesh = new Mesh(triangles, Vector3.One, Pool);
        Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, Simulation.Shapes.Add(mesh)));
    }

    static Vector3 Hill(int row, int column)
    {
        float x = row - CellCount / 2, z = column - CellCount / 2;
        return new(x, MathF.Sin(.2f * x) + MathF.Sin(.17f * z + 1) + MathF.Sin(.11f * (x + z)), z);
    }

    ConvexHull CreateHull(float size)
    {
        var points = new Vector3[14];
        for (int i = 0; i < points.Length; ++i)
            points[i] = Direction() * size;
        return new ConvexHull(points, Pool, out _);
    }

    float Size() => .25f + .5f * random.NextSingle();

    Vector3 Place(float reach, float floor, float ceiling) => new(
        (2 * random.NextSingle() - 1) * reach, floor + (ceiling - floor) * random.NextSingle(), (2 * random.NextSingle() - 1) * reach);

    Vector3 Direction()
    {
        while (true)
        {
            var v = Place(1, -1, 1);
            if (v.LengthSquared() is > .01f and < 1)
                return Vector3.Normalize(v);
        }
    }

    Quaternion Turn() => Quaternion.Normalize(Quaternion.CreateFromAxisAngle(Direction(), 6 * random.NextSingle()));

    /// <summary>One sweep.</summary>
    public readonly record struct Case(RigidPose Pose, BodyVelocity Velocity);

    /// <summary>Makes sweeps of a shape that do not begin in anything.</summary>
    public Case[] CreateCases(string shape, string motion, int count)
    {
        var cases = new Case[count];
        for (int i = 0; i < count;)
        {
            var pose = new RigidPose(Place(Reach, Floor, Ceiling), Turn());
            var velocity = new BodyVelocity(Direction() * Length, motion == Motions[1] ? Direction() * 6 : default);
            if (Sweep(shape, new Case(pose, default), 0).IsHit)
                continue;
            cases[i++] = new(pose, velocity);
        }
        return cases;
    }

    /// <summary>Makes places that may be in something: in the terrain they are up to half a metre above it.</summary>
    public Case[] CreatePlaces(int count)
    {
        var cases = new Case[count];
        foreach (ref var place in cases.AsSpan())
        {
            var position = Place(Reach, Floor, Ceiling);
            if (isTerrain)
            {
                int x = (int)MathF.Floor(position.X), z = (int)MathF.Floor(position.Z);
                position = Hill(x + CellCount / 2, z + CellCount / 2) + new Vector3(0, .5f * random.NextSingle(), 0);
            }
            place = new(new RigidPose(position, Turn()), Direction() * Length);
        }
        return cases;
    }

    /// <summary>Does one sweep.</summary>
    public NearestHit Sweep(string shape, in Case sweep, float maximumT = 1)
    {
        var hit = new NearestHit();
        if (shape == Shapes[0])
            Simulation.Sweep(Sphere, sweep.Pose, sweep.Velocity, maximumT, Pool, ref hit);
        else if (shape == Shapes[1])
            Simulation.Sweep(Box, sweep.Pose, sweep.Velocity, maximumT, Pool, ref hit);
        else if (shape == Shapes[2])
            Simulation.Sweep(new Capsule(.2f, .5f), sweep.Pose, sweep.Velocity, maximumT, Pool, ref hit);
        else if (shape == Shapes[3])
            Simulation.Sweep(new Cylinder(.25f, .4f), sweep.Pose, sweep.Velocity, maximumT, Pool, ref hit);
        else
            Simulation.Sweep(Hull, sweep.Pose, sweep.Velocity, maximumT, Pool, ref hit);
        return hit;
    }
}
