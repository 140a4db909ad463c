using System.Runtime.CompilerServices;

namespace BepuUtilities.Memory;

/// <summary>What collections ask of their pool.</summary>
/// <remarks>
/// A generic method of an interface is searched for in each call, which takes longer than what it does here. Nearly all memory is that of one
/// kind of pool, whose methods are called directly.
/// </remarks>
static class PoolCalls
{
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void TakeAtLeast<T>(IUnmanagedMemoryPool pool, int count, out Buffer<T> buffer) where T : unmanaged
    {
        if (pool is BufferPool bufferPool)
            bufferPool.TakeAtLeast(count, out buffer);
        else
            pool.TakeAtLeast(count, out buffer);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Return<T>(IUnmanagedMemoryPool pool, ref Buffer<T> buffer) where T : unmanaged
    {
        if (pool is BufferPool bufferPool)
            bufferPool.Return(ref buffer);
        else
            pool.Return(ref buffer);
    }
}
