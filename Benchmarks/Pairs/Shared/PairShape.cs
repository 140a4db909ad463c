using System;
using System.IO;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace Benchmarks.Pairs.Shared;

/// <summary>A shape as numbers, which every engine makes its own shape of.</summary>
/// <param name="Kind">What it is.</param>
/// <param name="Numbers">Sizes in the order of the shape's constructor; coordinates of corners or points.</param>
sealed record PairShape(PairShapeKind Kind, float[] Numbers)
{
    /// <summary>Adds the engine's shape.</summary>
    public TypedIndex AddTo(Shapes shapes, BufferPool pool) => Kind switch
    {
        PairShapeKind.Sphere => shapes.Add(new Sphere(Numbers[0])),
        PairShapeKind.Capsule => shapes.Add(new Capsule(Numbers[0], Numbers[1])),
        PairShapeKind.Box => shapes.Add(new Box(Numbers[0], Numbers[1], Numbers[2])),
        PairShapeKind.Triangle => shapes.Add(new Triangle(Point(0), Point(1), Point(2))),
        PairShapeKind.Cylinder => shapes.Add(new Cylinder(Numbers[0], Numbers[1])),
        _ => AddHull(shapes, pool),
    };

    /// <summary>A corner or point.</summary>
    public Vector3 Point(int index) => new(Numbers.AsSpan(3 * index, 3));

    /// <summary>All corners or points.</summary>
    public Vector3[] Points()
    {
        var points = new Vector3[Numbers.Length / 3];
        for (int i = 0; i < points.Length; ++i)
            points[i] = Point(i);
        return points;
    }

    /// <summary>Writes the shape to a file.</summary>
    public void Write(BinaryWriter writer)
    {
        writer.Write((int)Kind);
        writer.Write(Numbers.Length);
        foreach (float number in Numbers)
            writer.Write(number);
    }

    /// <summary>Reads what <see cref="Write"/> has written.</summary>
    public static PairShape Read(BinaryReader reader)
    {
        var kind = (PairShapeKind)reader.ReadInt32();
        float[] numbers = new float[reader.ReadInt32()];
        for (int i = 0; i < numbers.Length; ++i)
            numbers[i] = reader.ReadSingle();
        return new PairShape(kind, numbers);
    }

    TypedIndex AddHull(Shapes shapes, BufferPool pool) =>
        ConvexHullHelper.CreateShape(Points(), pool, out _, out ConvexHull hull)
            ? shapes.Add(hull)
            : throw new InvalidDataException("The points of a hull span no volume.");
}
