using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The centre of a sphere.</summary>
public readonly struct SphereFeature : IContactFeature<SphereWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => 1;

    /// <inheritdoc/>
    public static bool IsRound => true;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Find(in SphereWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        vertices = Vector3Wide.Zero;
        feature.VertexCount = Vector<int>.One;
        feature.PlaneNormal = direction;
        feature.Id = Vector<int>.Zero;
        feature.Margin = shape.Radius;
        feature.Roundness = Vector<float>.Zero;
        feature.Size = shape.Radius;
    }
}
