using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;

namespace DemoTests.Accuracy;

/// <summary>What a floor of tiles is made of.</summary>
public enum TileKind
{
    /// <summary>A static for each tile.</summary>
    Statics,
    /// <summary>A kinematic body for each tile.</summary>
    Kinematics,
    /// <summary>One static compound.</summary>
    Compound,
    /// <summary>One static mesh, two triangles a tile.</summary>
    Mesh,
}

/// <summary>A world with a floor of tiles whose top is at y = 0.</summary>
sealed class TileWorld : IDisposable
{
    readonly List<Compound> compounds = [];
    readonly List<Mesh> meshes = [];

    public TileWorld(AccuracySettings settings, TileKind kind, int count, float size)
    {
        World = new AccuracyWorld(settings);
        int columns = count switch { 1 => 1, 2 or 4 => 2, 9 => 3, _ => throw new ArgumentOutOfRangeException(nameof(count), count, null) };
        int rows = count / columns;
        var tiles = new Vector3[count];
        for (int i = 0; i < count; ++i)
            tiles[i] = new Vector3((i % columns - (columns - 1) / 2f) * size, 0, (i / columns - (rows - 1) / 2f) * size);
        var box = new Box(size, 1, size);
        var down = new Vector3(0, -.5f, 0);
        if (kind == TileKind.Compound)
            Simulation.Statics.Add(new StaticDescription(Vector3.Zero, AddCompound(box, [.. Array.ConvertAll(tiles, tile => tile + down)])));
        else if (kind == TileKind.Mesh)
            Simulation.Statics.Add(new StaticDescription(Vector3.Zero, AddMesh(tiles, size / 2)));
        else
            foreach (var tile in tiles)
            {
                if (kind == TileKind.Statics)
                    World.AddStatic(box, new RigidPose(tile + down));
                else
                    World.AddKinematic(box, new RigidPose(tile + down));
            }
    }

    public AccuracyWorld World { get; }

    Simulation Simulation => World.Simulation;

    /// <summary>A shape of equal boxes.</summary>
    public TypedIndex AddCompound(Box box, ReadOnlySpan<Vector3> places)
    {
        Simulation.BufferPool.Take<CompoundChild>(places.Length, out var children);
        var child = Simulation.Shapes.Add(box);
        for (int i = 0; i < places.Length; ++i)
            children[i] = new CompoundChild(places[i], child);
        compounds.Add(new Compound(children));
        return Simulation.Shapes.Add(compounds[^1]);
    }

    TypedIndex AddMesh(Vector3[] tiles, float half)
    {
        Simulation.BufferPool.Take<Triangle>(2 * tiles.Length, out var triangles);
        Vector3 a = new(-half, 0, -half), b = new(half, 0, -half);
        for (int i = 0; i < tiles.Length; ++i)
        {
            triangles[2 * i] = new Triangle(tiles[i] + a, tiles[i] + b, tiles[i] - a);
            triangles[2 * i + 1] = new Triangle(tiles[i] + a, tiles[i] - a, tiles[i] - b);
        }
        meshes.Add(new Mesh(triangles, Vector3.One, Simulation.BufferPool));
        return Simulation.Shapes.Add(meshes[^1]);
    }

    public void Dispose()
    {
        Simulation.Clear();
        compounds.ForEach(compound => compound.Dispose(Simulation.BufferPool));
        meshes.ForEach(mesh => mesh.Dispose(Simulation.BufferPool));
        World.Dispose();
    }
}
