using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The least depth of a bundle of pairs over all directions, in A's frame.</summary>
/// <remarks>The point of B's surface that faces <see cref="PointOnA"/> is <c>PointOnA + Normal * Depth</c>.</remarks>
public struct DepthSearchResult
{
    /// <summary>Unit direction from B to A in which the shapes separate soonest, or in which they are closest, in A's frame.</summary>
    public Vector3Wide Normal;
    /// <summary>How far the surfaces overlap along the normal, m; negative: the distance between them.</summary>
    public Vector<float> Depth;
    /// <summary>A point of A's surface that is deepest in B, or closest to it, in A's frame, m.</summary>
    public Vector3Wide PointOnA;
    /// <summary>Set where the depth is at least the negated speculative margin. The other fields mean nothing elsewhere.</summary>
    public Vector<int> Near;
}
