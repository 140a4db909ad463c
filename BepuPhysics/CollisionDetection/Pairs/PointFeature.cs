using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The farthest point of a shape that has neither faces nor edges, such as an ellipsoid: it touches at one point.</summary>
/// <typeparam name="TShapeWide">Wide form of the shape.</typeparam>
/// <typeparam name="TSupport">Farthest points of the shape.</typeparam>
public readonly struct PointFeature<TShapeWide, TSupport> : IContactFeature<TShapeWide>
    where TShapeWide : unmanaged where TSupport : unmanaged, ISupport<TShapeWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => 1;

    /// <inheritdoc/>
    public static bool IsRound => true;

    /// <inheritdoc/>
    public static bool IsCurved => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Find(in TShapeWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices, out ContactFeatureWide feature)
    {
        vertices = TSupport.Support(shape, direction, done);
        TSupport.GetExtents(shape, out var center, out _, out var outer);
        feature.VertexCount = Vector<int>.One;
        feature.PlaneNormal = direction;
        feature.Id = Vector<int>.Zero;
        feature.Margin = TSupport.Margin(shape);
        feature.Roundness = Vector<float>.Zero;
        feature.Size = center.Length() + outer + feature.Margin;
    }
}
