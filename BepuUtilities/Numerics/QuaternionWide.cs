using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of quaternions; where one stands for a rotation its length is one.</summary>
public partial struct QuaternionWide : IWide<Quaternion>
{
    /// <summary>First imaginary component.</summary>
    public Vector<float> X;
    /// <summary>Second imaginary component.</summary>
    public Vector<float> Y;
    /// <summary>Third imaginary component.</summary>
    public Vector<float> Z;
    /// <summary>Real part.</summary>
    public Vector<float> W;

    /// <summary>Builds from components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public QuaternionWide(Vector<float> x, Vector<float> y, Vector<float> z, Vector<float> w)
    {
        X = x;
        Y = y;
        Z = z;
        W = w;
    }

    /// <summary>No rotation in every lane.</summary>
    public static QuaternionWide Identity
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => new(Vector<float>.Zero, Vector<float>.Zero, Vector<float>.Zero, Vector<float>.One);
    }

    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(in QuaternionWide q, in Vector3Wide v)
    {
        var axis = new Vector3Wide(q.X, q.Y, q.Z);
        var t = Vector3Wide.Cross(axis, v);
        t += t;
        return v + t * q.W + Vector3Wide.Cross(axis, t);
    }

    /// <summary>What a vector changes by when it is rotated by a unit quaternion: exact to a part of the change, not of the vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Displacement(in QuaternionWide q, in Vector3Wide v)
    {
        var axis = new Vector3Wide(q.X, q.Y, q.Z);
        var t = Vector3Wide.Cross(axis, v);
        t += t;
        return t * q.W + Vector3Wide.Cross(axis, t);
    }

    /// <summary>Sum of components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide operator +(in QuaternionWide a, in QuaternionWide b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z, a.W + b.W);

    /// <summary>Scaled components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide operator *(in QuaternionWide q, Vector<float> scale) => new(q.X * scale, q.Y * scale, q.Z * scale, q.W * scale);

    /// <summary>Opposite components: the same rotation by the other quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide operator -(in QuaternionWide q) => new(-q.X, -q.Y, -q.Z, -q.W);

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide Concatenate(in QuaternionWide a, in QuaternionWide b) => new(
        a.W * b.X + a.X * b.W + a.Z * b.Y - a.Y * b.Z,
        a.W * b.Y + a.Y * b.W + a.X * b.Z - a.Z * b.X,
        a.W * b.Z + a.Z * b.W + a.Y * b.X - a.X * b.Y,
        a.W * b.W - a.X * b.X - a.Y * b.Y - a.Z * b.Z);

    /// <summary>The reverse rotation of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide Conjugate(in QuaternionWide q) => new(-q.X, -q.Y, -q.Z, q.W);

    /// <summary>Inner product of components: cosine of half the angle between two unit quaternions.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Dot(in QuaternionWide a, in QuaternionWide b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z + a.W * b.W;

    /// <summary>Inner product with itself.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> LengthSquared() => Dot(this, this);

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> Length() => Vector.SquareRoot(Dot(this, this));

    /// <summary>Quaternion of length one; the identity where the squared length is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide Normalize(in QuaternionWide q)
    {
        var length = q.Length();
        return Select(Vector.Equals(length, Vector<float>.Zero), Identity, q * (Vector<float>.One / length));
    }

    /// <summary>Where a unit quaternion takes the X axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide TransformUnitX(in QuaternionWide q)
    {
        var y2 = q.Y + q.Y;
        var z2 = q.Z + q.Z;
        return new(Vector<float>.One - (q.Y * y2 + q.Z * z2), q.X * y2 + q.W * z2, q.X * z2 - q.W * y2);
    }

    /// <summary>Where a unit quaternion takes the Y axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide TransformUnitY(in QuaternionWide q)
    {
        var x2 = q.X + q.X;
        var y2 = q.Y + q.Y;
        var z2 = q.Z + q.Z;
        return new(q.X * y2 - q.W * z2, Vector<float>.One - (q.X * x2 + q.Z * z2), q.Y * z2 + q.W * x2);
    }

    /// <summary>Where a unit quaternion takes the Z axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide TransformUnitZ(in QuaternionWide q)
    {
        var x2 = q.X + q.X;
        var y2 = q.Y + q.Y;
        var z2 = q.Z + q.Z;
        return new(q.X * z2 + q.W * y2, q.Y * z2 - q.W * x2, Vector<float>.One - (q.X * x2 + q.Y * y2));
    }

    /// <summary>Picks <paramref name="a"/> where the mask is set, <paramref name="b"/> elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide Select(Vector<int> mask, in QuaternionWide a, in QuaternionWide b) =>
        new(Wide.Select(mask, a.X, b.X), Wide.Select(mask, a.Y, b.Y), Wide.Select(mask, a.Z, b.Z), Wide.Select(mask, a.W, b.W));
}
