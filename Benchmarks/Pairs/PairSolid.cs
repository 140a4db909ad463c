using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using Benchmarks.Pairs.Shared;

namespace Benchmarks.Pairs;

/// <summary>A shape of the comparison and what placing it needs to know.</summary>
sealed class PairSolid
{
    readonly List<Feature> features;

    PairSolid(PairShape shape, float size, float radius, List<Feature> features)
    {
        Shape = shape;
        Size = size;
        Radius = radius;
        this.features = features;
    }

    public PairShape Shape { get; }

    /// <summary>The least half width, m.</summary>
    public float Size { get; }

    /// <summary>The shape lies within so much of its origin, m.</summary>
    public float Radius { get; }

    /// <summary>Direction of the only side that has contacts, in the shape's frame; null where all have.</summary>
    public Vector3? Front => Shape.Kind == PairShapeKind.Triangle ? features[0].Normal : null;

    /// <summary>Whether there is a side to rest on.</summary>
    public bool CanRest => features.Count > 0;

    /// <summary>A side to rest on.</summary>
    /// <param name="Normal">Unit, outwards.</param>
    /// <param name="Tangent">A direction of an edge, or null where all are alike.</param>
    /// <param name="IsLine">Whether it is no more than a line along the tangent.</param>
    public readonly record struct Feature(Vector3 Normal, Vector3? Tangent, bool IsLine);

    /// <summary>A side to rest on, at random.</summary>
    public Feature NextFeature(Random random) => features[random.Next(features.Count)];

    /// <summary>A shape of random size.</summary>
    public static PairSolid Create(PairShapeKind kind, Random random)
    {
        float x = NextSize(random), y = NextSize(random), z = NextSize(random);
        switch (kind)
        {
            case PairShapeKind.Sphere:
                return new(new(kind, [x]), x, x, []);
            case PairShapeKind.Capsule:
                return new(new(kind, [x, 2 * y]), x, x + y, Round(random));
            case PairShapeKind.Box:
                return new(new(kind, [2 * x, 2 * y, 2 * z]), MathF.Min(x, MathF.Min(y, z)), new Vector3(x, y, z).Length(),
                    [new(Vector3.UnitX, Vector3.UnitY, false), new(Vector3.UnitY, Vector3.UnitZ, false), new(-Vector3.UnitZ, Vector3.UnitX, false)]);
            case PairShapeKind.Cylinder:
                List<Feature> sides = Round(random);
                sides.Add(new(Vector3.UnitY, null, false));
                sides.Add(new(-Vector3.UnitY, null, false));
                return new(new(kind, [x, 2 * y]), MathF.Min(x, y), new Vector2(x, y).Length(), sides);
            case PairShapeKind.Triangle:
                return CreateTriangle(random);
            default:
                return CreateHull(kind, new Vector3(x, y, z), random);
        }
    }

    static float NextSize(Random random) => PairGeometry.Next(random, 0.25f, 0.75f);

    // Lines of a surface that is round about Y.
    static List<Feature> Round(Random random)
    {
        var lines = new List<Feature>();
        for (int i = 0; i < 2; ++i)
            lines.Add(new(PairGeometry.NextTangent(random, Vector3.UnitY), Vector3.UnitY, true));
        return lines;
    }

    static PairSolid CreateTriangle(Random random)
    {
        Quaternion orientation = PairGeometry.NextRotation(random);
        var corners = new Vector3[3];
        for (int i = 0; i < 3; ++i)
        {
            float angle = (i + PairGeometry.Next(random, -0.15f, 0.15f)) * (2 * MathF.PI / 3);
            float distance = PairGeometry.Next(random, 0.5f, 1.2f);
            corners[i] = Vector3.Transform(distance * new Vector3(MathF.Cos(angle), 0, MathF.Sin(angle)), orientation);
        }
        Vector3 center = (corners[0] + corners[1] + corners[2]) / 3;
        for (int i = 0; i < 3; ++i)
            corners[i] -= center;
        Vector3 across = Vector3.Cross(corners[2] - corners[0], corners[1] - corners[0]);
        float longest = 0;
        for (int i = 0; i < 3; ++i)
            longest = MathF.Max(longest, Vector3.Distance(corners[i], corners[(i + 1) % 3]));
        return new(new(PairShapeKind.Triangle, Flatten(corners)), 0.5f * across.Length() / longest, corners.Max(corner => corner.Length()),
            [new(Vector3.Normalize(across), Vector3.Normalize(corners[1] - corners[0]), false)]);
    }

    // Points of an ellipsoid, all of which are vertices.
    static PairSolid CreateHull(PairShapeKind kind, Vector3 axes, Random random)
    {
        var points = new Vector3[kind == PairShapeKind.Hull14 ? 14 : 32];
        Vector3 center = default;
        for (int i = 0; i < points.Length; ++i)
        {
            points[i] = axes * PairGeometry.NextDirection(random);
            center += points[i] / points.Length;
        }
        float radius = 2 * points.Max(point => Vector3.Distance(point, center));
        return new(new(kind, Flatten(points)), MathF.Min(axes.X, MathF.Min(axes.Y, axes.Z)), radius, LargestFaces(points, 4));
    }

    // Three points are a face where all others are on one side of them.
    static List<Feature> LargestFaces(Vector3[] points, int count)
    {
        var faces = new List<(float Area, Feature Feature)>();
        for (int i = 0; i < points.Length; ++i)
        {
            for (int j = 0; j < points.Length; ++j)
            {
                for (int k = Math.Max(i, j) + 1; k < points.Length; ++k)
                {
                    Vector3 first = points[i], across = Vector3.Cross(points[j] - first, points[k] - first);
                    if (i != j && Array.TrueForAll(points, point => Vector3.Dot(across, point - first) < 1e-6f))
                        faces.Add((across.Length(), new(Vector3.Normalize(across), Vector3.Normalize(points[j] - first), false)));
                }
            }
        }
        return faces.OrderByDescending(face => face.Area).Take(count).Select(face => face.Feature).ToList();
    }

    static float[] Flatten(Vector3[] points) => points.SelectMany(point => new[] { point.X, point.Y, point.Z }).ToArray();
}
