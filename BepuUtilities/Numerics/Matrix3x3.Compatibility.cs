using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Matrix3x3
{
    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateFromQuaternion(in Quaternion quaternion, out Matrix3x3 result) => result = FromQuaternion(quaternion);

    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 CreateFromQuaternion(in Quaternion quaternion) => FromQuaternion(quaternion);

    /// <summary>Rotation about a unit axis by an angle in radians.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 CreateFromAxisAngle(in Vector3 axis, float angle) => FromQuaternion(QuaternionEx.CreateFromAxisAngle(axis, angle));

    /// <summary>Rotation about a unit axis by an angle in radians.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateFromAxisAngle(Vector3 axis, float angle, out Matrix3x3 result) => result = CreateFromAxisAngle(axis, angle);

    /// <summary>Scale along the axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3 CreateScale(in Vector3 scale) => new(new(scale.X, 0, 0), new(0, scale.Y, 0), new(0, 0, scale.Z));

    /// <summary>Scale along the axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateScale(Vector3 scale, out Matrix3x3 linearTransform) => linearTransform = CreateScale(scale);

    /// <summary>Determinant.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly float Determinant() => Determinant(this);

    /// <summary>The matrix whose product with a column vector u is the cross product v x u.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateCrossProduct(in Vector3 v, out Matrix3x3 result) => result = new(new(0, -v.Z, v.Y), new(v.Z, 0, -v.X), new(-v.Y, v.X, 0));

    /// <summary>Transforms a row vector: v * m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transform(in Vector3 v, in Matrix3x3 m, out Vector3 result) => result = TransposeTimes(m, v);

    /// <summary>Transforms a row vector by the transpose: v * transpose(m).</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformTranspose(in Vector3 v, in Matrix3x3 m, out Vector3 result) => result = m * v;

    /// <summary>Matrix product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Multiply(in Matrix3x3 a, in Matrix3x3 b, out Matrix3x3 result) => result = a * b;

    /// <summary>transpose(a) * b.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void MultiplyTransposed(in Matrix3x3 a, in Matrix3x3 b, out Matrix3x3 result) => result = Transpose(a) * b;

    /// <summary>Sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Add(in Matrix3x3 a, in Matrix3x3 b, out Matrix3x3 result) => result = a + b;

    /// <summary>Difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Subtract(in Matrix3x3 a, in Matrix3x3 b, out Matrix3x3 result) => result = a - b;

    /// <summary>Scaled matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Multiply(in Matrix3x3 m, float scale, out Matrix3x3 result) => result = m * scale;

    /// <summary>Rows exchanged for columns.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transpose(in Matrix3x3 m, out Matrix3x3 transposed) => transposed = Transpose(m);

    /// <summary>Inverse; zero where the determinant is zero.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Invert(in Matrix3x3 m, out Matrix3x3 inverse) => inverse = Invert(m);
}
