using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Arithmetic between the index of an element and the bundle and lane that hold it.</summary>
public static class BundleIndexing
{
    /// <summary>An element's lane is its index and this mask.</summary>
    public static int VectorMask
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Vector<float>.Count - 1;
    }

    /// <summary>An element's bundle is its index shifted right by this.</summary>
    // Constants to the JIT, which knows Vector<float>.Count.
    public static int VectorShift
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Vector<float>.Count == 4 ? 2 : Vector<float>.Count == 8 ? 3 : Vector<float>.Count == 16 ? 4 : BitOperations.Log2((uint)Vector<float>.Count);
    }

    /// <summary>Bundles needed for a number of elements, zero or more.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int GetBundleCount(int elementCount) => (elementCount + VectorMask) >> VectorShift;

    /// <summary>Splits the index of an element into bundle and lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetBundleIndices(int linearIndex, out int bundleIndex, out int innerIndex)
    {
        bundleIndex = linearIndex >> VectorShift;
        innerIndex = linearIndex & VectorMask;
    }

    /// <summary>All bits set in the lanes below a count: the occupied lanes of a last, partly filled bundle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> CreateMaskForCountInBundle(int countInBundle) => Vector.LessThan(Vector<int>.Indices, new Vector<int>(countInBundle));

    /// <summary>All bits set in the lanes at and above a count: the empty lanes of a last, partly filled bundle.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<int> CreateTrailingMaskForCountInBundle(int countInBundle) => ~CreateMaskForCountInBundle(countInBundle);
}
