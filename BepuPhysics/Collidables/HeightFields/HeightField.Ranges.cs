using System;
using BepuUtilities;

namespace BepuPhysics.Collidables;

// What a field may be made of, and how high its blocks are.
public unsafe partial struct HeightField
{
    static void CheckGrid(int sampleCountX, int sampleCountZ, float cellWidth, float cellLength)
    {
        CheckCount(sampleCountX, nameof(sampleCountX));
        CheckCount(sampleCountZ, nameof(sampleCountZ));
        if ((sampleCountX - 1L) * (sampleCountZ - 1L) > MaximumCellCount)
            throw new ArgumentException($"A height field has at most {MaximumCellCount} cells, not {sampleCountX - 1} by {sampleCountZ - 1}.");
        CheckSide(cellWidth, sampleCountX - 1, nameof(cellWidth));
        CheckSide(cellLength, sampleCountZ - 1, nameof(cellLength));
        if (MathHelper.Max(cellWidth, cellLength) > MaximumCellRatio * MathHelper.Min(cellWidth, cellLength))
            throw new ArgumentException($"The sides of a cell, {cellWidth} and {cellLength} m, differ by a factor of more than {MaximumCellRatio}.");
    }

    static void CheckCount(int count, string name)
    {
        if (count < 2)
            throw new ArgumentOutOfRangeException(name, count, "A height field has at least two samples along each side.");
    }

    static void CheckSide(float side, int count, string name)
    {
        if (!(side >= MinimumCellSize && side * count <= ShapeLimits.MaximumSize))
        {
            throw new ArgumentOutOfRangeException(
                name, side, $"A cell has sides of at least {MinimumCellSize} m, and all together at most {ShapeLimits.MaximumSize} m.");
        }
    }

    static void CheckLength(int length, int expected, string name, string what)
    {
        if (length != expected)
            throw new ArgumentException($"There are {expected} {what}, and {length} values for them.", name);
    }

    static void CheckRegion(int x, int z, int countX, int countZ, int limitX, int limitZ)
    {
        CheckInterval(x, countX, limitX, nameof(x));
        CheckInterval(z, countZ, limitZ, nameof(z));
    }

    static void CheckInterval(int start, int count, int limit, string name)
    {
        if (start < 0 || count < 0 || start > limit - count)
            throw new ArgumentOutOfRangeException(name, start, $"There are {limit}; {count} from {start} on are not among them.");
    }

    // Heights of a region that are about to be written: each must be a number, and no cell that they belong to too steep.
    readonly void CheckHeights(int x, int z, int countX, int countZ, ReadOnlySpan<float> heights)
    {
        for (int i = 0; i < heights.Length; ++i)
        {
            if (!(MathF.Abs(heights[i]) <= ShapeLimits.MaximumSize))
            {
                throw new ArgumentOutOfRangeException(nameof(heights), heights[i],
                    $"The height of sample ({x + i % countX}, {z + i / countX}) must be from {-ShapeLimits.MaximumSize} to {ShapeLimits.MaximumSize} m.");
            }
        }
        if (heights.Length == 0)
            return;
        var limit = MaximumSteepness * MathHelper.Min(CellWidth, CellLength);
        for (int j = Math.Max(0, z - 1); j < Math.Min(CellCountZ, z + countZ); ++j)
        {
            for (int i = Math.Max(0, x - 1); i < Math.Min(CellCountX, x + countX); ++i)
            {
                var range = new Range { Min = float.MaxValue, Max = float.MinValue };
                for (int corner = 0; corner < 4; ++corner)
                {
                    int sampleX = i + (corner & 1), sampleZ = j + (corner >> 1);
                    var isChanged = sampleX >= x && sampleX < x + countX && sampleZ >= z && sampleZ < z + countZ;
                    var height = isChanged ? heights[(sampleZ - z) * countX + sampleX - x] : Heights[sampleZ * SampleCountX + sampleX];
                    Add(ref range, height, height);
                }
                if (range.Max - range.Min > limit)
                {
                    throw new ArgumentException($"The heights of the corners of cell ({i}, {j}) differ by {range.Max - range.Min} m; " +
                        $"those of cells of this size by at most {limit} m.", nameof(heights));
                }
            }
        }
    }

    /// <summary>Measures the blocks that hold cells of a region anew, and what is above them.</summary>
    readonly void UpdateRanges(int firstX, int firstZ, int endX, int endZ)
    {
        var levels = Levels;
        firstX = Math.Max(0, firstX) / HeightFieldLevels.BlockSize;
        firstZ = Math.Max(0, firstZ) / HeightFieldLevels.BlockSize;
        var lastX = (Math.Min(CellCountX, endX) - 1) / HeightFieldLevels.BlockSize;
        var lastZ = (Math.Min(CellCountZ, endZ) - 1) / HeightFieldLevels.BlockSize;
        for (int level = 0; level < levels.Count; ++level)
        {
            var ranges = Ranges + levels.StartOf(level);
            for (int z = firstZ; z <= lastZ; ++z)
            {
                for (int x = firstX; x <= lastX; ++x)
                    ranges[z * levels.WidthOf(level) + x] = level == 0 ? MeasureCells(x, z) : MeasureBlocks(levels, level - 1, x, z);
            }
            (firstX, firstZ, lastX, lastZ) = (firstX / 2, firstZ / 2, lastX / 2, lastZ / 2);
        }
    }

    readonly Range MeasureCells(int blockX, int blockZ)
    {
        const int Size = HeightFieldLevels.BlockSize;
        var range = new Range { Min = float.MaxValue, Max = float.MinValue };
        for (int z = blockZ * Size; z <= Math.Min(CellCountZ, (blockZ + 1) * Size); ++z)
        {
            for (int x = blockX * Size; x <= Math.Min(CellCountX, (blockX + 1) * Size); ++x)
                Add(ref range, Heights[z * SampleCountX + x], Heights[z * SampleCountX + x]);
        }
        return range;
    }

    readonly Range MeasureBlocks(in HeightFieldLevels levels, int level, int blockX, int blockZ)
    {
        var width = levels.WidthOf(level);
        var below = Ranges + levels.StartOf(level);
        var range = new Range { Min = float.MaxValue, Max = float.MinValue };
        for (int z = 2 * blockZ; z < Math.Min(levels.LengthOf(level), 2 * blockZ + 2); ++z)
        {
            for (int x = 2 * blockX; x < Math.Min(width, 2 * blockX + 2); ++x)
                Add(ref range, below[z * width + x].Min, below[z * width + x].Max);
        }
        return range;
    }

    static void Add(ref Range range, float min, float max)
    {
        range.Min = MathHelper.Min(range.Min, min);
        range.Max = MathHelper.Max(range.Max, max);
    }
}
