using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of 2x2 matrices, by rows.</summary>
public struct Matrix2x2Wide
{
    /// <summary>First row.</summary>
    public Vector2Wide X;
    /// <summary>Second row.</summary>
    public Vector2Wide Y;

    /// <summary>Builds from rows.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Matrix2x2Wide(in Vector2Wide x, in Vector2Wide y)
    {
        X = x;
        Y = y;
    }

    /// <summary>Transforms a column vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator *(in Matrix2x2Wide m, in Vector2Wide v) => new(Vector2Wide.Dot(m.X, v), Vector2Wide.Dot(m.Y, v));

    /// <summary>Transforms a column vector by the transpose, that is, a row vector by the matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide TransposeTimes(in Matrix2x2Wide m, in Vector2Wide v) => m.X * v.X + m.Y * v.Y;

    /// <summary>Matrix product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x2Wide operator *(in Matrix2x2Wide a, in Matrix2x2Wide b) => new(TransposeTimes(b, a.X), TransposeTimes(b, a.Y));

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x2Wide operator +(in Matrix2x2Wide a, in Matrix2x2Wide b) => new(a.X + b.X, a.Y + b.Y);

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x2Wide operator *(in Matrix2x2Wide m, Vector<float> scale) => new(m.X * scale, m.Y * scale);

    /// <summary>Inverse; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix2x2Wide Invert(in Matrix2x2Wide m)
    {
        var scale = Wide.DivideOrZero(Vector<float>.One, m.X.X * m.Y.Y - m.X.Y * m.Y.X);
        return new(new(m.Y.Y * scale, -m.X.Y * scale), new(-m.Y.X * scale, m.X.X * scale));
    }
}
