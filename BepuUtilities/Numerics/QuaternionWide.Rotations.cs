using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

// Between quaternions, axes and angles.
public partial struct QuaternionWide
{
    /// <summary>Rotation about a unit axis, counterclockwise when seen from its tip; angle in radians.</summary>
    public static QuaternionWide CreateFromAxisAngle(in Vector3Wide axis, Vector<float> angle)
    {
        Wide.SinCos(angle * new Vector<float>(0.5f), out var sin, out var cos);
        return new(axis.X * sin, axis.Y * sin, axis.Z * sin, cos);
    }

    /// <summary>
    /// Axis (unit) and angle in [0, pi] radians of a unit quaternion; the X axis and zero where there is no rotation.
    /// </summary>
    // The arc tangent is accurate for small angles, where the arc cosine of the real part has lost half of its digits.
    public static void GetAxisAngleFromQuaternion(in QuaternionWide q, out Vector3Wide axis, out Vector<float> angle)
    {
        var nearer = Select(Vector.LessThan(q.W, Vector<float>.Zero), -q, q);
        axis = new(nearer.X, nearer.Y, nearer.Z);
        var length = axis.Length();
        var isZero = Vector.Equals(length, Vector<float>.Zero);
        axis = Vector3Wide.Select(isZero, new(Vector<float>.One, Vector<float>.Zero, Vector<float>.Zero), axis * Wide.DivideOrZero(Vector<float>.One, length));
        angle = Wide.Atan2(length, nearer.W) * new Vector<float>(2f);
    }

    /// <summary>
    /// The shortest rotation that takes one unit vector to another; half a turn about an axis square to it where they are opposite.
    /// Off by at most 2e-5 radians up to 0.02 radians short of opposite, by 2e-3 beyond.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static QuaternionWide GetQuaternionBetweenNormalizedVectors(in Vector3Wide from, in Vector3Wide to)
    {
        // (cross, 1 + dot) is twice the half-angle cosine times the wanted quaternion. Close to opposite it is all rounding error:
        // below 1e-6 (an angle of pi - 1.4e-3) the cross product with the axis least aligned gives the half turn instead.
        var cross = Vector3Wide.Cross(from, to);
        var real = Vector<float>.One + Vector3Wide.Dot(from, to);
        var one = Vector<float>.One;
        var zero = Vector<float>.Zero;
        var absolute = Vector3Wide.Abs(from);
        var useX = Vector.LessThan(absolute.X, absolute.Y) & Vector.LessThan(absolute.X, absolute.Z);
        var useY = Vector.LessThan(absolute.Y, absolute.Z);
        var axis = Vector3Wide.Select(useX, new(one, zero, zero), Vector3Wide.Select(useY, new(zero, one, zero), new(zero, zero, one)));
        var isOpposite = Vector.LessThan(real, new Vector<float>(1e-6f));
        var imaginary = Vector3Wide.Select(isOpposite, Vector3Wide.Cross(from, axis), cross);
        return Normalize(new(imaginary.X, imaginary.Y, imaginary.Z, Wide.Select(isOpposite, zero, real)));
    }

    /// <inheritdoc cref="GetQuaternionBetweenNormalizedVectors(in Vector3Wide, in Vector3Wide)"/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void GetQuaternionBetweenNormalizedVectors(in Vector3Wide v1, in Vector3Wide v2, out QuaternionWide q) =>
        q = GetQuaternionBetweenNormalizedVectors(v1, v2);
}
