using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Vector3Wide
{
    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Vector3Wide a, in Vector3Wide b, out Vector3Wide result) => result = a + b;

    /// <summary>Adds a value to every component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Vector3Wide v, Vector<float> s, out Vector3Wide result) => result = new(v.X + s, v.Y + s, v.Z + s);

    /// <summary>Adds a value to every component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator +(in Vector3Wide v, Vector<float> s) => new(v.X + s, v.Y + s, v.Z + s);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Vector3Wide a, in Vector3Wide b, out Vector3Wide result) => result = a - b;

    /// <summary>Subtracts a value from every component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Vector3Wide v, Vector<float> s, out Vector3Wide result) => result = new(v.X - s, v.Y - s, v.Z - s);

    /// <summary>Subtracts a value from every component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator -(in Vector3Wide v, Vector<float> s) => new(v.X - s, v.Y - s, v.Z - s);

    /// <summary>Opposite.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Negate(in Vector3Wide v, out Vector3Wide result) => result = -v;

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Vector3Wide v, Vector<float> scale, out Vector3Wide result) => result = v * scale;

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Dot(in Vector3Wide a, in Vector3Wide b, out Vector<float> result) => result = Dot(a, b);

    /// <summary>Cross product; the result may be an operand.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Cross(in Vector3Wide a, in Vector3Wide b, out Vector3Wide result) => result = Cross(a, b);

    /// <summary>Cross product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CrossWithoutOverlap(in Vector3Wide a, in Vector3Wide b, out Vector3Wide result) => result = Cross(a, b);

    /// <summary>Inner product with itself.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void LengthSquared(in Vector3Wide v, out Vector<float> lengthSquared) => lengthSquared = v.LengthSquared();

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Length(in Vector3Wide v, out Vector<float> length) => length = v.Length();

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Length(in Vector3Wide v) => v.Length();

    /// <summary>Distance between two points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Distance(in Vector3Wide a, in Vector3Wide b, out Vector<float> distance) => distance = (b - a).Length();

    /// <summary>Distance between two points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Distance(in Vector3Wide a, in Vector3Wide b) => (b - a).Length();

    /// <summary>Squared distance between two points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void DistanceSquared(in Vector3Wide a, in Vector3Wide b, out Vector<float> distanceSquared) => distanceSquared = (b - a).LengthSquared();

    /// <summary>Squared distance between two points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> DistanceSquared(in Vector3Wide a, in Vector3Wide b) => (b - a).LengthSquared();

    /// <summary>Vector of length one; zero where the squared length is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Normalize(in Vector3Wide v, out Vector3Wide result) => result = Normalize(v);

    /// <summary>Smaller value of each component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Min(in Vector3Wide a, in Vector3Wide b, out Vector3Wide result) => result = Min(a, b);

    /// <summary>Larger value of each component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Max(in Vector3Wide a, in Vector3Wide b, out Vector3Wide result) => result = Max(a, b);

    /// <summary>Components without their signs.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Abs(in Vector3Wide v, out Vector3Wide result) => result = Abs(v);

    /// <summary>Picks the left operand where the mask is set, the right one elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ConditionalSelect(in Vector<int> condition, in Vector3Wide left, in Vector3Wide right, out Vector3Wide result) =>
        result = Select(condition, left, right);

    /// <summary>Picks the left operand where the mask is set, the right one elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide ConditionalSelect(Vector<int> condition, in Vector3Wide left, in Vector3Wide right) => Select(condition, left, right);

    /// <summary>Opposite where the mask is set, unchanged elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ConditionallyNegate(Vector<int> shouldNegate, ref Vector3Wide v) => v = ConditionallyNegate(shouldNegate, v);

    /// <summary>Opposite where the mask is set, unchanged elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide ConditionallyNegate(Vector<int> shouldNegate, Vector3Wide v) => Select(shouldNegate, -v, v);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Vector3 source, out Vector3Wide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Broadcast(in Vector3 source) => Lanes.Broadcast<Vector3, Vector3Wide>(source);

    /// <summary>Fills every lane with the value of one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Rebroadcast(in Vector3Wide source, int slotIndex, out Vector3Wide broadcast)
    {
        ReadSlot(ref Unsafe.AsRef(in source), slotIndex, out var value);
        broadcast = Broadcast(value);
    }

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref Vector3Wide wide, int slotIndex, out Vector3 narrow) => narrow = Lanes.Read<Vector3, Vector3Wide>(ref wide, slotIndex);

    /// <summary>Writes one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteSlot(in Vector3 source, int slotIndex, ref Vector3Wide target) => Lanes.Write(source, ref target, slotIndex);

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in Vector3Wide source, out Vector3 target) => target = Lanes.Read<Vector3, Vector3Wide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Vector3 source, ref Vector3Wide targetSlot) => Lanes.Write(source, ref targetSlot, 0);

    /// <summary>Copies one lane to another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CopySlot(ref Vector3Wide source, int sourceSlotIndex, ref Vector3Wide target, int targetSlotIndex) =>
        Lanes.Copy(ref source, sourceSlotIndex, ref target, targetSlotIndex);
}
