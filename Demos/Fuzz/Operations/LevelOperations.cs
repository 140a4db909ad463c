using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to what levels are made of: meshes, height fields and half-spaces.</summary>
static class LevelOperations
{
    const int MaximumShapes = 24;

    public static FuzzOperation[] All { get; } =
    [
        new("Shapes.Add mesh", 8, AddMesh),
        new("Shapes.Add solid mesh", 4, AddSolid),
        new("Shapes.Add height field", 6, AddField),
        new("Shapes.Add half-space", 3, AddHalfSpace),
        new("Mesh of any triangles", 5, MakeMesh),
        new("Mesh of any bytes", 5, LoadMesh),
        new("Mesh.Recenter and inertia", 3, WeighMesh),
        new("HeightField of any heights", 4, MakeField),
        new("HeightField.SetHeights", 4, EditField),
    ];

    // Random triangles, or a strip that knows its neighbours.
    static Triangle[] Triangles(FuzzWorld w)
    {
        var triangles = new Triangle[1 + w.Random.Below(12)];
        float size = w.Random.Percent(90) ? 1 : w.Random.Magnitude(1e-6f, 1e6f);
        bool isStrip = w.Random.Percent(50);
        for (int i = 0; i < triangles.Length; ++i)
        {
            triangles[i] = !isStrip ? new(w.Random.Vector(size), w.Random.Vector(size), w.Random.Vector(size))
                : i % 2 == 0 ? new(new(i, 0, 0), new(i + 2, 0, 0), new(i + 1, 0, 2)) : new(new(i, 0, 2), new(i + 1, 0, 0), new(i + 2, 0, 2));
        }
        w.Tell($"{triangles.Length} triangles, size {size}, strip {isStrip}");
        return triangles;
    }

    static Vector3 Scale(FuzzWorld w) => w.Random.Percent(80) ? Vector3.One : w.Random.Vector(3);

    static void AddMesh(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        var mesh = new Mesh(Triangles(w), w.Random.Spoil(Scale(w), 4), w.Pool) { TwoSided = w.Random.Percent(30) };
        Own(w, mesh);
    }

    // A tetrahedron as large as what may get into it, or larger; some of them are inside out or flat, and refused.
    static void AddSolid(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        var size = w.Random.Number(.5f, 4);
        Vector3[] corners = [w.Random.Vector(size), w.Random.Vector(size), w.Random.Vector(size), w.Random.Vector(size)];
        var mesh = new Mesh(corners, [0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0], Scale(w), w.Pool);
        try
        {
            mesh.Solid = true;
        }
        catch
        {
            mesh.Dispose(w.Pool);
            throw;
        }
        Own(w, mesh);
    }

    static void AddField(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        var (countX, countZ) = (2 + w.Random.Below(6), 2 + w.Random.Below(6));
        var heights = new float[countX * countZ];
        for (int i = 0; i < heights.Length; ++i)
            heights[i] = w.Random.Number(-.5f, .5f);
        var cells = w.Random.Percent(50) ? new HeightFieldCell[(countX - 1) * (countZ - 1)] : [];
        foreach (ref var cell in cells.AsSpan())
            cell = new(w.Random.Below(70) % 64, w.Random.Percent(20), w.Random.Percent(50));
        Own(w, new HeightField(countX, countZ, w.Random.Number(.3f, 2), w.Random.Number(.3f, 2), heights, w.Pool, cells));
    }

    static void Own<TShape>(FuzzWorld w, TShape shape) where TShape : unmanaged, IDisposableShape
    {
        TypedIndex name;
        try
        {
            name = w.Shapes.Add(shape);
        }
        catch (Exception error)
        {
            shape.Dispose(w.Pool);
            if (error is ArgumentException)
                throw new FuzzFailure("a shape was made and then refused: " + error.Message, error);
            throw;
        }
        w.ShapeNames.Live.Add(name);
        w.Owners.Add(name, () => shape.Dispose(w.Pool));
    }

    static void AddHalfSpace(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count < MaximumShapes)
            w.ShapeNames.Live.Add(w.Shapes.Add(new HalfSpace(w.Random.Spoil(w.Random.Percent(50) ? Vector3.UnitY : w.Random.Vector(1), 6))));
    }

    static void MakeMesh(FuzzWorld w)
    {
        Triangle[] triangles = Triangles(w);
        for (int i = 0; i < triangles.Length; ++i)
            triangles[i] = w.Random.Spoil(triangles[i], 6);
        new Mesh(triangles, w.Random.Spoil(Scale(w)), w.Pool).Dispose(w.Pool);
    }

    // What was saved, with some bytes that are not what they were.
    static void LoadMesh(FuzzWorld w)
    {
        var mesh = new Mesh(Triangles(w), Vector3.One, w.Pool);
        var bytes = new byte[mesh.GetSerializedByteCount()];
        mesh.Serialize(bytes);
        mesh.Dispose(w.Pool);
        for (int i = w.Random.Below(4); i > 0; --i)
            bytes[w.Random.Below(bytes.Length)] = (byte)w.Random.Bits();
        int length = w.Random.Percent(80) ? bytes.Length : w.Random.Below(bytes.Length);
        new Mesh(bytes.AsSpan(0, length), w.Pool).Dispose(w.Pool);
    }

    static void WeighMesh(FuzzWorld w)
    {
        var mesh = new Mesh(Triangles(w), Scale(w), w.Pool);
        try
        {
            mesh.Recenter(w.Random.Spoil(w.Random.Vector(1)));
            _ = w.Random.Percent(50) ? mesh.ComputeClosedInertia(w.Random.Spoil(1f)) : mesh.ComputeOpenInertia(w.Random.Spoil(1f));
        }
        finally
        {
            mesh.Dispose(w.Pool);
        }
    }

    static void MakeField(FuzzWorld w)
    {
        var heights = new float[w.Random.Below(40)];
        for (int i = 0; i < heights.Length; ++i)
            heights[i] = w.Random.Spoil(w.Random.Number(-1, 1), 2);
        int countX = w.Random.Percent(50) ? w.AnyCount() : 1 + w.Random.Below(7);
        int countZ = w.Random.Percent(50) ? w.AnyCount() : heights.Length / Math.Max(1, countX);
        new HeightField(countX, countZ, w.Random.Spoil(1f), w.Random.Spoil(1f), heights, w.Pool).Dispose(w.Pool);
    }

    static void EditField(FuzzWorld w)
    {
        var field = new HeightField(4, 5, 1, 1, new float[20], w.Pool);
        try
        {
            var heights = new float[w.Random.Below(9)];
            for (int i = 0; i < heights.Length; ++i)
                heights[i] = w.Random.Spoil(w.Random.Number(-1, 1), 5);
            field.SetHeights(w.Random.Below(7) - 1, w.Random.Below(7) - 1, w.Random.Below(5), w.Random.Below(5), heights);
            field.SetCell(w.Random.Below(6) - 1, w.Random.Below(6) - 1, new(0, isHole: true));
        }
        finally
        {
            field.Dispose(w.Pool);
        }
    }
}
