using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>References to single lanes of wide values.</summary>
public static class GatherScatter
{
    /// <summary>Reference to one lane of a vector, without a bounds check.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref T Get<T>(ref Vector<T> vector, int index) => ref Unsafe.Add(ref Unsafe.As<Vector<T>, T>(ref vector), index);

    /// <summary>Reference to the first lane of a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref T GetFirst<T>(ref Vector<T> vector) => ref Unsafe.As<Vector<T>, T>(ref vector);

    /// <summary>
    /// The wide struct seen from one of its lanes: the first lane of the result is lane <paramref name="innerIndex"/> of the source.
    /// Only that first lane may be touched; the others lie in the wrong fields or beyond the struct.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref T GetOffsetInstance<T>(ref T source, int innerIndex) where T : struct =>
        ref Unsafe.As<float, T>(ref Unsafe.Add(ref Unsafe.As<T, float>(ref source), innerIndex));
}
