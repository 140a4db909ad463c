using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.Children;
using DemoTests.Quality;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What a floor is made of.</summary>
public enum SeamFloor
{
    /// <summary>One box of 80 m.</summary>
    One,
    /// <summary>Boxes of 1 m side by side.</summary>
    Boxes,
    /// <summary>Boxes of 0.25 m side by side.</summary>
    SmallBoxes,
    /// <summary>A grid of 1 m, two triangles a cell, that know that it is flat.</summary>
    Triangles,
    /// <summary>The same of 0.3 m.</summary>
    SmallTriangles,
    /// <summary>A grid of 1 m of triangles that know of no neighbours.</summary>
    LooseTriangles,
    /// <summary>Voxels of 1 m, a shape of the game's own.</summary>
    Voxels,
    /// <summary>The same of 0.25 m.</summary>
    SmallVoxels,
}

/// <summary>Floors whose top is at y = 0, in worlds of clusters.</summary>
static class SeamFloors
{
    // Turned and shifted, so that nothing is along a seam.
    static readonly Quaternion Turn = Quaternion.CreateFromAxisAngle(Vector3.UnitY, .3f);
    static readonly Vector3 Shift = new(-.37f, 0, .21f);

    /// <summary>Adds a floor on which something may move 24 m along X from the origin.</summary>
    /// <param name="world">The world.</param>
    /// <param name="floor">What it is made of.</param>
    /// <param name="lip">Height by which every other child is above the others, m.</param>
    public static void Add(ClusterWorld world, SeamFloor floor, float lip = 0)
    {
        List<ClusterChild> children = [];
        var shapes = world.Simulation.Shapes;
        if (floor is SeamFloor.Voxels or SeamFloor.SmallVoxels)
        {
            AddVoxels(world, floor == SeamFloor.Voxels ? 1 : .25f);
            return;
        }
        var grid = floor switch { SeamFloor.SmallBoxes => .25f, SeamFloor.SmallTriangles => .3f, _ => 1 };
        if (floor == SeamFloor.One)
            children.Add(new(shapes.Add(new Box(80, 1, 80)), new RigidPose(new Vector3(0, -.5f, 0))));
        else if (floor is SeamFloor.Boxes or SeamFloor.SmallBoxes)
            AddBoxes(children, shapes, grid, lip);
        else
            AddTriangles(children, shapes, grid);
        if (floor is SeamFloor.Triangles or SeamFloor.SmallTriangles)
            world.Rules.Cones = _ => new TriangleCone { Cosines = Vector3.One };
        world.Simulation.Statics.Add(new StaticDescription(new RigidPose(Shift, Turn), world.AddCluster(children)));
    }

    // One layer, in a grid that begins where the cells of the others do.
    static void AddVoxels(ClusterWorld world, float size)
    {
        world.Simulation.NarrowPhase.CollisionTaskRegistry.RegisterHomogeneousCompound<DocSamples.Voxels, Box, BoxWide>();
        var (first, side) = (new Vector3(-4, -size, -14), new Vector3(34, 0, 28) / size);
        var voxels = new DocSamples.Voxels((int)side.X, 1, (int)side.Z, size, first, world.Simulation.BufferPool);
        world.Own(voxels);
        foreach (var cell in Cells(size))
            voxels[(int)MathF.Floor((cell.X - first.X) / size), 0, (int)MathF.Floor((cell.Z - first.Z) / size)] = true;
        world.Simulation.Statics.Add(new StaticDescription(new RigidPose(Shift, Turn), world.Simulation.Shapes.Add(voxels)));
    }

    // The cells that something on its way along X comes near.
    static IEnumerable<Vector3> Cells(float grid)
    {
        var toFloor = Quaternion.Conjugate(Turn);
        for (int i = (int)(-4 / grid); i < 30 / grid; ++i)
        {
            for (int j = (int)(-14 / grid); j < 14 / grid; ++j)
            {
                var center = new Vector3((i + .5f) * grid, 0, (j + .5f) * grid);
                var place = Vector3.Transform(center, Turn) + Shift;
                if (Math.Abs(place.Z) < 2.2f + grid && place.X > -3 && place.X < 27)
                    yield return center;
            }
        }
    }

    static void AddBoxes(List<ClusterChild> children, Shapes shapes, float grid, float lip)
    {
        var box = shapes.Add(new Box(grid, 1, grid));
        foreach (var cell in Cells(grid))
        {
            var isHigh = ((int)MathF.Floor(cell.X / grid) + (int)MathF.Floor(cell.Z / grid)) % 2 != 0;
            children.Add(new(box, new RigidPose(cell with { Y = -.5f + (isHigh ? lip : 0) })));
        }
    }

    static void AddTriangles(List<ClusterChild> children, Shapes shapes, float grid)
    {
        foreach (var cell in Cells(grid))
        {
            var half = .5f * grid;
            Vector3 a = new(-half, 0, -half), b = new(half, 0, -half), c = new(-half, 0, half), d = new(half, 0, half);
            children.Add(new(shapes.Add(new Triangle(a, b, c)), new RigidPose(cell)));
            children.Add(new(shapes.Add(new Triangle(d, c, b)), new RigidPose(cell)));
        }
    }
}
