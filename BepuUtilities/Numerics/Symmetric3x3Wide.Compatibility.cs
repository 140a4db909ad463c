using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Symmetric3x3Wide
{
    /// <summary>Inverse of a positive semidefinite matrix; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Invert(in Symmetric3x3Wide m, out Symmetric3x3Wide inverse) => inverse = Invert(m);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Symmetric3x3Wide a, in Symmetric3x3Wide b, out Symmetric3x3Wide result) => result = a + b;

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Symmetric3x3Wide a, in Symmetric3x3Wide b, out Symmetric3x3Wide result) => result = a - b;

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Symmetric3x3Wide m, Vector<float> scale, out Symmetric3x3Wide result) => result = m * scale;

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector3Wide v, in Symmetric3x3Wide m, out Vector3Wide result) => result = m * v;

    /// <summary>Skew(v) * m * transpose(Skew(v)).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void SkewSandwichWithoutOverlap(in Vector3Wide v, in Symmetric3x3Wide m, out Symmetric3x3Wide sandwich) => sandwich = SkewSandwich(v, m);

    /// <summary>transpose(v) * m * v.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void VectorSandwich(in Vector3Wide v, in Symmetric3x3Wide m, out Vector<float> sandwich) => sandwich = VectorSandwich(v, m);

    /// <summary>transpose(r) * m * r.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RotationSandwich(in Matrix3x3Wide r, in Symmetric3x3Wide m, out Symmetric3x3Wide sandwich) => sandwich = RotationSandwich(r, m);

    /// <summary>Product of a matrix with a symmetric one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MultiplyWithoutOverlap(in Matrix3x3Wide a, in Symmetric3x3Wide b, out Matrix3x3Wide result) => result = a * b;

    /// <summary>j * m * transpose(j): the inverse effective mass of two rows.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MatrixSandwich(in Matrix2x3Wide j, in Symmetric3x3Wide m, out Symmetric2x2Wide result) => result = Matrix2x3Wide.Sandwich(j, m);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Symmetric3x3 source, out Symmetric3x3Wide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric3x3Wide Broadcast(in Symmetric3x3 source) => Lanes.Broadcast<Symmetric3x3, Symmetric3x3Wide>(source);

    /// <summary>Fills every lane with the value of one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Rebroadcast(in Symmetric3x3Wide source, int slotIndex, out Symmetric3x3Wide broadcast)
    {
        ReadSlot(ref Unsafe.AsRef(in source), slotIndex, out var value);
        broadcast = Broadcast(value);
    }

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref Symmetric3x3Wide wide, int slotIndex, out Symmetric3x3 narrow) =>
        narrow = Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref wide, slotIndex);

    /// <summary>Writes one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteSlot(in Symmetric3x3 source, int slotIndex, ref Symmetric3x3Wide target) => Lanes.Write(source, ref target, slotIndex);

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in Symmetric3x3Wide source, out Symmetric3x3 target) =>
        target = Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Symmetric3x3 source, ref Symmetric3x3Wide targetSlot) => Lanes.Write(source, ref targetSlot, 0);

    /// <summary>Copies one lane to another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CopySlot(ref Symmetric3x3Wide source, int sourceSlotIndex, ref Symmetric3x3Wide target, int targetSlotIndex) =>
        Lanes.Copy(ref source, sourceSlotIndex, ref target, targetSlotIndex);
}
