using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;

namespace BepuUtilities;

/// <summary>Moves whole structs between scalar form and one lane of their wide form.</summary>
/// <remarks>
/// One implementation serves every type pair, because a wide struct is its scalar struct with each four-byte field widened.
/// The loops have constant bounds, so the JIT unrolls them for small structs.
/// </remarks>
public static class Lanes
{
    /// <summary>Writes a scalar struct into one lane of its wide form; the other lanes keep their values.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Write<TScalar, TWide>(in TScalar source, ref TWide target, int lane)
        where TScalar : unmanaged where TWide : unmanaged, IWide<TScalar>
    {
        CheckShape<TScalar, TWide>(lane);
        ref var from = ref Unsafe.As<TScalar, float>(ref Unsafe.AsRef(in source));
        ref var to = ref Unsafe.Add(ref Unsafe.As<TWide, float>(ref target), lane);
        for (int i = 0; i < Unsafe.SizeOf<TScalar>() / sizeof(float); ++i)
            Unsafe.Add(ref to, i * Vector<float>.Count) = Unsafe.Add(ref from, i);
    }

    /// <summary>Reads one lane of a wide struct back into scalar form.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static TScalar Read<TScalar, TWide>(ref TWide source, int lane)
        where TScalar : unmanaged where TWide : unmanaged, IWide<TScalar>
    {
        CheckShape<TScalar, TWide>(lane);
        ref var from = ref Unsafe.Add(ref Unsafe.As<TWide, float>(ref source), lane);
        // What lives in one register is put together there: read as a whole from where it was written by its parts, it would wait for these.
        if (typeof(TScalar) == typeof(Vector3))
            return Unsafe.BitCast<Vector3, TScalar>(new(from, Row(ref from, 1), Row(ref from, 2)));
        if (typeof(TScalar) == typeof(Quaternion))
            return Unsafe.BitCast<Quaternion, TScalar>(new(from, Row(ref from, 1), Row(ref from, 2), Row(ref from, 3)));
        Unsafe.SkipInit(out TScalar result);
        ref var to = ref Unsafe.As<TScalar, float>(ref result);
        for (int i = 0; i < Unsafe.SizeOf<TScalar>() / sizeof(float); ++i)
            Unsafe.Add(ref to, i) = Unsafe.Add(ref from, i * Vector<float>.Count);
        return result;
    }

    /// <summary>Fills every lane of a wide struct with the same scalar struct.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static TWide Broadcast<TScalar, TWide>(in TScalar source)
        where TScalar : unmanaged where TWide : unmanaged, IWide<TScalar>
    {
        CheckShape<TScalar, TWide>(0);
        Unsafe.SkipInit(out TWide result);
        ref var from = ref Unsafe.As<TScalar, float>(ref Unsafe.AsRef(in source));
        ref var to = ref Unsafe.As<TWide, Vector<float>>(ref result);
        for (int i = 0; i < Unsafe.SizeOf<TScalar>() / sizeof(float); ++i)
            Unsafe.Add(ref to, i) = new Vector<float>(Unsafe.Add(ref from, i));
        return result;
    }

    /// <summary>Copies one lane of a wide struct to a lane of another (or the same) wide struct.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Copy<TWide>(ref TWide source, int sourceLane, ref TWide target, int targetLane) where TWide : unmanaged
    {
        Check.That(Unsafe.SizeOf<TWide>() % Unsafe.SizeOf<Vector<float>>() == 0);
        Check.That((uint)sourceLane < (uint)Vector<float>.Count && (uint)targetLane < (uint)Vector<float>.Count);
        ref var from = ref Unsafe.Add(ref Unsafe.As<TWide, float>(ref source), sourceLane);
        ref var to = ref Unsafe.Add(ref Unsafe.As<TWide, float>(ref target), targetLane);
        for (int i = 0; i < Unsafe.SizeOf<TWide>() / Unsafe.SizeOf<Vector<float>>(); ++i)
            Unsafe.Add(ref to, i * Vector<float>.Count) = Unsafe.Add(ref from, i * Vector<float>.Count);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static float Row(ref float first, int row) => Unsafe.Add(ref first, row * Vector<float>.Count);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void CheckShape<TScalar, TWide>(int lane)
    {
        Check.That(Unsafe.SizeOf<TWide>() == Unsafe.SizeOf<TScalar>() * Vector<float>.Count);
        Check.That((uint)lane < (uint)Vector<float>.Count);
    }
}
