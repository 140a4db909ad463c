using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>As <see cref="ConvexHullFeature"/>, but that a hull that stands on an edge shows the nearer one of the two faces beside it.</summary>
/// <remarks>For hulls on what grounds are made of: a hull that lies on others by the hundred does not pay for it.</remarks>
readonly struct StandingHullFeature : IContactFeature<ConvexHullWide>
{
    /// <inheritdoc/>
    public static int MaximumVertexCount => ConvexHullFeature.MaximumVertexCount;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Find(in ConvexHullWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature) => ConvexHullFeature.Find(shape, direction, done, ref vertices, out feature, standsOnEdges: true);
}
