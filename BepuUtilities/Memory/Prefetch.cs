using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics.X86;

namespace BepuUtilities.Memory;

/// <summary>Asks the processor to load memory that will be read soon. A hint: it changes no result and may do nothing.</summary>
public static unsafe class Prefetch
{
    /// <summary>Asks for a cache line.</summary>
    /// <param name="address">Any address in it; it need not be valid.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Read(void* address)
    {
        if (Sse.IsSupported)
            Sse.Prefetch0(address);
    }
}
