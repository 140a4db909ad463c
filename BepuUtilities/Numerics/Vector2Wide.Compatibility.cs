using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Vector2Wide
{
    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Vector2Wide a, in Vector2Wide b, out Vector2Wide result) => result = a + b;

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Vector2Wide a, in Vector2Wide b, out Vector2Wide result) => result = a - b;

    /// <summary>Opposite.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Negate(in Vector2Wide v, out Vector2Wide result) => result = -v;

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Vector2Wide v, Vector<float> scale, out Vector2Wide result) => result = v * scale;

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Dot(in Vector2Wide a, in Vector2Wide b, out Vector<float> result) => result = Dot(a, b);

    /// <summary>Inner product with itself.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void LengthSquared(in Vector2Wide v, out Vector<float> lengthSquared) => lengthSquared = v.LengthSquared();

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Length(in Vector2Wide v, out Vector<float> length) => length = v.Length();

    /// <summary>Picks the left operand where the mask is set, the right one elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ConditionalSelect(in Vector<int> condition, in Vector2Wide left, in Vector2Wide right, out Vector2Wide result) =>
        result = Select(condition, left, right);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Vector2 source, out Vector2Wide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide Broadcast(in Vector2 source) => Lanes.Broadcast<Vector2, Vector2Wide>(source);

    /// <summary>Fills every lane with the value of one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Rebroadcast(in Vector2Wide source, int slotIndex, out Vector2Wide broadcast)
    {
        ReadSlot(ref Unsafe.AsRef(in source), slotIndex, out var value);
        broadcast = Broadcast(value);
    }

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref Vector2Wide wide, int slotIndex, out Vector2 narrow) => narrow = Lanes.Read<Vector2, Vector2Wide>(ref wide, slotIndex);

    /// <summary>Writes one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteSlot(in Vector2 source, int slotIndex, ref Vector2Wide target) => Lanes.Write(source, ref target, slotIndex);

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in Vector2Wide source, out Vector2 target) => target = Lanes.Read<Vector2, Vector2Wide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Vector2 source, ref Vector2Wide targetSlot) => Lanes.Write(source, ref targetSlot, 0);

    /// <summary>Copies one lane to another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CopySlot(ref Vector2Wide source, int sourceSlotIndex, ref Vector2Wide target, int targetSlotIndex) =>
        Lanes.Copy(ref source, sourceSlotIndex, ref target, targetSlotIndex);
}
