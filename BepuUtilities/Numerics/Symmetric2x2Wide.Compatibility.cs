using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Symmetric2x2Wide
{
    /// <summary>Inverse of a positive semidefinite matrix; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void InvertWithoutOverlap(in Symmetric2x2Wide m, out Symmetric2x2Wide inverse) => inverse = Invert(m);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Symmetric2x2Wide a, in Symmetric2x2Wide b, out Symmetric2x2Wide result) => result = a + b;

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector2Wide v, in Symmetric2x2Wide m, out Vector2Wide result) => result = m * v;
}
