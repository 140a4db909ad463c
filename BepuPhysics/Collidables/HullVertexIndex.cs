using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Place of a vertex of a convex hull: which bundle, and which lane of it.</summary>
public struct HullVertexIndex
{
    /// <summary>Index of the bundle in <see cref="ConvexHull.Points"/>.</summary>
    public ushort BundleIndex;
    /// <summary>Lane within the bundle.</summary>
    public ushort InnerIndex;

    /// <summary>The place of a vertex by its number.</summary>
    /// <param name="vertex">Number of the vertex.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static HullVertexIndex FromNumber(int vertex) => new()
    {
        BundleIndex = (ushort)(vertex >> BundleIndexing.VectorShift),
        InnerIndex = (ushort)(vertex & BundleIndexing.VectorMask),
    };

    /// <summary>Number of the vertex: the same for every width of vectors.</summary>
    public readonly int Number
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => BundleIndex * Vector<float>.Count + InnerIndex;
    }

    /// <inheritdoc/>
    public override readonly string ToString() => $"({BundleIndex}, {InnerIndex})";
}
