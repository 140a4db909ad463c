using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Ground whose height is given at the points of a grid, two triangles to a cell. For statics; it may be edited while it is in use.</summary>
/// <remarks>
/// <para>Samples lie at (x * CellWidth, height, z * CellLength) of its own frame, from the origin on along +X and +Z; +Y is up, and the side from
/// which it is met. The triangles of cell (x, z) have the numbers 2 (z * CellCountX + x) and one more.</para>
/// <para>It takes 4 bytes for each sample, one for each cell where cells are given, and 1/8 byte more for the ranges of blocks of 8 by 8 cells.
/// There is no tree to be built: what a box meets is found from indices.</para>
/// <para>Copies of the struct look at the same memory. After <see cref="SetHeights"/> call <c>Statics.UpdateBounds</c> for statics that have it.</para>
/// </remarks>
public unsafe partial struct HeightField : IContainer, IDisposableShape
{
    /// <summary>Type id of height fields.</summary>
    public const int Id = 9;

    /// <summary>Least side of a cell, m.</summary>
    public const float MinimumCellSize = 1e-3f;
    /// <summary>Greatest ratio of the sides of a cell.</summary>
    public const float MaximumCellRatio = 100;
    /// <summary>Greatest difference of the heights of a cell's corners, in shorter sides of the cell: steeper triangles have no normal.</summary>
    public const float MaximumSteepness = 200;
    /// <summary>Greatest number of cells.</summary>
    public const int MaximumCellCount = 1 << 25;

    // Lowest and highest height of a block.
    struct Range
    {
        public float Min, Max;
    }

    // Ranges of blocks, heights and cells, in this order.
    Buffer<byte> memory;
    readonly int heightsStart, cellsStart;

    /// <summary>Number of samples along X, at least 2.</summary>
    public readonly int SampleCountX;
    /// <summary>Number of samples along Z, at least 2.</summary>
    public readonly int SampleCountZ;
    /// <summary>Distance of samples along X, m.</summary>
    public readonly float CellWidth;
    /// <summary>Distance of samples along Z, m.</summary>
    public readonly float CellLength;

    /// <summary>Takes memory for a field and copies heights and cells into it.</summary>
    /// <param name="sampleCountX">Number of samples along X, at least 2.</param>
    /// <param name="sampleCountZ">Number of samples along Z, at least 2.</param>
    /// <param name="cellWidth">Distance of samples along X, m.</param>
    /// <param name="cellLength">Distance of samples along Z, m.</param>
    /// <param name="heights">Height of each sample, m: sample (x, z) is number z * sampleCountX + x.</param>
    /// <param name="pool">Source of the memory, which <see cref="Dispose"/> returns to it.</param>
    /// <param name="cells">Cell (x, z) is number z * (sampleCountX - 1) + x; none where all are of material 0 and without a hole.</param>
    /// <exception cref="ArgumentException">A count, a size or a height is out of its range, which the message names; nothing was taken.</exception>
    public HeightField(int sampleCountX, int sampleCountZ, float cellWidth, float cellLength, ReadOnlySpan<float> heights, BufferPool pool,
        ReadOnlySpan<HeightFieldCell> cells = default)
    {
        ArgumentNullException.ThrowIfNull(pool);
        CheckGrid(sampleCountX, sampleCountZ, cellWidth, cellLength);
        (SampleCountX, SampleCountZ, CellWidth, CellLength) = (sampleCountX, sampleCountZ, cellWidth, cellLength);
        CheckLength(heights.Length, sampleCountX * sampleCountZ, nameof(heights), "samples");
        if (cells.Length != 0)
            CheckLength(cells.Length, CellCountX * CellCountZ, nameof(cells), "cells");
        CheckHeights(0, 0, sampleCountX, sampleCountZ, heights);
        heightsStart = Levels.BlockCount * sizeof(Range);
        cellsStart = heightsStart + heights.Length * sizeof(float);
        pool.Take(cellsStart + cells.Length, out memory);
        heights.CopyTo(new Span<float>(Heights, heights.Length));
        cells.CopyTo(new Span<HeightFieldCell>(Cells, cells.Length));
        HasCells = cells.Length != 0;
        UpdateRanges(0, 0, CellCountX, CellCountZ);
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <summary>Number of cells along X.</summary>
    public readonly int CellCountX => SampleCountX - 1;

    /// <summary>Number of cells along Z.</summary>
    public readonly int CellCountZ => SampleCountZ - 1;

    /// <summary>Number of triangles, holes included.</summary>
    public readonly int ChildCount => 2 * CellCountX * CellCountZ;

    /// <summary>Whether cells were given.</summary>
    public readonly bool HasCells { get; }

    /// <summary>Memory that the field owns, bytes.</summary>
    public readonly int ByteCount => memory.Length;

    readonly HeightFieldLevels Levels => new(CellCountX, CellCountZ);

    readonly Range* Ranges => (Range*)memory.Memory;

    readonly float* Heights => (float*)(memory.Memory + heightsStart);

    readonly HeightFieldCell* Cells => (HeightFieldCell*)(memory.Memory + cellsStart);

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new HeightFieldShapeBatch(pool, initialCapacity, shapes);

    /// <inheritdoc/>
    public readonly void Validate()
    {
        if (!memory.Allocated)
            throw new ArgumentException("A height field must be made by its constructor: this one has no samples, or was disposed.");
    }

    /// <inheritdoc/>
    public void Dispose(BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.ReturnIfTaken(ref memory);
        memory = default;
    }

    /// <summary>Height of a sample, m.</summary>
    /// <param name="x">Number of the sample along X.</param>
    /// <param name="z">Number of the sample along Z.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such sample.</exception>
    public readonly float GetHeight(int x, int z)
    {
        CheckRegion(x, z, 1, 1, SampleCountX, SampleCountZ);
        return Heights[z * SampleCountX + x];
    }

    /// <summary>A cell.</summary>
    /// <param name="x">Number of the cell along X.</param>
    /// <param name="z">Number of the cell along Z.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such cell.</exception>
    public readonly HeightFieldCell GetCell(int x, int z)
    {
        CheckRegion(x, z, 1, 1, CellCountX, CellCountZ);
        return HasCells ? Cells[z * CellCountX + x] : default;
    }

    /// <summary>Replaces the heights of a region.</summary>
    /// <remarks>What lies still on it sees the change after 16 steps at most, and what sleeps when it is woken.</remarks>
    /// <param name="x">First sample along X.</param>
    /// <param name="z">First sample along Z.</param>
    /// <param name="countX">Number of samples along X.</param>
    /// <param name="countZ">Number of samples along Z.</param>
    /// <param name="heights">Heights, m: sample (x + i, z + j) is number j * countX + i.</param>
    /// <exception cref="ArgumentException">The region is not in the field, or a height is out of its range; nothing was changed.</exception>
    public readonly void SetHeights(int x, int z, int countX, int countZ, ReadOnlySpan<float> heights)
    {
        Validate();
        CheckRegion(x, z, countX, countZ, SampleCountX, SampleCountZ);
        CheckLength(heights.Length, countX * countZ, nameof(heights), "samples");
        CheckHeights(x, z, countX, countZ, heights);
        for (int j = 0; j < countZ; ++j)
            heights.Slice(j * countX, countX).CopyTo(new Span<float>(Heights + (z + j) * SampleCountX + x, countX));
        UpdateRanges(x - 1, z - 1, x + countX, z + countZ);
    }

    /// <summary>Replaces a cell.</summary>
    /// <remarks>What lies still on it sees the change after 16 steps at most, and what sleeps when it is woken.</remarks>
    /// <param name="x">Number of the cell along X.</param>
    /// <param name="z">Number of the cell along Z.</param>
    /// <param name="cell">What it is to be.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such cell.</exception>
    /// <exception cref="InvalidOperationException">The field was made without cells.</exception>
    public readonly void SetCell(int x, int z, HeightFieldCell cell)
    {
        CheckRegion(x, z, 1, 1, CellCountX, CellCountZ);
        if (!HasCells)
            throw new InvalidOperationException("The height field was made without cells.");
        Cells[z * CellCountX + x] = cell;
    }

    /// <summary>A triangle in the frame of the field; that of a hole as if it were none.</summary>
    /// <param name="childIndex">Number of the triangle.</param>
    /// <param name="triangle">The triangle, its front up.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such triangle.</exception>
    public readonly void GetLocalChild(int childIndex, out Triangle triangle)
    {
        if ((uint)childIndex >= (uint)ChildCount)
            throw new ArgumentOutOfRangeException(nameof(childIndex), childIndex, $"A height field of {ChildCount} triangles has no such one.");
        Find(childIndex, out var x, out var z, out var isSecond);
        triangle = GetTriangle(x, z, isSecond, 0, 0, 0);
    }

    /// <summary>Box around the field when its frame is turned and at the origin: around the turned box of its samples.</summary>
    /// <param name="orientation">Rotation from the field's frame to the world; unit length.</param>
    /// <param name="min">Corner with the least coordinates.</param>
    /// <param name="max">Corner with the greatest coordinates.</param>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        GetLocalBounds(out var localMin, out var localMax);
        var center = (localMin + localMax) * .5f;
        var half = localMax - center;
        var axes = Matrix3x3.FromQuaternion(orientation);
        var place = Matrix3x3.TransposeTimes(axes, center);
        var extent = Vector3.Abs(axes.X) * half.X + Vector3.Abs(axes.Y) * half.Y + Vector3.Abs(axes.Z) * half.Z;
        min = place - extent;
        max = place + extent;
    }

    internal readonly float MaximumRadius
    {
        get
        {
            GetLocalBounds(out var min, out var max);
            return Exact.Length(Exact.Max(Vector3.Abs(min), Vector3.Abs(max)));
        }
    }

    readonly void GetLocalBounds(out Vector3 min, out Vector3 max)
    {
        min = new(0, Ranges[0].Min, 0);
        max = new(CellCountX * CellWidth, Ranges[0].Max, CellCountZ * CellLength);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void Find(int childIndex, out int x, out int z, out bool isSecond)
    {
        var cell = childIndex >> 1;
        z = cell / CellCountX;
        x = cell - z * CellCountX;
        isSecond = (childIndex & 1) != 0;
    }

    // About a place from which its corners are short distances, or about the field's origin, where corners that triangles share are the same floats.
    readonly Triangle GetTriangle(int x, int z, bool isSecond, float fromX, float fromHeight, float fromZ)
    {
        Check.That((uint)x < (uint)CellCountX && (uint)z < (uint)CellCountZ);
        var heights = Heights + z * SampleCountX + x;
        float near = x * CellWidth - fromX, far = (x + 1) * CellWidth - fromX;
        float front = z * CellLength - fromZ, back = (z + 1) * CellLength - fromZ;
        var nearFront = new Vector3(near, heights[0] - fromHeight, front);
        var farFront = new Vector3(far, heights[1] - fromHeight, front);
        var nearBack = new Vector3(near, heights[SampleCountX] - fromHeight, back);
        var farBack = new Vector3(far, heights[SampleCountX + 1] - fromHeight, back);
        if (HasCells && Cells[z * CellCountX + x].HasRisingDiagonal)
            return isSecond ? new(farBack, nearBack, nearFront) : new(nearFront, farFront, farBack);
        return isSecond ? new(farBack, nearBack, farFront) : new(nearFront, farFront, nearBack);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly bool IsHole(int x, int z) => HasCells && Cells[z * CellCountX + x].IsHole;
}
