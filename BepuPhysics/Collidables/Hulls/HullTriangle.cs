using System.Runtime.CompilerServices;

namespace BepuPhysics.Collidables;

/// <summary>A triangle of a hull that is being built. Edge i goes from corner i to the next one.</summary>
unsafe struct HullTriangle
{
    /// <summary>Points at the corners, counterclockwise seen from outside.</summary>
    public fixed int Corners[3];
    /// <summary>Triangle across each edge.</summary>
    public fixed int Neighbors[3];
    /// <summary>Normal, twice the area long.</summary>
    public HullPoint Normal;
    /// <summary>Reciprocal of the normal's length.</summary>
    public double InverseLength;
    /// <summary>Height over the plane, in units of the normal's length, below which the sign needs to be computed exactly.</summary>
    public double Uncertainty;
    /// <summary>First of the points that were above this triangle when it was made; -1 for none.</summary>
    public int FirstOutside;
    /// <summary>Height of the farthest of them over the plane, in units of the normal's length.</summary>
    public double GreatestHeight;
    /// <summary>The insertion that last asked whether its point sees the triangle.</summary>
    public int Stamp;
    /// <summary>The answer.</summary>
    public bool Visible;
    /// <summary>Whether the triangle is not, or no longer, part of the hull.</summary>
    public bool Dead;

    /// <summary>Edge that leads to a neighbor.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int EdgeTo(int neighbor) => Neighbors[0] == neighbor ? 0 : Neighbors[1] == neighbor ? 1 : 2;

    /// <summary>The edge after an edge.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Next(int edge) => edge == 2 ? 0 : edge + 1;

    /// <summary>The edge before an edge.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int Previous(int edge) => edge == 0 ? 2 : edge - 1;
}
