using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A bundle of 3D vectors.</summary>
public partial struct Vector3Wide : IWide<Vector3>
{
    /// <summary>First component of every lane.</summary>
    public Vector<float> X;
    /// <summary>Second component of every lane.</summary>
    public Vector<float> Y;
    /// <summary>Third component of every lane.</summary>
    public Vector<float> Z;

    /// <summary>Builds from components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector3Wide(Vector<float> x, Vector<float> y, Vector<float> z)
    {
        X = x;
        Y = y;
        Z = z;
    }

    /// <summary>The same value in every component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector3Wide(Vector<float> value) : this(value, value, value) { }

    /// <summary>Zero in every lane.</summary>
    public static Vector3Wide Zero
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => new(Vector<float>.Zero);
    }

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator +(in Vector3Wide a, in Vector3Wide b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator -(in Vector3Wide a, in Vector3Wide b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

    /// <summary>Opposite.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator -(in Vector3Wide v) => new(-v.X, -v.Y, -v.Z);

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(in Vector3Wide v, Vector<float> scale) => new(v.X * scale, v.Y * scale, v.Z * scale);

    /// <summary>Scaled vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(Vector<float> scale, in Vector3Wide v) => v * scale;

    /// <summary>Product by components.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator *(in Vector3Wide a, in Vector3Wide b) => new(a.X * b.X, a.Y * b.Y, a.Z * b.Z);

    /// <summary>Vector scaled by a reciprocal (one division, three products); infinite or NaN where the divisor is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide operator /(in Vector3Wide v, Vector<float> divisor) => v * (Vector<float>.One / divisor);

    /// <summary>Inner product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Dot(in Vector3Wide a, in Vector3Wide b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

    /// <summary>Cross product, right-handed.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Cross(in Vector3Wide a, in Vector3Wide b) =>
        new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

    /// <summary>Inner product with itself.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> LengthSquared() => Dot(this, this);

    /// <summary>Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> Length() => Vector.SquareRoot(Dot(this, this));

    /// <summary>Vector of length one in the same direction; zero where the squared length is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Normalize(in Vector3Wide v) => v * Wide.DivideOrZero(Vector<float>.One, v.Length());

    /// <summary>Smaller value of each component, as <see cref="Wide.Min(Vector{float}, Vector{float})"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Min(in Vector3Wide a, in Vector3Wide b) => new(Wide.Min(a.X, b.X), Wide.Min(a.Y, b.Y), Wide.Min(a.Z, b.Z));

    /// <summary>Larger value of each component, as <see cref="Wide.Max(Vector{float}, Vector{float})"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Max(in Vector3Wide a, in Vector3Wide b) => new(Wide.Max(a.X, b.X), Wide.Max(a.Y, b.Y), Wide.Max(a.Z, b.Z));

    /// <summary>Components without their signs.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Abs(in Vector3Wide v) => new(Vector.Abs(v.X), Vector.Abs(v.Y), Vector.Abs(v.Z));

    /// <summary>Picks <paramref name="a"/> where the mask is set, <paramref name="b"/> elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Select(Vector<int> mask, in Vector3Wide a, in Vector3Wide b) =>
        new(Wide.Select(mask, a.X, b.X), Wide.Select(mask, a.Y, b.Y), Wide.Select(mask, a.Z, b.Z));

    /// <summary>Keeps the vector where the mask is set, zero elsewhere.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3Wide Mask(Vector<int> mask, in Vector3Wide v) =>
        new(Wide.Mask(mask, v.X), Wide.Mask(mask, v.Y), Wide.Mask(mask, v.Z));

    /// <summary>Two unit vectors that complete a unit vector to a right-handed orthonormal frame (normal, t1, t2).</summary>
    // Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017): without a branch, exact to rounding for every direction.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void BuildOrthonormalBasis(in Vector3Wide normal, out Vector3Wide t1, out Vector3Wide t2)
    {
        var sign = Wide.Sign(normal.Z);
        var scale = -Vector<float>.One / (sign + normal.Z);
        var product = normal.X * normal.Y * scale;
        t1 = new(Vector<float>.One + sign * normal.X * normal.X * scale, sign * product, -sign * normal.X);
        t2 = new(product, sign + normal.Y * normal.Y * scale, -normal.Y);
    }
}
