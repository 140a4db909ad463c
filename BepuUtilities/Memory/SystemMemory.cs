using System;
using System.Runtime.InteropServices;

namespace BepuUtilities.Memory;

/// <summary>Blocks of memory from the system, the large ones in large pages where it has such.</summary>
/// <remarks>
/// Fresh memory costs a fault a page when it is first written to, and the first step of a big world writes to tens of thousands of pages of 4 KB. Linux
/// lends pages of 2 MB to whoever asks for them. To ask is advice: where it is not taken, or there is nobody to give it to, all is as without.
/// <para>
/// What is given back to the C library stays resident where it lies between other blocks, and so do the pages of a block that is kept for later. Linux
/// takes the pages of a part of memory back and lends fresh ones at the next write.
/// </para>
/// </remarks>
static unsafe class SystemMemory
{
    /// <summary>Size of a large page, to whose multiples a block has to be aligned: a part of one is made of small pages.</summary>
    internal const int LargePageSize = 1 << 21;

    /// <summary>From which size on a block lies in large pages: of each up to one at its end is more than is in use.</summary>
    internal const int LeastBlockSize = 4 * LargePageSize;

    /// <summary>From which size on the pages of a block that is kept go back to the system while it is not in use.</summary>
    internal const int LeastEmptiedSize = 1 << 20;

    // MADV_DONTNEED and MADV_HUGEPAGE of Linux.
    const int AdviceNotNeeded = 4, AdviceLargePages = 14;

    // int madvise(void* address, size_t length, int advice) of the C library, or null.
    static readonly delegate* unmanaged<void*, nuint, int, int> advise = FindAdvise();

    /// <summary>Asks for a block, to be given back by <see cref="Return"/>. Its contents are undefined.</summary>
    /// <param name="byteCount">Its size, a power of two.</param>
    /// <exception cref="OutOfMemoryException">The system has none.</exception>
    public static byte* Take(nuint byteCount)
    {
        // The call is looked up with the first block of all, not in the step that needs a large one.
        if (advise == null || byteCount < LeastBlockSize)
            return (byte*)NativeMemory.AlignedAlloc(byteCount, BufferPool.Alignment);
        var memory = (byte*)NativeMemory.AlignedAlloc(byteCount, LargePageSize);
        // Refused where the kernel was built without large pages, and not heeded where they are switched off.
        _ = advise(memory, byteCount, AdviceLargePages);
        return memory;
    }

    /// <summary>Gives a block back to the system, by way of the C library, which may keep it for who asks next.</summary>
    public static void Return(byte* memory) => NativeMemory.AlignedFree(memory);

    /// <summary>Gives the pages of a block back to the system, but not the block: its contents are undefined, and the next write takes fresh pages.</summary>
    /// <param name="memory">The block.</param>
    /// <param name="byteCount">Its size.</param>
    public static void Empty(byte* memory, nuint byteCount)
    {
        if (advise == null)
            return;
        // Pages at the ends may be shared with what is not the block's.
        var pageMask = (nuint)Environment.SystemPageSize - 1;
        var first = ((nuint)memory + pageMask) & ~pageMask;
        var end = ((nuint)memory + byteCount) & ~pageMask;
        // Refused where the memory is locked; it stays as it is then.
        if (first < end)
            _ = advise((void*)first, end - first, AdviceNotNeeded);
    }

    // The process has the C library loaded already. Other than a search for it by name this takes no time, no garbage, and fails without an exception.
    static delegate* unmanaged<void*, nuint, int, int> FindAdvise() =>
        OperatingSystem.IsLinux() && NativeLibrary.TryGetExport(NativeLibrary.GetMainProgramHandle(), "madvise", out var address)
            ? (delegate* unmanaged<void*, nuint, int, int>)address : null;
}
