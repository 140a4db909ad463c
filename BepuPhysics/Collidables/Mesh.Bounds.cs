using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

// Bounds of a mesh.
public unsafe partial struct Mesh
{
    /// <summary>Box around the mesh when its origin is at that of the world.</summary>
    /// <remarks>Exact if the orientation is the identity; else that of the boxes of at most eight parts, turned.</remarks>
    /// <param name="orientation">Rotation from the mesh's frame to the world; unit length.</param>
    /// <param name="min">Corner with the least coordinates, m.</param>
    /// <param name="max">Corner with the greatest coordinates, m.</param>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        if (orientation == Quaternion.Identity)
        {
            GetScaledBounds(out min, out max);
            return;
        }
        Vector3 x = Exact.Rotate(Vector3.UnitX, orientation), y = Exact.Rotate(Vector3.UnitY, orientation), z = Exact.Rotate(Vector3.UnitZ, orientation);
        min = new(float.MaxValue);
        max = new(-float.MaxValue);
        var top = Header->Nodes;
        for (int child = 0; child < MeshNode.Width; ++child)
        {
            if ((top->NodeMask >> child & 1) == 0 && top->TriangleCount(child) == 0)
                break;
            top->GetBounds(child, out var low, out var high);
            ApplyScale(ref low, ref high);
            var center = (low + high) * .5f;
            var half = (high - low) * .5f;
            var middle = x * center.X + y * center.Y + z * center.Z;
            // A few roundings of what is added up.
            var reach = Vector3.Abs(x) * half.X + Vector3.Abs(y) * half.Y + Vector3.Abs(z) * half.Z;
            reach += (Vector3.Abs(center) + half).Largest() * new Vector3(1e-6f);
            min = Exact.Min(min, middle - reach);
            max = Exact.Max(max, middle + reach);
        }
    }

    readonly void GetScaledBounds(out Vector3 min, out Vector3 max)
    {
        min = Header->Min;
        max = Header->Max;
        ApplyScale(ref min, ref max);
    }

    internal readonly void ApplyScale(ref Vector3 min, ref Vector3 max)
    {
        Vector3 a = min * scale, b = max * scale;
        min = Exact.Min(a, b);
        max = Exact.Max(a, b);
    }

    /// <summary>How far a rotation can carry the surface beyond the bounds of another orientation.</summary>
    /// <remarks>As that of a triangle: the origin need not be near the surface, but some point of the hull is no farther than its middle.</remarks>
    /// <param name="maximumRadius">Distance from the origin to the farthest point, m; an upper bound if the scale is not the same along all axes.</param>
    /// <param name="maximumAngularExpansion">Greatest distance by which it can be carried, m.</param>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        var factors = Vector3.Abs(scale);
        maximumRadius = Header->OuterRadius * factors.Largest();
        GetScaledBounds(out var min, out var max);
        var corner = Exact.Length(Exact.Max(Vector3.Abs(min), Vector3.Abs(max)));
        maximumRadius = corner < maximumRadius ? corner : maximumRadius;
        maximumAngularExpansion = maximumRadius + Exact.Length(Header->Middle * factors);
    }
}

static class LargestComponent
{
    public static float Largest(this Vector3 v)
    {
        var largest = v.X > v.Y ? v.X : v.Y;
        return largest > v.Z ? largest : v.Z;
    }
}
