using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Symmetric3x3Wide
{
    /// <summary>Inverse of a positive semidefinite matrix; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Invert(in Symmetric3x3Wide m, out Symmetric3x3Wide inverse) => inverse = Invert(m);

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector3Wide v, in Symmetric3x3Wide m, out Vector3Wide result) => result = m * v;

    /// <summary>transpose(v) * m * v.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void VectorSandwich(in Vector3Wide v, in Symmetric3x3Wide m, out Vector<float> sandwich) => sandwich = VectorSandwich(v, m);

    /// <summary>j * m * transpose(j): the inverse effective mass of two rows.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MatrixSandwich(in Matrix2x3Wide j, in Symmetric3x3Wide m, out Symmetric2x2Wide result) => result = Matrix2x3Wide.Sandwich(j, m);
}
