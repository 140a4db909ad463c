using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct QuaternionWide
{
    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(in Vector3Wide v, in QuaternionWide q) => q * v;

    /// <summary>The rotation that applies the left quaternion first, then the right one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide operator *(in QuaternionWide a, in QuaternionWide b) => Concatenate(a, b);

    /// <summary>Sum of components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in QuaternionWide a, in QuaternionWide b, out QuaternionWide result) => result = a + b;

    /// <summary>Scaled components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in QuaternionWide q, Vector<float> scale, out QuaternionWide result) => result = q * scale;

    /// <summary>Opposite components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Negate(in QuaternionWide q, out QuaternionWide result) => result = -q;

    /// <summary>Inner product of components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Dot(in QuaternionWide a, in QuaternionWide b, out Vector<float> result) => result = Dot(a, b);

    /// <summary>Quaternion of length one; the identity where the squared length is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Normalize(in QuaternionWide q, out QuaternionWide result) => result = Normalize(q);

    /// <summary>The reverse rotation of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Conjugate(in QuaternionWide q, out QuaternionWide result) => result = Conjugate(q);

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>; the result may be an operand.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Concatenate(in QuaternionWide a, in QuaternionWide b, out QuaternionWide result) => result = Concatenate(a, b);

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ConcatenateWithoutOverlap(in QuaternionWide a, in QuaternionWide b, out QuaternionWide result) => result = Concatenate(a, b);

    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Transform(in Vector3Wide v, in QuaternionWide rotation) => rotation * v;

    /// <summary>Rotates a vector by a unit quaternion; the result may be an operand.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transform(in Vector3Wide v, in QuaternionWide rotation, out Vector3Wide result) => result = rotation * v;

    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector3Wide v, in QuaternionWide rotation, out Vector3Wide result) => result = rotation * v;

    /// <summary>Rotates a vector by the reverse of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide TransformByConjugate(in Vector3Wide v, in QuaternionWide rotation) => Conjugate(rotation) * v;

    /// <summary>Where a unit quaternion takes the X axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformUnitX(in QuaternionWide rotation, out Vector3Wide result) => result = TransformUnitX(rotation);

    /// <summary>Where a unit quaternion takes the Y axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformUnitY(in QuaternionWide rotation, out Vector3Wide result) => result = TransformUnitY(rotation);

    /// <summary>Where a unit quaternion takes the Z axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformUnitZ(in QuaternionWide rotation, out Vector3Wide result) => result = TransformUnitZ(rotation);

    /// <summary>Where a unit quaternion takes the X and the Y axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformUnitXY(in QuaternionWide rotation, out Vector3Wide x, out Vector3Wide y)
    {
        x = TransformUnitX(rotation);
        y = TransformUnitY(rotation);
    }

    /// <summary>Where a unit quaternion takes the X and the Z axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformUnitXZ(in QuaternionWide rotation, out Vector3Wide x, out Vector3Wide z)
    {
        x = TransformUnitX(rotation);
        z = TransformUnitZ(rotation);
    }

    /// <summary>Where a unit quaternion takes the Y and the Z axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformUnitYZ(in QuaternionWide rotation, out Vector3Wide y, out Vector3Wide z)
    {
        y = TransformUnitY(rotation);
        z = TransformUnitZ(rotation);
    }

    /// <summary>Picks the left operand where the mask is set, the right one elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ConditionalSelect(in Vector<int> condition, in QuaternionWide left, in QuaternionWide right, out QuaternionWide result) =>
        result = Select(condition, left, right);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Quaternion source, out QuaternionWide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide Broadcast(in Quaternion source) => Lanes.Broadcast<Quaternion, QuaternionWide>(source);

    /// <summary>Fills every lane with the value of one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Rebroadcast(in QuaternionWide source, int slotIndex, out QuaternionWide broadcast)
    {
        ReadSlot(ref Unsafe.AsRef(in source), slotIndex, out var value);
        broadcast = Broadcast(value);
    }

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref QuaternionWide wide, int slotIndex, out Quaternion narrow) =>
        narrow = Lanes.Read<Quaternion, QuaternionWide>(ref wide, slotIndex);

    /// <summary>Writes one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteSlot(in Quaternion source, int slotIndex, ref QuaternionWide target) => Lanes.Write(source, ref target, slotIndex);

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in QuaternionWide source, out Quaternion target) =>
        target = Lanes.Read<Quaternion, QuaternionWide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Quaternion source, ref QuaternionWide targetSlot) => Lanes.Write(source, ref targetSlot, 0);

    /// <summary>Copies one lane to another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CopySlot(ref QuaternionWide source, int sourceSlotIndex, ref QuaternionWide target, int targetSlotIndex) =>
        Lanes.Copy(ref source, sourceSlotIndex, ref target, targetSlotIndex);
}
