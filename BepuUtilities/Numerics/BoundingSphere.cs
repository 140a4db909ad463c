using System.Numerics;

namespace BepuUtilities;

/// <summary>A sphere around something.</summary>
public struct BoundingSphere
{
    /// <summary>Centre.</summary>
    public Vector3 Center;
    /// <summary>Radius, zero or more.</summary>
    public float Radius;

    /// <summary>Builds from centre and radius.</summary>
    public BoundingSphere(Vector3 center, float radius)
    {
        Center = center;
        Radius = radius;
    }

    /// <summary>Whether two spheres overlap; touching counts.</summary>
    public static bool Intersects(in BoundingSphere a, in BoundingSphere b)
    {
        var reach = a.Radius + b.Radius;
        return Exact.DistanceSquared(a.Center, b.Center) <= reach * reach;
    }

    /// <inheritdoc/>
    public override readonly string ToString() => $"({Center}, {Radius})";
}
