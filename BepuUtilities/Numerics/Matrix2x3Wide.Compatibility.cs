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
}
