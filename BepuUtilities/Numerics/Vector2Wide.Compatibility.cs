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

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Vector2Wide v, Vector<float> scale, out Vector2Wide result) => result = v * scale;

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Dot(in Vector2Wide a, in Vector2Wide b, out Vector<float> result) => result = Dot(a, b);

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Length(in Vector2Wide v, out Vector<float> length) => length = v.Length();

    /// <summary>Reads the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadFirst(in Vector2Wide source, out Vector2 target) => target = Lanes.Read<Vector2, Vector2Wide>(ref Unsafe.AsRef(in source), 0);

    /// <summary>Writes the first lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void WriteFirst(in Vector2 source, ref Vector2Wide targetSlot) => Lanes.Write(source, ref targetSlot, 0);
}
