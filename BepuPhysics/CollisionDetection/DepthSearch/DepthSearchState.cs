using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// What is remembered of a pair from step to step: where the depth search ended, and which corners were the first contacts. <c>default</c> knows
/// nothing.
/// </summary>
// The triangle of the Minkowski difference is kept as the points of A and B that it came from, each in its own shape's frame: they are
// points of the shapes wherever these have moved.
public struct DepthSearchState
{
    /// <summary>Direction of least depth from A to B in A's frame; zero when nothing is known.</summary>
    public Vector3 Direction;
    /// <summary>First point of A, in A's frame, m.</summary>
    public Vector3 PointA0;
    /// <summary>Second point of A, in A's frame, m.</summary>
    public Vector3 PointA1;
    /// <summary>Third point of A, in A's frame, m.</summary>
    public Vector3 PointA2;
    /// <summary>First point of B, in B's frame, m.</summary>
    public Vector3 PointB0;
    /// <summary>Second point of B, in B's frame, m.</summary>
    public Vector3 PointB1;
    /// <summary>Third point of B, in B's frame, m.</summary>
    public Vector3 PointB2;
    /// <summary>Depth of the cores when it was last shown to be the least of all directions, m.</summary>
    public float CertifiedDepth;
    /// <summary>Steps since then, more or less.</summary>
    public int Age;
    /// <summary>
    /// Names of the corners that were the first two contacts, eight bits each; a name is one more than in the feature id, and zero is none.
    /// The search leaves it alone: it belongs to <see cref="FaceManifold{TShapeWideA, TFeatureA, TShapeWideB, TFeatureB}"/>.
    /// </summary>
    public int Contacts;
}

/// <summary>A bundle of <see cref="DepthSearchState"/>.</summary>
public struct DepthSearchStateWide : IWide<DepthSearchState>
{
    /// <inheritdoc cref="DepthSearchState.Direction"/>
    public Vector3Wide Direction;
    /// <inheritdoc cref="DepthSearchState.PointA0"/>
    public Vector3Wide PointA0;
    /// <inheritdoc cref="DepthSearchState.PointA1"/>
    public Vector3Wide PointA1;
    /// <inheritdoc cref="DepthSearchState.PointA2"/>
    public Vector3Wide PointA2;
    /// <inheritdoc cref="DepthSearchState.PointB0"/>
    public Vector3Wide PointB0;
    /// <inheritdoc cref="DepthSearchState.PointB1"/>
    public Vector3Wide PointB1;
    /// <inheritdoc cref="DepthSearchState.PointB2"/>
    public Vector3Wide PointB2;
    /// <inheritdoc cref="DepthSearchState.CertifiedDepth"/>
    public Vector<float> CertifiedDepth;
    /// <inheritdoc cref="DepthSearchState.Age"/>
    public Vector<int> Age;
    /// <inheritdoc cref="DepthSearchState.Contacts"/>
    public Vector<int> Contacts;
}
