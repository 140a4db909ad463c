using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of symmetric 2x2 matrices, by their lower triangles.</summary>
public partial struct Symmetric2x2Wide
{
    /// <summary>Row X, column X.</summary>
    public Vector<float> XX;
    /// <summary>Row Y, column X.</summary>
    public Vector<float> YX;
    /// <summary>Row Y, column Y.</summary>
    public Vector<float> YY;

    /// <summary>Builds from the lower triangle, row by row.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Symmetric2x2Wide(Vector<float> xx, Vector<float> yx, Vector<float> yy)
    {
        XX = xx;
        YX = yx;
        YY = yy;
    }

    /// <summary>Transforms a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator *(in Symmetric2x2Wide m, in Vector2Wide v) => new(m.XX * v.X + m.YX * v.Y, m.YX * v.X + m.YY * v.Y);

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide operator +(in Symmetric2x2Wide a, in Symmetric2x2Wide b) => new(a.XX + b.XX, a.YX + b.YX, a.YY + b.YY);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide operator -(in Symmetric2x2Wide a, in Symmetric2x2Wide b) => new(a.XX - b.XX, a.YX - b.YX, a.YY - b.YY);

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide operator *(in Symmetric2x2Wide m, Vector<float> scale) => new(m.XX * scale, m.YX * scale, m.YY * scale);

    /// <summary>Product with the two rows of a 2x3 matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x3Wide operator *(in Symmetric2x2Wide m, in Matrix2x3Wide b) => new(b.X * m.XX + b.Y * m.YX, b.X * m.YX + b.Y * m.YY);

    /// <summary>Adds a scalar to the diagonal.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide AddDiagonal(in Symmetric2x2Wide m, Vector<float> value) => new(m.XX + value, m.YX, m.YY + value);

    /// <summary>Inverse of a positive semidefinite matrix of any magnitude; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Symmetric2x2Wide Invert(in Symmetric2x2Wide matrix)
    {
        var power = Wide.NormalizingPowerOfTwo(matrix.XX + matrix.YY);
        var m = matrix * power;
        var scale = Wide.DivideOrZero(power, m.XX * m.YY - m.YX * m.YX);
        return new(m.YY * scale, -m.YX * scale, m.XX * scale);
    }
}
