using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Lists that take no memory before there is something in them.</summary>
static class GrownLists
{
    /// <summary>Returns the memory of a list, if it ever took any.</summary>
    public static void DisposeIfTaken<T>(ref this QuickList<T> list, BufferPool pool) where T : unmanaged
    {
        if (list.Span.Allocated)
            list.Dispose(pool);
    }
}
