using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Of which separate things a floor consists.</summary>
public enum SeparateFloor
{
    /// <summary>10 x 10 boxes of 3 m.</summary>
    TenByTen,
    /// <summary>Boxes of 1 m.</summary>
    Boxes,
    /// <summary>Cubes of 1 m in two layers.</summary>
    Voxels,
    /// <summary>Height fields of 4 m, of cells of 1 m.</summary>
    Fields,
    /// <summary>Two meshes of triangles of 1 m with a common border across the way.</summary>
    Meshes,
    /// <summary>Kinematic boxes of 1 m that rest.</summary>
    Kinematics,
    /// <summary>One mesh of squares of 2 m, every other one of which is cut into 3 x 7: vertices in the middle of the others' edges.</summary>
    Junctions,
}

/// <summary>Floors of separate statics whose top is at y = 0.</summary>
static class SeparateFloors
{
    /// <summary>Adds a floor on which something may move 22 m along X from the origin.</summary>
    /// <param name="world">The world.</param>
    /// <param name="floor">What it consists of.</param>
    /// <param name="seed">Tells how it lies.</param>
    /// <param name="lip">Height by which every other one is above the others, m.</param>
    public static void Add(ClusterWorld world, SeparateFloor floor, int seed, float lip = 0)
    {
        var random = new Random(seed);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, random.NextSingle() * .7f - .35f);
        var shift = new Vector3(random.NextSingle() - .5f, 0, random.NextSingle() - .5f);
        var shapes = world.Simulation.Shapes;
        var size = floor switch { SeparateFloor.TenByTen => 3, SeparateFloor.Fields => 4, SeparateFloor.Meshes => 24, SeparateFloor.Junctions => 36, _ => 1 };
        var shape = floor switch
        {
            SeparateFloor.Fields => AddField(world),
            SeparateFloor.Meshes => AddMesh(world),
            SeparateFloor.Junctions => AddJunctions(world, size),
            _ => shapes.Add(new Box(size, 1, size)),
        };
        var cells = new List<(int X, int Z)>(Cells(size, floor, turn, shift));
        if (random.Next(2) == 0)
            cells.Reverse();
        foreach (var (x, z) in cells)
        {
            var isHigh = (x + z) % 2 != 0;
            // Boxes are placed by their centre, grids by their corner.
            var local = floor is SeparateFloor.Fields ? new Vector3(x, 0, z) * size
                : floor is SeparateFloor.Meshes ? new Vector3(x * size - 13, 0, z * size - 12)
                : floor is SeparateFloor.Junctions ? new Vector3(-6.3f, 0, -18.7f) : new Vector3((x + .5f) * size, -.5f, (z + .5f) * size);
            Put(local + new Vector3(0, isHigh ? lip : 0, 0));
            if (floor == SeparateFloor.Voxels)
                Put(local - Vector3.UnitY);
        }

        void Put(Vector3 local)
        {
            var pose = new RigidPose(Vector3.Transform(local, turn) + shift, turn);
            if (floor == SeparateFloor.Kinematics)
                world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(pose, shape, -1f));
            else
                world.Simulation.Statics.Add(new StaticDescription(pose, shape));
        }
    }

    static IEnumerable<(int X, int Z)> Cells(int size, SeparateFloor floor, Quaternion turn, Vector3 shift)
    {
        if (floor == SeparateFloor.Meshes)
        {
            yield return (0, 0);
            yield return (1, 0);
            yield break;
        }
        if (floor == SeparateFloor.Junctions)
        {
            yield return (0, 0);
            yield break;
        }
        for (int x = -6 / size - 1; x < 28 / size; ++x)
        {
            for (int z = -15 / size - 1; z < 15 / size + 1; ++z)
            {
                var place = Vector3.Transform(new Vector3(x + .5f, 0, z + .5f) * size, turn) + shift;
                if (Math.Abs(place.Z) < 2.2f + size && place.X > -3 - size && place.X < 25 + size)
                    yield return (x, z);
            }
        }
    }

    static TypedIndex AddField(ClusterWorld world)
    {
        var field = new HeightField(5, 5, 1, 1, new float[25], world.Simulation.BufferPool);
        world.Own(field);
        return world.Simulation.Shapes.Add(field);
    }

    static TypedIndex AddMesh(ClusterWorld world)
    {
        const int Count = 24;
        var vertices = new List<Vector3>();
        var indices = new List<int>();
        for (int z = 0; z <= Count; ++z)
        {
            for (int x = 0; x <= Count; ++x)
            {
                vertices.Add(new(x, 0, z));
                if (x == Count || z == Count)
                    continue;
                var corner = z * (Count + 1) + x;
                indices.AddRange([corner, corner + 1, corner + Count + 1, corner + 1, corner + Count + 2, corner + Count + 1]);
            }
        }
        var mesh = new Mesh(vertices.ToArray(), indices.ToArray(), Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        return world.Simulation.Shapes.Add(mesh);
    }

    static TypedIndex AddJunctions(ClusterWorld world, int size)
    {
        const int Square = 2;
        var vertices = new List<Vector3>();
        var indices = new List<int>();
        for (int i = 0; i < size * size / (Square * Square); ++i)
        {
            var (x, z) = (i % (size / Square), i / (size / Square));
            var (countX, countZ) = (x + z) % 2 == 0 ? (1, 1) : (3, 7);
            var first = vertices.Count;
            for (int j = 0; j < (countX + 1) * (countZ + 1); ++j)
            {
                var (column, row) = (j % (countX + 1), j / (countX + 1));
                vertices.Add(new Vector3(x + (float)column / countX, 0, z + (float)row / countZ) * Square);
                if (column == countX || row == countZ)
                    continue;
                var corner = first + j;
                indices.AddRange([corner, corner + 1, corner + countX + 1, corner + 1, corner + countX + 2, corner + countX + 1]);
            }
        }
        var mesh = new Mesh(vertices.ToArray(), indices.ToArray(), Vector3.One, world.Simulation.BufferPool);
        world.Own(mesh);
        return world.Simulation.Shapes.Add(mesh);
    }
}
