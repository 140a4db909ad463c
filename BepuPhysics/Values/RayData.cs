using System.Numerics;

namespace BepuPhysics.Trees;

/// <summary>A ray as the callbacks of a query see it.</summary>
public struct RayData
{
    /// <summary>Where the ray starts, world space.</summary>
    public Vector3 Origin;
    /// <summary>The caller's number for the ray.</summary>
    public int Id;
    /// <summary>Direction of the ray; its length is the unit in which t is measured.</summary>
    public Vector3 Direction;
}
