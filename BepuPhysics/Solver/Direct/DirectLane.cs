using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints;

/// <summary>The numbers of one structure among those of several.</summary>
static class DirectLane
{
    /// <summary>The number of a structure.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static ref double Of<TNumbers>(ref TNumbers numbers, int lane) where TNumbers : unmanaged, INumbers<TNumbers> =>
        ref Unsafe.Add(ref Unsafe.As<TNumbers, double>(ref numbers), lane);

    /// <summary>Writes a vector of a structure.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Write<TVectors, TNumbers>(ref TVectors vectors, int lane, double x, double y, double z)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var first = ref Unsafe.Add(ref Unsafe.As<TVectors, double>(ref vectors), lane);
        first = x;
        Unsafe.Add(ref first, TVectors.Stride) = y;
        Unsafe.Add(ref first, 2 * TVectors.Stride) = z;
        // The fourth number is zero.
        if (TVectors.Stride == 1)
            Unsafe.Add(ref first, 3) = 0;
    }

    /// <summary>Reads a vector of a structure.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector3 Read<TVectors, TNumbers>(ref TVectors vectors, int lane)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        ref var first = ref Unsafe.Add(ref Unsafe.As<TVectors, double>(ref vectors), lane);
        return new((float)first, (float)Unsafe.Add(ref first, TVectors.Stride), (float)Unsafe.Add(ref first, 2 * TVectors.Stride));
    }
}
