using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>A contact with its own normal.</summary>
public struct Contact
{
    /// <summary>Place of the contact relative to A's centre, in world axes, m; halfway between the two surfaces.</summary>
    public Vector3 Offset;
    /// <summary>Penetration along the normal, m; negative where the surfaces are apart.</summary>
    public float Depth;
    /// <summary>Unit normal in world axes, from B to A.</summary>
    public Vector3 Normal;
    /// <summary>Names the features that touch, to find the same contact again in the next step.</summary>
    public int FeatureId;
}
