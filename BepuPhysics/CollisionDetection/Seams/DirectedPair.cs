using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair of convex shapes that is looked at along a direction, and what is found.</summary>
struct DirectedPair
{
    /// <summary>Unit direction in world axes, from B to A.</summary>
    public Vector3 Normal;
    /// <summary>Depth up to which contacts are wanted, m.</summary>
    public float GreatestDepth;
    /// <summary>By how much A has to move along the direction to be off B, m; negative where it is apart.</summary>
    public float Depth;
    /// <summary>Whether the face of A, or of B, that faces the direction is wanted.</summary>
    public bool FindsFaceOfA, FindsFaceOfB;
    /// <summary>
    /// Unit normal of that face, from B to A, if it is wanted and within 1e-2 rad of the direction; the direction if there is none.
    /// </summary>
    public Vector3 Face;
    /// <summary>What the pair is of.</summary>
    public int Owner;
    /// <summary>The contacts along the direction, relative to A; none where the depth is greater than wanted.</summary>
    public ConvexContactManifold Manifold;
    /// <summary>
    /// Whether it is no deeper than wanted: along the direction, or along the normal of a face that is all but across it. Faces of two shapes that rest on
    /// each other differ by a little, and far from the contacts that is much.
    /// </summary>
    public bool IsWithinDepth;
}
