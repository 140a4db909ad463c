using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Matrix3x3Wide
{
    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateFromQuaternion(in QuaternionWide q, out Matrix3x3Wide result) => result = FromQuaternion(q);

    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide CreateFromQuaternion(in QuaternionWide q) => FromQuaternion(q);

    /// <summary>The matrix whose product with a column vector u is the cross product v x u.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateCrossProduct(in Vector3Wide v, out Matrix3x3Wide skew) => skew = Skew(v);

    /// <summary>Transforms a row vector: v * m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transform(in Vector3Wide v, in Matrix3x3Wide m, out Vector3Wide result) => result = TransposeTimes(m, v);

    /// <summary>Transforms a row vector: v * m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector3Wide v, in Matrix3x3Wide m, out Vector3Wide result) => result = TransposeTimes(m, v);

    /// <summary>Transforms a row vector by the transpose: v * transpose(m).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformByTransposedWithoutOverlap(in Vector3Wide v, in Matrix3x3Wide m, out Vector3Wide result) => result = m * v;

    /// <summary>Matrix product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Multiply(in Matrix3x3Wide a, in Matrix3x3Wide b, out Matrix3x3Wide result) => result = a * b;

    /// <summary>Matrix product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MultiplyWithoutOverlap(in Matrix3x3Wide a, in Matrix3x3Wide b, out Matrix3x3Wide result) => result = a * b;

    /// <summary>a * transpose(b).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MultiplyByTransposeWithoutOverlap(in Matrix3x3Wide a, in Matrix3x3Wide b, out Matrix3x3Wide result) =>
        result = MultiplyByTranspose(a, b);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Matrix3x3Wide a, in Matrix3x3Wide b, out Matrix3x3Wide result) => result = a + b;

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Matrix3x3Wide a, in Matrix3x3Wide b, out Matrix3x3Wide result) => result = a - b;

    /// <summary>Opposite.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Negate(in Matrix3x3Wide m, out Matrix3x3Wide result) => result = -m;

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Matrix3x3Wide m, Vector<float> scale, out Matrix3x3Wide result) => result = m * scale;

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Matrix3x3 source, out Matrix3x3Wide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide Broadcast(in Matrix3x3 source) => Lanes.Broadcast<Matrix3x3, Matrix3x3Wide>(source);

    /// <summary>Fills every lane with the value of one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Rebroadcast(in Matrix3x3Wide source, int slotIndex, out Matrix3x3Wide broadcast)
    {
        ReadSlot(ref Unsafe.AsRef(in source), slotIndex, out var value);
        broadcast = Broadcast(value);
    }

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref Matrix3x3Wide wide, int slotIndex, out Matrix3x3 narrow) =>
        narrow = Lanes.Read<Matrix3x3, Matrix3x3Wide>(ref wide, slotIndex);

    /// <summary>Writes one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteSlot(in Matrix3x3 source, int slotIndex, ref Matrix3x3Wide target) => Lanes.Write(source, ref target, slotIndex);

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in Matrix3x3Wide source, out Matrix3x3 target) =>
        target = Lanes.Read<Matrix3x3, Matrix3x3Wide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Matrix3x3 source, ref Matrix3x3Wide targetSlot) => Lanes.Write(source, ref targetSlot, 0);

    /// <summary>Copies one lane to another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CopySlot(ref Matrix3x3Wide source, int sourceSlotIndex, ref Matrix3x3Wide target, int targetSlotIndex) =>
        Lanes.Copy(ref source, sourceSlotIndex, ref target, targetSlotIndex);
}
