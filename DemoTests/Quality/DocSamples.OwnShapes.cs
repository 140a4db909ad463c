using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

// Docs/Guides/OwnShapes.md.
static partial class DocSamples
{
    /// <summary>A grid of cubes, of which it keeps nothing but which of them are there.</summary>
    public struct Voxels(int width, int height, int length, float size, Vector3 corner, BufferPool pool) : IHomogeneousCompoundShape<Box, BoxWide>
    {
        // Cubes beyond which nothing is lost to rounding.
        const float Slack = 1e-3f;

        /// <summary>Whether there is a cube, by its number: the place along X, then along Y, then along Z.</summary>
        public Buffer<bool> Cells = Take(width * height * length, pool);
        public readonly int Width = width, Height = height, Length = length;
        /// <summary>Edge of a cube, m.</summary>
        public readonly float Size = size;
        /// <summary>Corner of the grid with the least coordinates; the origin is the centre of mass.</summary>
        public Vector3 Corner = corner;

        static Buffer<bool> Take(int count, BufferPool pool)
        {
            pool.Take(count, out Buffer<bool> cells);
            cells.Clear(0, count);
            return cells;
        }

        public static int TypeId => 20;

        public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
            new HomogeneousCompoundShapeBatch<Voxels, Box, BoxWide>(pool, initialCapacity);

        public readonly int ChildCount => Cells.Length;

        public readonly ref bool this[int x, int y, int z] => ref Cells[x + Width * (y + Height * z)];

        public readonly void Validate()
        {
            if (!Cells.Allocated || !(Size > 0))
                throw new ArgumentException($"Voxels need cells and a size, which is {Size} m.");
        }

        public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max)
        {
            var grid = new Vector3(Width, Height, Length) * Size;
            new Box(grid.X, grid.Y, grid.Z).ComputeBounds(orientation, out min, out max);
            var center = Exact.Rotate(Corner + grid * .5f, orientation);
            min += center;
            max += center;
        }

        public readonly void GetPosedLocalChild(int childIndex, out Box childShape, out RigidPose childPose)
        {
            var (x, y, z) = (childIndex % Width, childIndex / Width % Height, childIndex / (Width * Height));
            childShape = new Box(Size, Size, Size);
            childPose = new RigidPose(Corner + (new Vector3(x, y, z) + new Vector3(.5f)) * Size);
        }

        public readonly void FindLocalOverlaps(Vector3 min, Vector3 max, ref QuickList<int> overlaps, BufferPool pool)
        {
            var (first, last) = ((min - Corner) / Size - new Vector3(Slack), (max - Corner) / Size + new Vector3(Slack));
            var (left, right) = (First(first.X, Width), Last(last.X, Width));
            for (int z = First(first.Z, Length); z <= Last(last.Z, Length); ++z)
            {
                for (int y = First(first.Y, Height); y <= Last(last.Y, Height); ++y)
                {
                    for (int x = left; x <= right; ++x)
                    {
                        if (this[x, y, z])
                            overlaps.Add(x + Width * (y + Height * z), pool);
                    }
                }
            }
        }

        static int First(float place, int count) => (int)Math.Clamp(MathF.Floor(place), 0, count);

        static int Last(float place, int count) => (int)Math.Clamp(MathF.Floor(place), -1, count - 1);

        public readonly void RayTest<TRayHitHandler>(
            in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
            where TRayHitHandler : struct, IShapeRayHitHandler =>
            HomogeneousCompound.RayTest<Voxels, Box, BoxWide, TRayHitHandler>(this, pose, ray, ref maximumT, pool, ref hitHandler);

        public void Dispose(BufferPool pool) => pool.Return(ref Cells);
    }

    public static StaticHandle AddLand(Simulation simulation, BufferPool pool)
    {
        simulation.NarrowPhase.CollisionTaskRegistry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>();
        var land = new Voxels(64, 16, 64, 1, new Vector3(-32, -16, -32), pool);
        for (int x = 0; x < land.Width; ++x)
        {
            for (int z = 0; z < land.Length; ++z)
            {
                for (int y = 0; y < 10 + (x / 8 + z / 8) % 2; ++y)
                    land[x, y, z] = true;
            }
        }
        return simulation.Statics.Add(new StaticDescription(RigidPose.Identity, simulation.Shapes.Add(land)));
    }

    public static BodyHandle AddRock(Simulation simulation, BufferPool pool, Vector3 place)
    {
        var rock = new Voxels(3, 2, 2, .5f, default, pool);
        for (int i = 0; i < rock.ChildCount; ++i)
            rock.Cells[i] = i != 4;
        var inertia = HomogeneousCompound.ComputeInertia<Voxels, Box, BoxWide>(rock, 2, pool, out var center);
        rock.Corner -= center;
        return simulation.Bodies.Add(BodyDescription.CreateDynamic(place, inertia, simulation.Shapes.Add(rock), .01f));
    }

    public static void Dig(Simulation simulation, BufferPool pool, StaticHandle land, int x, int y, int z)
    {
        ref var voxels = ref simulation.Shapes.GetShape<Voxels>(simulation.Statics[land].Shape.Index);
        voxels[x, y, z] = false;
        // What sleeps on it wakes up.
        simulation.Statics.ApplyDescription(land, simulation.Statics.GetDescription(land));
    }
}
