using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
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

    public static BodyHandle AddCone(Simulation simulation, Vector3 place)
    {
        simulation.NarrowPhase.CollisionTaskRegistry.RegisterConvex<Cone, ConeWide, ConeSupport, ConeFeature>();
        var cone = new Cone(.4f, 1);
        return simulation.Bodies.Add(BodyDescription.CreateDynamic(place, cone.ComputeInertia(1), simulation.Shapes.Add(cone), .01f));
    }
}

/// <summary>A cone around the Y axis, whose tip is up. Its centre of mass is a quarter of its height above the base.</summary>
public struct Cone(float radius, float height) : IConvexShape
{
    public float Radius = radius, Height = height;

    public static int TypeId => 21;

    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new SupportShapeBatch<Cone, ConeWide, ConeSupport>(pool, initialCapacity);

    public readonly void Validate()
    {
        if (!(Radius > 0 && Radius < 1e6f && Height > 0 && Height < 1e6f))
            throw new ArgumentException($"A cone of radius {Radius} m and height {Height} m cannot be simulated.");
    }

    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        var across = (4 * Radius * Radius + Height * Height) * (3f / 80);
        var around = Radius * Radius * (3f / 10);
        var inertia = new BodyInertia { InverseMass = 1 / mass };
        inertia.InverseInertiaTensor.XX = inertia.InverseInertiaTensor.ZZ = inertia.InverseMass / across;
        inertia.InverseInertiaTensor.YY = inertia.InverseMass / around;
        return inertia;
    }

    readonly ConeWide Wide => Lanes.Broadcast<Cone, ConeWide>(this);

    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max) =>
        ConvexSupport<ConeWide, ConeSupport>.GetBounds(Wide, orientation, out min, out max);

    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion) =>
        ConvexSupport<ConeWide, ConeSupport>.ComputeAngularExpansionData(Wide, out maximumRadius, out maximumAngularExpansion);

    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        ConvexSupport<ConeWide, ConeSupport>.RayTest(Wide, pose, origin, direction, out t, out normal);
}

/// <summary>As many cones as a vector has lanes: the same fields in the same order.</summary>
public struct ConeWide : IShapeWide<Cone>
{
    public Vector<float> Radius, Height;

    public readonly Vector<float> Base => Height * new Vector<float>(-.25f);

    public readonly Vector<float> Tip => Height * new Vector<float>(.75f);

    public readonly void GetBounds(in QuaternionWide orientation, out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion,
        out Vector3Wide min, out Vector3Wide max) =>
        ConvexSupport<ConeWide, ConeSupport>.GetBounds(this, orientation, out maximumRadius, out maximumAngularExpansion, out min, out max);

    public readonly void RayTest(in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal) =>
        ConvexSupport<ConeWide, ConeSupport>.RayTest(this, pose, ray, out hitMask, out t, out normal);
}

/// <summary>The farthest point of a cone is its tip, or on the rim of its base.</summary>
public struct ConeSupport : ISupport<ConeWide>
{
    public static Vector<float> Margin(in ConeWide shape) => Vector<float>.Zero;

    public static void GetExtents(in ConeWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer)
    {
        center = Vector3Wide.Zero;
        var side = Vector.SquareRoot(shape.Radius * shape.Radius + shape.Height * shape.Height);
        inner = Wide.Min(-shape.Base, shape.Tip * shape.Radius / side) * new Vector<float>(.999f);
        outer = Wide.Max(shape.Tip, Vector.SquareRoot(shape.Radius * shape.Radius + shape.Base * shape.Base)) * new Vector<float>(1.001f);
    }

    public static Vector3Wide Support(in ConeWide shape, in Vector3Wide direction, Vector<int> doneMask)
    {
        var across = Vector.SquareRoot(direction.X * direction.X + direction.Z * direction.Z);
        var isTip = Vector.GreaterThan(direction.Y * shape.Height, across * shape.Radius);
        var toRim = Wide.DivideOrZero(shape.Radius, across);
        return new(
            Wide.Select(isTip, Vector<float>.Zero, direction.X * toRim), Wide.Select(isTip, shape.Tip, shape.Base),
            Wide.Select(isTip, Vector<float>.Zero, direction.Z * toRim));
    }
}

/// <summary>What of a cone touches: its base as a disc, or the line of its side that faces the direction.</summary>
public struct ConeFeature : IContactFeature<ConeWide>
{
    public static int MaximumVertexCount => 16;

    public static bool IsRound => true;

    public static bool IsDisc => true;

    public static Vector<float> DiscRadius(in ConeWide shape) => shape.Radius;

    public static void Find(in ConeWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices, out ContactFeatureWide feature)
    {
        var zero = Vector<float>.Zero;
        var across = Vector.SquareRoot(direction.X * direction.X + direction.Z * direction.Z);
        var away = Vector.Equals(across, zero);
        var (x, z) = (Wide.Select(away, Vector<float>.One, direction.X / across), Wide.Select(away, zero, direction.Z / across));
        // Of the normals of the two, the one that is nearer to the direction.
        var side = Vector.SquareRoot(shape.Radius * shape.Radius + shape.Height * shape.Height);
        var alongSide = (across * shape.Height + direction.Y * shape.Radius) / side;
        var isBase = Vector.GreaterThan(-direction.Y, alongSide);
        vertices = new(Wide.Select(isBase, zero, x * shape.Radius), shape.Base, Wide.Select(isBase, zero, z * shape.Radius));
        Unsafe.Add(ref vertices, 1) = new(zero, shape.Tip, zero);
        feature.VertexCount = Wide.Select(isBase, new Vector<int>(MaximumVertexCount), new Vector<int>(2));
        feature.PlaneNormal = new(
            Wide.Select(isBase, zero, x * shape.Height), Wide.Select(isBase, -side, shape.Radius), Wide.Select(isBase, zero, z * shape.Height));
        feature.Id = isBase & Vector<int>.One;
        feature.Margin = zero;
        feature.Roundness = zero;
        feature.Size = Wide.Max(shape.Tip, side);
    }
}
