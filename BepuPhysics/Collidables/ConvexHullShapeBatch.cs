using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Convex hulls; removes their memory together with them when asked to.</summary>
sealed class ConvexHullShapeBatch(BufferPool pool, int initialCapacity) : ConvexShapeBatch<ConvexHull, ConvexHullWide>(pool, initialCapacity)
{
    private protected override void DisposeShape(int shapeIndex, BufferPool pool) => Get(shapeIndex).Dispose(pool);

    private protected override bool HasMemory => true;
}
