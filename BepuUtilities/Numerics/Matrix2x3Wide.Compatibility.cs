using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Matrix2x3Wide
{
    /// <summary>Transforms a row vector: v * m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transform(in Vector2Wide v, in Matrix2x3Wide m, out Vector3Wide result) => result = TransposeTimes(m, v);

    /// <summary>Transforms a row vector by the transpose: v * transpose(m).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformByTransposeWithoutOverlap(in Vector3Wide v, in Matrix2x3Wide m, out Vector2Wide result) => result = m * v;

    /// <summary>Product with a symmetric matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MultiplyWithoutOverlap(in Matrix2x3Wide m, in Symmetric3x3Wide s, out Matrix2x3Wide result) => result = m * s;

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Matrix2x3Wide a, in Matrix2x3Wide b, out Matrix2x3Wide result) => result = a + b;

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Matrix2x3Wide m, Vector<float> scale, out Matrix2x3Wide result) => result = m * scale;
}
