using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>One contact of each pair of a bundle.</summary>
public struct ContactWide
{
    /// <summary>Place of the contact relative to A's centre, in world axes, m; halfway between the two surfaces.</summary>
    public Vector3Wide OffsetA;
    /// <summary>Penetration along the normal, m; negative where the surfaces are apart.</summary>
    public Vector<float> Depth;
    /// <summary>Names the features that touch, to find the same contact again in the next step.</summary>
    public Vector<int> FeatureId;
    /// <summary>All bits set where there is such a contact; the other fields mean nothing elsewhere.</summary>
    public Vector<int> Exists;
}
