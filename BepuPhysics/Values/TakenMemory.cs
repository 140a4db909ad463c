using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Memory that is taken only where it is needed.</summary>
static class TakenMemory
{
    /// <summary>Returns a buffer, if there is any.</summary>
    public static void ReturnIfTaken<T>(this BufferPool pool, ref Buffer<T> buffer) where T : unmanaged
    {
        if (buffer.Allocated)
            pool.Return(ref buffer);
    }

    /// <summary>Returns the memory of a list, if it ever took any.</summary>
    public static void DisposeIfTaken<T>(ref this QuickList<T> list, BufferPool pool) where T : unmanaged
    {
        if (list.Span.Allocated)
            list.Dispose(pool);
    }
}
