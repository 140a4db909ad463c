using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The plane of a half-space.</summary>
public readonly struct HalfSpaceFeature : IContactFeature<HalfSpaceWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => 1;

    /// <inheritdoc/>
    public static bool IsPlane => true;

    /// <inheritdoc/>
    public static void Find(in HalfSpaceWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        vertices = Vector3Wide.Zero;
        feature = default;
        feature.PlaneNormal = shape.Normal;
    }
}
