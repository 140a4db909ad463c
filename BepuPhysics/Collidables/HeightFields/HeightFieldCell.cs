namespace BepuPhysics.Collidables;

/// <summary>What a cell of a <see cref="HeightField"/> is besides the heights of its corners: one byte.</summary>
/// <param name="material">Number of a game's material, 0 to 63.</param>
/// <param name="isHole">Whether the cell has no triangles.</param>
/// <param name="risingDiagonal">Whether its triangles meet along the diagonal from its least corner to its greatest, and not along the other.</param>
public readonly struct HeightFieldCell(int material, bool isHole = false, bool risingDiagonal = false)
{
    const int HoleBit = 64, DiagonalBit = 128;

    /// <summary>Number of materials that there can be.</summary>
    public const int MaterialCount = 64;

    readonly byte bits = (byte)(material & MaterialCount - 1 | (isHole ? HoleBit : 0) | (risingDiagonal ? DiagonalBit : 0));

    /// <summary>Number of a game's material.</summary>
    public int Material => bits & MaterialCount - 1;

    /// <summary>Whether the cell has no triangles.</summary>
    public bool IsHole => (bits & HoleBit) != 0;

    /// <summary>Whether its triangles meet along the diagonal from its least corner to its greatest.</summary>
    public bool HasRisingDiagonal => (bits & DiagonalBit) != 0;
}
