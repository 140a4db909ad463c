using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>A contact that shares the normal of its manifold.</summary>
public struct ConvexContact
{
    /// <inheritdoc cref="Contact.Offset"/>
    public Vector3 Offset;
    /// <inheritdoc cref="Contact.Depth"/>
    public float Depth;
    /// <inheritdoc cref="Contact.FeatureId"/>
    public int FeatureId;
}
