using System;
using System.Numerics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Collects rays and casts them together.</summary>
/// <remarks>
/// Each ray meets what it meets by itself, by
/// <see cref="Simulation.RayCast{THitHandler}(Vector3, Vector3, float, BufferPool, ref THitHandler, int)"/>. Eight at a time go through the world together, in
/// the order in which they were added: half the time for those that begin and go nearly alike, as those of a picture or of a sensor do. Of these eight it is
/// told in no particular order, and of what one hits not always the nearest first; the order depends on nothing but rays and world.
/// Used by one thread at a time; any number of batchers may ask one simulation. Do not copy one that holds rays.
/// </remarks>
public struct SimulationRayBatcher<TRayHitHandler> : IDisposable where TRayHitHandler : struct, IRayHitHandler
{
    readonly BufferPool pool;
    readonly Simulation simulation;
    readonly int capacity;
    QuickList<BatchedRay> rays;

    /// <summary>Chooses what to test and receives the hits.</summary>
    public TRayHitHandler HitHandler;

    /// <summary>Creates an empty batcher.</summary>
    /// <param name="pool">Source of the batcher's memory; a pool of the calling thread.</param>
    /// <param name="simulation">Simulation to cast rays in.</param>
    /// <param name="hitHandler">Chooses what to test and receives the hits; copied.</param>
    /// <param name="batcherRayCapacity">Number of rays at which they are cast.</param>
    public SimulationRayBatcher(BufferPool pool, Simulation simulation, TRayHitHandler hitHandler, int batcherRayCapacity = 2048)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentNullException.ThrowIfNull(simulation);
        ArgumentOutOfRangeException.ThrowIfLessThan(batcherRayCapacity, 1);
        this.pool = pool;
        this.simulation = simulation;
        capacity = batcherRayCapacity;
        HitHandler = hitHandler;
        rays = new QuickList<BatchedRay>(batcherRayCapacity, pool);
    }

    /// <summary>Adds a ray, and casts all where that fills the batcher.</summary>
    /// <param name="origin">Where the ray starts, m.</param>
    /// <param name="direction">Direction of the ray; its length is the unit in which t is measured.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; may be infinite.</param>
    /// <param name="id">The caller's number for the ray.</param>
    public void Add(ref Vector3 origin, ref Vector3 direction, float maximumT, int id = 0)
    {
        rays.Add(new() { Ray = new() { Origin = origin, Direction = direction, Id = id }, MaximumT = maximumT }, pool);
        if (rays.Count == capacity)
            Flush();
    }

    /// <summary>Casts all rays that wait.</summary>
    /// <exception cref="ArgumentException">A ray is not finite or its length is negative; those before it were cast, and none waits any more.</exception>
    public void Flush()
    {
        var waiting = rays.AsSpan();
        rays.Count = 0;
        var good = 0;
        try
        {
            for (; good < waiting.Length; ++good)
                Simulation.CheckRay(waiting[good].Ray.Origin, waiting[good].Ray.Direction, waiting[good].MaximumT, pool);
        }
        finally
        {
            simulation.RayCast(waiting[..good], pool, ref HitHandler);
        }
    }

    /// <summary>Returns the memory to the pool; rays that wait are forgotten.</summary>
    public void Dispose() => rays.Dispose(pool);
}
