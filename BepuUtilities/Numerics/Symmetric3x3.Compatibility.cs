using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Symmetric3x3
{
    /// <summary>Inverse of a positive semidefinite matrix; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Invert(in Symmetric3x3 m, out Symmetric3x3 inverse) => inverse = Invert(m);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Symmetric3x3 a, in Symmetric3x3 b, out Symmetric3x3 result) => result = a + b;

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Symmetric3x3 a, in Symmetric3x3 b, out Symmetric3x3 result) => result = a - b;

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Scale(in Symmetric3x3 m, float scale, out Symmetric3x3 result) => result = m * scale;

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector3 v, in Symmetric3x3 m, out Vector3 result) => result = m * v;

    /// <summary>transpose(r) * m * r.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void RotationSandwich(in Matrix3x3 r, in Symmetric3x3 m, out Symmetric3x3 sandwich) => sandwich = RotationSandwich(r, m);

    /// <summary>The matrix with all nine entries.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 ToMatrix3x3(in Symmetric3x3 m) => new(new(m.XX, m.YX, m.ZX), new(m.YX, m.YY, m.ZY), new(m.ZX, m.ZY, m.ZZ));
}
