using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Rays without a handler.
public sealed unsafe partial class Simulation
{
    /// <summary>Finds the first that a ray hits.</summary>
    /// <remarks>
    /// Of several that are hit at the same t it is the one with the lowest reference, and of its pieces the lowest number. Triangles are hit from
    /// their fronts. Only reads, as
    /// <see cref="RayCast{THitHandler}(Vector3, Vector3, float, BufferPool, ref THitHandler, int)"/>, which is for those who choose what is tested.
    /// </remarks>
    /// <param name="origin">Where the ray starts, m.</param>
    /// <param name="direction">Direction of the ray; its length is the unit in which t is measured. A direction of zero length hits nothing.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hit">The first hit.</param>
    /// <param name="layers">Layers that the ray is in, and that it meets; everything, if not given.</param>
    /// <returns>Whether the ray hits anything.</returns>
    /// <exception cref="ArgumentException">A component is not finite, or the length is negative or not a number.</exception>
    public bool RayCast(Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, out RayHit hit, CollisionLayers? layers = null)
    {
        hit = default;
        fixed (RayHit* room = &hit)
            return FindHits(origin, direction, maximumT, pool, room, 1, layers) > 0;
    }

    /// <summary>Finds all that a ray hits, in the order in which it hits them.</summary>
    /// <remarks>
    /// Each convex piece is hit once, where the ray enters it; a mesh at each triangle that shows its front. The order of those that are hit at
    /// the same t is that of their references, then of the numbers of their pieces. Where there is not enough room the nearest ones are told,
    /// and the search ends sooner: if as many are told as there is room for, there may be more. Only reads, as
    /// <see cref="RayCast{THitHandler}(Vector3, Vector3, float, BufferPool, ref THitHandler, int)"/>.
    /// </remarks>
    /// <param name="origin">Where the ray starts, m.</param>
    /// <param name="direction">Direction of the ray; its length is the unit in which t is measured. A direction of zero length hits nothing.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; may be infinite.</param>
    /// <param name="pool">Source of temporary memory; a pool of the calling thread.</param>
    /// <param name="hits">Room for the hits: for one at least.</param>
    /// <param name="layers">Layers that the ray is in, and that it meets; everything, if not given.</param>
    /// <returns>Number of hits.</returns>
    /// <exception cref="ArgumentException">A component is not finite, the length is negative or not a number, or there is no room.</exception>
    public int RayCastAll(
        Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, Span<RayHit> hits, CollisionLayers? layers = null)
    {
        if (hits.IsEmpty)
            throw new ArgumentException("There has to be room for a hit.", nameof(hits));
        fixed (RayHit* room = hits)
            return FindHits(origin, direction, maximumT, pool, room, hits.Length, layers);
    }

    int FindHits(Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, RayHit* room, int capacity, CollisionLayers? layers)
    {
        var handler = new NearestRayHits(room, capacity, maximumT);
        if (layers is { } own)
            RayCast(origin, direction, maximumT, own, pool, ref handler);
        else
            RayCast(origin, direction, maximumT, pool, ref handler);
        return handler.Count;
    }
}
