using System.Runtime.CompilerServices;

namespace BepuPhysics;

/// <summary>What a method takes of the stack so that the frames of all that it calls begin where a cache line does.</summary>
/// <remarks>
/// What a kernel has no register for it keeps on the stack, at distances from its frame that are multiples of a vector's length. The frame itself is at a
/// multiple of sixteen bytes, wherever the stack happens to be: of vectors of 32 bytes every other one then lies across two lines, or none, by chance, from
/// thread to thread and from process to process. Two steps, for the method itself, as what another one takes is given back when it returns:
/// <code>
/// var above = stackalloc byte[StackLine.Length];
/// var line = stackalloc byte[StackLine.BytesBelow(above, size)];
/// </code>
/// There is room for the size at the line. It has to be used, or it may not be taken.
/// </remarks>
static unsafe class StackLine
{
    /// <summary>Length of a line, bytes.</summary>
    internal const int Length = 64;

    /// <summary>Number of bytes to take next.</summary>
    /// <param name="above">What was taken last.</param>
    /// <param name="size">For how many there is to be room: one or more.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static int BytesBelow(void* above, int size) => (int)((nuint)above % Length) + (size + Length - 1) / Length * Length;
}
