using System.Numerics;

namespace BepuPhysics.Collidables;

/// <summary>The blocks of a height field: of 8 by 8 cells on level 0, and of 2 by 2 blocks of the level below on every other.</summary>
/// <remarks>They are numbered from the top, where there is one, down: number 0 is the root of a tree whose nodes need not be stored.</remarks>
readonly struct HeightFieldLevels(int cellsX, int cellsZ)
{
    const int BlockShift = 3;

    /// <summary>Cells along each side of a block of level 0.</summary>
    public const int BlockSize = 1 << BlockShift;

    /// <summary>Number of levels.</summary>
    public int Count { get; } = CountLevels(cellsX > cellsZ ? cellsX : cellsZ);

    static int CountLevels(int cells) => 1 + BitOperations.Log2((uint)((cells - 1 >> BlockShift) | 1)) + (cells > BlockSize ? 1 : 0);

    /// <summary>Number of blocks of a level along X.</summary>
    public int WidthOf(int level) => (cellsX - 1 >> BlockShift + level) + 1;

    /// <summary>Number of blocks of a level along Z.</summary>
    public int LengthOf(int level) => (cellsZ - 1 >> BlockShift + level) + 1;

    /// <summary>Number of the first block of a level.</summary>
    public int StartOf(int level)
    {
        var start = 0;
        for (int i = Count - 1; i > level; --i)
            start += WidthOf(i) * LengthOf(i);
        return start;
    }

    /// <summary>Number of all blocks.</summary>
    public int BlockCount => StartOf(-1);

    /// <summary>Level and place of a block.</summary>
    public void Find(int block, out int level, out int x, out int z)
    {
        for (level = Count - 1; block >= WidthOf(level) * LengthOf(level); --level)
            block -= WidthOf(level) * LengthOf(level);
        x = block % WidthOf(level);
        z = block / WidthOf(level);
    }
}
