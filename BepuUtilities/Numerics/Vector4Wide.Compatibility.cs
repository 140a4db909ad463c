using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Vector4Wide
{
    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Vector4Wide a, in Vector4Wide b, out Vector4Wide result) => result = a + b;

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Vector4Wide a, in Vector4Wide b, out Vector4Wide result) => result = a - b;

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Vector4Wide v, Vector<float> scale, out Vector4Wide result) => result = v * scale;

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Dot(in Vector4Wide a, in Vector4Wide b, out Vector<float> result) => result = Dot(a, b);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Vector4 source, out Vector4Wide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector4Wide Broadcast(in Vector4 source) => Lanes.Broadcast<Vector4, Vector4Wide>(source);

    /// <summary>Fills every lane with the value of one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Rebroadcast(in Vector4Wide source, int slotIndex, out Vector4Wide broadcast)
    {
        ReadSlot(ref Unsafe.AsRef(in source), slotIndex, out var value);
        broadcast = Broadcast(value);
    }

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref Vector4Wide wide, int slotIndex, out Vector4 narrow) => narrow = Lanes.Read<Vector4, Vector4Wide>(ref wide, slotIndex);

    /// <summary>Writes one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteSlot(in Vector4 source, int slotIndex, ref Vector4Wide target) => Lanes.Write(source, ref target, slotIndex);

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in Vector4Wide source, out Vector4 target) => target = Lanes.Read<Vector4, Vector4Wide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Vector4 source, ref Vector4Wide targetSlot) => Lanes.Write(source, ref targetSlot, 0);

    /// <summary>Copies one lane to another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CopySlot(ref Vector4Wide source, int sourceSlotIndex, ref Vector4Wide target, int targetSlotIndex) =>
        Lanes.Copy(ref source, sourceSlotIndex, ref target, targetSlotIndex);
}
