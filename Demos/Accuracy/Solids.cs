using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Accuracy;

/// <summary>Solids of the suite by name. Owns the memory of their hulls: to be disposed before the world.</summary>
sealed class Solids(AccuracyWorld world) : IDisposable
{
    /// <summary>Names of the solids that stand on a flat side and carry others on another.</summary>
    public static readonly string[] Standing =
        ["box", "cylinder", "coin", "cube hull", "hexagonal prism", "octagonal prism", "random hull"];

    readonly List<ConvexHull> hulls = [];

    public AccuracyWorld World => world;

    /// <summary>Makes a solid; nothing is in the world before it is placed.</summary>
    /// <param name="name">One of <see cref="Standing"/>, or "sphere", "capsule", "wheel".</param>
    /// <param name="seed">Chooses among random hulls.</param>
    public Solid Create(string name, int seed = 1) => name switch
    {
        "box" => Of(new Box(1, .6f, .8f), .3),
        "cylinder" => Of(new Cylinder(.5f, .6f), .3),
        "coin" => Of(new Cylinder(.5f, .06f), .03),
        "sphere" => Of(new Sphere(.3f), .3),
        // Their axes are upright: to be placed lying.
        "capsule" => Of(new Capsule(.2f, .8f), .6),
        "wheel" => Of(new Cylinder(.2f, .8f), .4),
        "cube hull" => Hull(Prism(4, Math.Sqrt(.5), .5)),
        "hexagonal prism" => Hull(Prism(6, .5, .3)),
        "octagonal prism" => Hull(Prism(8, .5, .25)),
        "64-gon prism" => Hull(Prism(64, .5, .5)),
        "random hull" => Hull(FlatEnded(seed)),
        _ => throw new ArgumentOutOfRangeException(nameof(name), name, null),
    };

    /// <summary>A hull of the world's pool that is returned with the others.</summary>
    public ConvexHull Keep(Vector3[] points, out Vector3 center)
    {
        var hull = new ConvexHull(points, world.Simulation.BufferPool, out center);
        hulls.Add(hull);
        return hull;
    }

    /// <summary>Corners of an upright prism over a regular polygon, one side of which faces Z.</summary>
    public static Vector3[] Prism(int sideCount, double radius, double halfHeight)
    {
        var points = new Vector3[2 * sideCount];
        for (int i = 0; i < sideCount; ++i)
        {
            double angle = 2 * Math.PI * (i + .5) / sideCount + Math.PI / 2;
            points[2 * i] = new((float)(radius * Math.Cos(angle)), (float)-halfHeight, (float)(radius * Math.Sin(angle)));
            points[2 * i + 1] = points[2 * i] with { Y = (float)halfHeight };
        }
        return points;
    }

    /// <summary>
    /// Corners of an irregular hull between two flat ends, random hexagons that are nowhere closer than 20 cm to the middle line.
    /// </summary>
    public static Vector3[] FlatEnded(int seed)
    {
        var random = new Random(seed);
        var points = new Vector3[20];
        for (int i = 0; i < points.Length; ++i)
        {
            bool isEnd = i < 12;
            double angle = 2 * Math.PI * (isEnd ? i % 6 / 6d + (random.NextDouble() - .5) / 10 : random.NextDouble());
            double radius = isEnd ? .3 + .1 * random.NextDouble() : .45 + .1 * random.NextDouble();
            double y = isEnd ? (i < 6 ? -.3 : .3) : .4 * (random.NextDouble() - .5);
            points[i] = new((float)(radius * Math.Cos(angle)), (float)y, (float)(radius * Math.Sin(angle)));
        }
        return points;
    }

    public void Dispose()
    {
        foreach (var hull in hulls)
            hull.Dispose(world.Simulation.BufferPool);
        hulls.Clear();
    }

    Solid Of<TShape>(TShape shape, double halfHeight) where TShape : unmanaged, IConvexShape =>
        new(halfHeight, halfHeight, (mass, pose, velocity) => world.AddDynamic(shape, mass, pose, velocity));

    Solid Hull(Vector3[] points)
    {
        float low = float.MaxValue, high = float.MinValue;
        foreach (var point in points)
            (low, high) = (Math.Min(low, point.Y), Math.Max(high, point.Y));
        var hull = Keep(points, out var center);
        return Of(hull, 0) with { Foot = center.Y - (double)low, Head = high - (double)center.Y };
    }
}

/// <summary>A shape that can be placed in a world as a body.</summary>
/// <param name="Foot">Distance of the lowest point under the centre of mass, unturned.</param>
/// <param name="Head">Distance of the highest point over the centre of mass, unturned.</param>
/// <param name="Add">Adds a dynamic body of a mass.</param>
sealed record Solid(double Foot, double Head, Func<float, RigidPose, BodyVelocity, BodyHandle> Add)
{
    public double Height => Foot + Head;

    public BodyHandle Place(RigidPose pose, float mass = 1, BodyVelocity velocity = default) => Add(mass, pose, velocity);
}
