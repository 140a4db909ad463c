using System.Runtime.CompilerServices;

namespace BepuPhysics;

/// <summary>Room on the stack for a value that begins where a cache line does.</summary>
/// <remarks>
/// Locals begin at a multiple of eight or sixteen bytes, wherever the stack happens to be. Of vectors of 32 bytes every other one then lies across two
/// lines, and takes a processor longer to read and to write. Worth it for what kernels hand each other by reference. What is left over is never touched.
/// </remarks>
/// <typeparam name="T">What there is room for: no less than a line.</typeparam>
[InlineArray(2)]
unsafe struct LineAligned<T> where T : unmanaged
{
    const int Line = 64;

    T first;

    /// <summary>Where the value is, with whatever was there before. Only of a local.</summary>
    internal T* Pointer
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (T*)((nint)Unsafe.AsPointer(ref first) + (Line - 1) & -Line);
    }
}
