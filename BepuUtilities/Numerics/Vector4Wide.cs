using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of 4D vectors.</summary>
public partial struct Vector4Wide : IWide<Vector4>
{
    /// <summary>First component of every lane.</summary>
    public Vector<float> X;
    /// <summary>Second component of every lane.</summary>
    public Vector<float> Y;
    /// <summary>Third component of every lane.</summary>
    public Vector<float> Z;
    /// <summary>Fourth component of every lane.</summary>
    public Vector<float> W;

    /// <summary>Builds from components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector4Wide(Vector<float> x, Vector<float> y, Vector<float> z, Vector<float> w)
    {
        X = x;
        Y = y;
        Z = z;
        W = w;
    }

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector4Wide operator +(in Vector4Wide a, in Vector4Wide b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z, a.W + b.W);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector4Wide operator -(in Vector4Wide a, in Vector4Wide b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z, a.W - b.W);

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector4Wide operator *(in Vector4Wide v, Vector<float> scale) => new(v.X * scale, v.Y * scale, v.Z * scale, v.W * scale);

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Dot(in Vector4Wide a, in Vector4Wide b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z + a.W * b.W;
}
