using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Constraints;

/// <summary>The numbers of one structure among those of several.</summary>
static class DirectLane
{
    /// <summary>The number of a structure.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static ref double Of<TNumbers>(ref TNumbers numbers, int lane) where TNumbers : unmanaged, INumbers<TNumbers> =>
        ref Unsafe.Add(ref Unsafe.As<TNumbers, double>(ref numbers), lane);

    /// <summary>A mask of some structures.</summary>
    /// <param name="lanes">A bit for each.</param>
    internal static TNumbers MaskOf<TNumbers>(int lanes) where TNumbers : unmanaged, INumbers<TNumbers>
    {
        var all = TNumbers.All;
        TNumbers mask = default;
        for (int lane = 0; lane < TNumbers.Count; ++lane)
        {
            if ((lanes >> lane & 1) != 0)
                Of(ref mask, lane) = Of(ref all, lane);
        }
        return mask;
    }

    /// <summary>Writes a vector of a structure.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void Write<TVectors, TNumbers>(ref TVectors vectors, int lane, float x, float y, float z)
        where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
    {
        if (TVectors.Stride == 1)
        {
            // The fourth number is zero.
            Unsafe.As<TVectors, Vector256<double>>(ref vectors) = Vector256.WidenLower(Vector128.Create(x, y, z, 0).ToVector256Unsafe());
            return;
        }
        ref var first = ref Unsafe.Add(ref Unsafe.As<TVectors, double>(ref vectors), lane);
        first = x;
        Unsafe.Add(ref first, TVectors.Stride) = y;
        Unsafe.Add(ref first, 2 * TVectors.Stride) = z;
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
