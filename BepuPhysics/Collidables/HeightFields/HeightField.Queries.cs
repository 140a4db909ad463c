using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// What a box or a ray meets.
public unsafe partial struct HeightField
{
    // Two triangles of each cell of a block.
    const int TrianglesPerBlock = 2 * HeightFieldLevels.BlockSize * HeightFieldLevels.BlockSize;
    // Part of the distances of a ray by which boxes are wider: a ray that is turned to the field's frame is rounded, and so is one in a triangle's test.
    const float RayRounding = 2e-6f;

    readonly int IContainer.FanOut(int node, Shapes shapes) => TrianglesPerBlock;

    readonly void IContainer.GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child)
    {
        Find(index, out var x, out var z, out var isSecond);
        var center = new Vector3(x * CellWidth, Heights[z * SampleCountX + x], z * CellLength);
        ref var triangle = ref *(Triangle*)scratch;
        triangle = GetTriangle(x, z, isSecond, center.X, center.Y, center.Z);
        child = new() { TypeId = Triangle.Id, Shape = scratch, Pose = new(center), Cone = GetCone(x, z, isSecond, triangle, center) };
    }

    static bool IContainer.IsList => false;

    static bool IContainer.IsSurface => true;

    static bool IContainer.TakesOutlines => true;

    // In the order of their numbers.
    readonly void IContainer.FindOverlaps(
        Vector3 min, Vector3 max, in ShapeOutline outline, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool)
    {
        var (firstX, lastX) = FindCells(min.X, max.X, CellWidth, CellCountX);
        var (firstZ, lastZ) = FindCells(min.Z, max.Z, CellLength, CellCountZ);
        if (firstX > lastX || firstZ > lastZ || min.Y > Ranges[0].Max || max.Y < Ranges[0].Min)
            return;
        var first = found.Count;
        var levels = Levels;
        var blocks = Ranges + levels.StartOf(0);
        for (int z = firstZ; z <= lastZ; ++z)
        {
            var row = blocks + z / HeightFieldLevels.BlockSize * levels.WidthOf(0);
            for (int x = firstX; x <= lastX; ++x)
            {
                // A row of cells of a block that is too high or too low is left out at once.
                var block = row + x / HeightFieldLevels.BlockSize;
                if (min.Y > block->Max || max.Y < block->Min)
                    x |= HeightFieldLevels.BlockSize - 1;
                else
                    AddCell(x, z, min.Y, max.Y, ref found, pool);
            }
        }
        if (outline.IsKnown)
            LeaveOut(outline, ref found, first);
    }

    // Those that a shape is beside or in front of.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void LeaveOut(in ShapeOutline outline, ref QuickList<int> found, int first)
    {
        var sides = new OutlineSides(outline, isMirrored: false);
        var children = found.Span.Memory;
        var count = first;
        for (int i = first; i < found.Count; ++i)
        {
            Find(children[i], out var x, out var z, out var isSecond);
            var triangle = GetTriangle(x, z, isSecond, 0, 0, 0);
            var (a, b, c) = (triangle.A, triangle.B, triangle.C);
            var side = sides.Find(
                new(Vector128.Create(a.X, b.X, c.X, a.X), Vector128.Create(a.Y, b.Y, c.Y, a.Y), Vector128.Create(a.Z, b.Z, c.Z, a.Z)), out _);
            children[count] = children[i];
            count += side == OutlineSide.IsApart ? 0 : 1;
        }
        found.Count = count;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void AddCell(int x, int z, float min, float max, ref QuickList<int> found, BufferPool pool)
    {
        if (IsHole(x, z))
            return;
        var child = 2 * (z * CellCountX + x);
        GetHeights(x, z, isSecond: false, out var lowest, out var highest);
        if (min <= highest && max >= lowest)
            found.Add(child, pool);
        GetHeights(x, z, isSecond: true, out lowest, out highest);
        if (min <= highest && max >= lowest)
            found.Add(child + 1, pool);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void GetHeights(int x, int z, bool isSecond, out float lowest, out float highest)
    {
        var heights = Heights + z * SampleCountX + x;
        var rises = HasCells && Cells[z * CellCountX + x].HasRisingDiagonal;
        // Of the diagonal, and of the corner beside it.
        var first = heights[rises ? 0 : 1];
        var second = heights[rises ? SampleCountX + 1 : SampleCountX];
        var third = heights[rises ? (isSecond ? SampleCountX : 1) : isSecond ? SampleCountX + 1 : 0];
        lowest = MathHelper.Min(first, MathHelper.Min(second, third));
        highest = MathHelper.Max(first, MathHelper.Max(second, third));
    }

    /// <summary>The cells whose interval overlaps or touches another; the first is beyond the last where there is none.</summary>
    // A quotient is rounded, so that it is a guess, and the borders of cells themselves are asked.
    static (int First, int Last) FindCells(float min, float max, float side, int count)
    {
        var first = Guess(min, side, count);
        var last = Guess(max, side, count);
        first -= first > 0 && first * side >= min ? 1 : 0;
        first += (first + 1) * side < min ? 1 : 0;
        last += last < count - 1 && (last + 1) * side <= max ? 1 : 0;
        last -= last * side > max ? 1 : 0;
        return (first, last);
    }

    static int Guess(float place, float side, int count) => (int)MathHelper.Max(0, MathHelper.Min(count - 1, place / side));

    readonly int IContainer.Open(int node, Shapes shapes, NodeChild* below)
    {
        var levels = Levels;
        levels.Find(node, out var level, out var x, out var z);
        return level == 0 ? OpenCells(x, z, below) : OpenBlocks(levels, level - 1, x, z, below);
    }

    readonly int OpenCells(int blockX, int blockZ, NodeChild* below)
    {
        const int Size = HeightFieldLevels.BlockSize;
        var count = 0;
        for (int z = blockZ * Size; z < Math.Min(CellCountZ, (blockZ + 1) * Size); ++z)
        {
            for (int x = blockX * Size; x < Math.Min(CellCountX, (blockX + 1) * Size); ++x)
            {
                for (int i = 0; i < 2 && !IsHole(x, z); ++i)
                {
                    GetHeights(x, z, isSecond: i != 0, out var lowest, out var highest);
                    below[count++] = Box(x, z, 1, lowest, highest, ~(2 * (z * CellCountX + x) + i), 1);
                }
            }
        }
        return count;
    }

    readonly int OpenBlocks(in HeightFieldLevels levels, int level, int blockX, int blockZ, NodeChild* below)
    {
        var start = levels.StartOf(level);
        var width = levels.WidthOf(level);
        var size = HeightFieldLevels.BlockSize << level;
        var count = 0;
        for (int z = 2 * blockZ; z < Math.Min(levels.LengthOf(level), 2 * blockZ + 2); ++z)
        {
            for (int x = 2 * blockX; x < Math.Min(width, 2 * blockX + 2); ++x)
            {
                var block = start + z * width + x;
                below[count++] = Box(x * size, z * size, size, Ranges[block].Min, Ranges[block].Max, block, 2 * size * size);
            }
        }
        return count;
    }

    readonly NodeChild Box(int x, int z, int size, float lowest, float highest, int index, int leafCount) => new()
    {
        Min = new(x * CellWidth, lowest, z * CellLength),
        Max = new(Math.Min(CellCountX, x + size) * CellWidth, highest, Math.Min(CellCountZ, z + size) * CellLength),
        Index = index,
        LeafCount = leafCount,
    };

    /// <summary>Tests a ray and reports each triangle that it meets from the front, nearer blocks first.</summary>
    /// <param name="pose">Pose of the field.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="pool">Source of temporary memory.</param>
    /// <param name="hitHandler">Receives the hits, with the numbers of triangles as children.</param>
    public readonly void RayTest<TRayHitHandler>(in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
        where TRayHitHandler : struct, IShapeRayHitHandler
    {
        var inverse = Exact.Conjugate(pose.Orientation);
        var origin = Exact.Rotate(ray.Origin - pose.Position, inverse);
        var slack = new Vector3(RayRounding * (Exact.Length(origin) + MaximumRadius));
        var slabs = new SlabTest(origin - slack, origin + slack, Exact.Rotate(ray.Direction, inverse));
        var stack = new QuickList<NodeChild>(TrianglesPerBlock, pool);
        pool.TakeAtLeast<NodeChild>(TrianglesPerBlock, out var below);
        try
        {
            stack.AddUnsafely(new NodeChild());
            while (stack.Count > 0)
            {
                var node = stack.Pop();
                // What was met since may have made it too far away.
                if (node.Min.X > maximumT)
                    continue;
                if (node.Index < 0)
                    TestTriangle(~node.Index, pose, ray, ref maximumT, ref hitHandler);
                else
                    PushBelow(node.Index, slabs, maximumT, below, ref stack, pool);
            }
        }
        finally
        {
            pool.Return(ref below);
            stack.Dispose(pool);
        }
    }

    // The nearest on top; of equally near ones that which was written first. The box of what waits is not needed any more, only when it is met.
    readonly void PushBelow(int node, in SlabTest slabs, float maximumT, Buffer<NodeChild> below, ref QuickList<NodeChild> stack, BufferPool pool)
    {
        var count = ((IContainer)this).Open(node, null!, below.Memory);
        var start = stack.Count;
        for (int i = count - 1; i >= 0; --i)
        {
            if (!slabs.Meets(below.Memory + i, maximumT, out var t))
                continue;
            var place = stack.Count;
            stack.Add(default, pool);
            for (; place > start && stack[place - 1].Min.X < t; --place)
                stack[place] = stack[place - 1];
            stack[place] = new() { Index = below[i].Index, Min = new(t, 0, 0) };
        }
    }

    readonly void TestTriangle<TRayHitHandler>(int child, in RigidPose pose, in RayData ray, ref float maximumT, ref TRayHitHandler hitHandler)
        where TRayHitHandler : struct, IShapeRayHitHandler
    {
        if (!hitHandler.AllowTest(child))
            return;
        Find(child, out var x, out var z, out var isSecond);
        if (GetTriangle(x, z, isSecond, 0, 0, 0).RayTest(pose, ray.Origin, ray.Direction, out var t, out var normal) && t <= maximumT)
            hitHandler.OnRayHit(ray, ref maximumT, t, normal, child);
    }
}
