using BepuPhysics.Trees;

namespace BepuPhysics;

/// <summary>A ray that waits to be cast.</summary>
struct BatchedRay
{
    /// <summary>Origin, direction and the caller's number.</summary>
    public RayData Ray;
    /// <summary>Its length in units of its direction.</summary>
    public float MaximumT;
}
