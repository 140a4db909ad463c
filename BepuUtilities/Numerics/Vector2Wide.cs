using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of 2D vectors.</summary>
public partial struct Vector2Wide : IWide<Vector2>
{
    /// <summary>First component of every lane.</summary>
    public Vector<float> X;
    /// <summary>Second component of every lane.</summary>
    public Vector<float> Y;

    /// <summary>Builds from components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector2Wide(Vector<float> x, Vector<float> y)
    {
        X = x;
        Y = y;
    }

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator +(in Vector2Wide a, in Vector2Wide b) => new(a.X + b.X, a.Y + b.Y);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator -(in Vector2Wide a, in Vector2Wide b) => new(a.X - b.X, a.Y - b.Y);

    /// <summary>Opposite.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator -(in Vector2Wide v) => new(-v.X, -v.Y);

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide operator *(in Vector2Wide v, Vector<float> scale) => new(v.X * scale, v.Y * scale);

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Dot(in Vector2Wide a, in Vector2Wide b) => a.X * b.X + a.Y * b.Y;

    /// <summary>Inner product with itself.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> LengthSquared() => Dot(this, this);

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> Length() => Vector.SquareRoot(Dot(this, this));

    /// <summary>Picks <paramref name="a"/> where the mask is set, <paramref name="b"/> elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector2Wide Select(Vector<int> mask, in Vector2Wide a, in Vector2Wide b) =>
        new(Wide.Select(mask, a.X, b.X), Wide.Select(mask, a.Y, b.Y));
}
