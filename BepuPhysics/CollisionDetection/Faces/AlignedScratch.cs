using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>Puts what a kernel works on at a cache line of the caller's stack.</summary>
/// <remarks>
/// The runtime aligns the stack to 16 bytes. Wide values that lie across two cache lines are slow, most of all to read back after a write, and
/// which of them do would change with the depth of the stack. So kernels take the size that is named here with <c>stackalloc</c>, as only they
/// can since it ends with their frame, and use the part of it that begins at a line.
/// </remarks>
static unsafe class AlignedScratch
{
    /// <summary>Bytes of a cache line.</summary>
    public const int CacheLine = 64;
    // What the runtime aligns the stack to; there are four such places in a line.
    const int StackAlignment = 16;

    /// <summary>Bytes to take from the stack for a value that begins at a cache line.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int SizeFor<T>() where T : unmanaged => sizeof(T) + CacheLine;

    /// <summary>
    /// As many, and what brings the frames of the methods that are called next to the same place in a line each time: they hold wide values, too.
    /// </summary>
    /// <param name="anchor">Any local variable of the caller, for where its frame is in a line.</param>
    /// <param name="place">Which of the places it is, from 0 to 3. All keep the time steady; which is the quickest, only measuring can tell.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int SizeFor<T>(int* anchor, int place) where T : unmanaged =>
        (int)((nint)anchor & (CacheLine - StackAlignment)) + place * StackAlignment + SizeFor<T>();

    /// <summary>The value that begins at the first cache line of the memory, as whatever it holds.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref T Align<T>(void* memory) where T : unmanaged => ref *(T*)(((nint)memory + CacheLine - 1) & -CacheLine);
}
