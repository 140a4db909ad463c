using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>Quaternion operations under the names that games use, with the same bits on every machine (see <see cref="Exact"/>).</summary>
public static class QuaternionEx
{
    /// <summary>The rotation that changes nothing.</summary>
    public static Quaternion Identity => new(0, 0, 0, 1);

    /// <summary>Sum of components.</summary>
    public static void Add(in Quaternion a, in Quaternion b, out Quaternion result) => result = new(a.X + b.X, a.Y + b.Y, a.Z + b.Z, a.W + b.W);

    /// <summary>Scaled components.</summary>
    public static void Scale(in Quaternion q, float scale, out Quaternion result) => result = new(q.X * scale, q.Y * scale, q.Z * scale, q.W * scale);

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quaternion Concatenate(in Quaternion a, in Quaternion b) => Exact.Concatenate(a, b);

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>; the result may be an operand.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Concatenate(in Quaternion a, in Quaternion b, out Quaternion result) => result = Exact.Concatenate(a, b);

    /// <summary>The rotation that applies <paramref name="a"/> first, then <paramref name="b"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ConcatenateWithoutOverlap(in Quaternion a, in Quaternion b, out Quaternion result) => result = Exact.Concatenate(a, b);

    /// <summary>The reverse rotation of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Quaternion Conjugate(in Quaternion q) => Exact.Conjugate(q);

    /// <summary>The reverse rotation of a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Conjugate(in Quaternion q, out Quaternion result) => result = Exact.Conjugate(q);

    /// <summary>The quaternion that undoes another of any length; zero for zero.</summary>
    public static Quaternion Inverse(in Quaternion q)
    {
        var lengthSquared = Exact.Dot(q, q);
        var scale = lengthSquared == 0 ? 0 : 1 / lengthSquared;
        return new(-q.X * scale, -q.Y * scale, -q.Z * scale, q.W * scale);
    }

    /// <summary>The quaternion that undoes another of any length; zero for zero.</summary>
    public static void Inverse(in Quaternion q, out Quaternion result) => result = Inverse(q);

    /// <summary>Opposite components: the same rotation by the other quaternion.</summary>
    public static Quaternion Negate(in Quaternion q) => new(-q.X, -q.Y, -q.Z, -q.W);

    /// <summary>Opposite components: the same rotation by the other quaternion.</summary>
    public static void Negate(in Quaternion q, out Quaternion result) => result = Negate(q);

    /// <summary>Quaternion of length one; the identity for zero.</summary>
    public static Quaternion Normalize(Quaternion q) => Exact.Normalize(q);

    /// <summary>Scales a quaternion to length one; the identity for zero.</summary>
    public static void Normalize(ref Quaternion q) => q = Exact.Normalize(q);

    /// <summary>Euclidean length of the components.</summary>
    public static float Length(in Quaternion q) => MathF.Sqrt(Exact.Dot(q, q));

    /// <summary>Squared length of the components.</summary>
    public static float LengthSquared(in Quaternion q) => Exact.Dot(q, q);

    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector3 Transform(in Vector3 v, in Quaternion rotation) => Exact.Rotate(v, rotation);

    /// <summary>Rotates a vector by a unit quaternion; the result may be the vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transform(in Vector3 v, in Quaternion rotation, out Vector3 result) => result = Exact.Rotate(v, rotation);

    /// <summary>Rotates a vector by a unit quaternion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void TransformWithoutOverlap(in Vector3 v, in Quaternion rotation, out Vector3 result) => result = Exact.Rotate(v, rotation);

    /// <summary>Where a unit quaternion takes the X axis.</summary>
    public static Vector3 TransformUnitX(in Quaternion rotation) => Matrix3x3.FromQuaternion(rotation).X;

    /// <summary>Where a unit quaternion takes the Y axis.</summary>
    public static Vector3 TransformUnitY(in Quaternion rotation) => Matrix3x3.FromQuaternion(rotation).Y;

    /// <summary>Where a unit quaternion takes the Z axis.</summary>
    public static Vector3 TransformUnitZ(in Quaternion rotation) => Matrix3x3.FromQuaternion(rotation).Z;

    /// <summary>Where a unit quaternion takes the X axis.</summary>
    public static void TransformUnitX(in Quaternion rotation, out Vector3 result) => result = TransformUnitX(rotation);

    /// <summary>Where a unit quaternion takes the Y axis.</summary>
    public static void TransformUnitY(in Quaternion rotation, out Vector3 result) => result = TransformUnitY(rotation);

    /// <summary>Where a unit quaternion takes the Z axis.</summary>
    public static void TransformUnitZ(in Quaternion rotation, out Vector3 result) => result = TransformUnitZ(rotation);

    /// <summary>Where a unit quaternion takes the X and the Y axis.</summary>
    public static void TransformUnitXY(in Quaternion rotation, out Vector3 x, out Vector3 y)
    {
        var axes = Matrix3x3.FromQuaternion(rotation);
        x = axes.X;
        y = axes.Y;
    }

    /// <summary>Where a unit quaternion takes the X and the Z axis.</summary>
    public static void TransformUnitXZ(in Quaternion rotation, out Vector3 x, out Vector3 z)
    {
        var axes = Matrix3x3.FromQuaternion(rotation);
        x = axes.X;
        z = axes.Z;
    }

    /// <summary>Where a unit quaternion takes the Y and the Z axis.</summary>
    public static void TransformUnitYZ(in Quaternion rotation, out Vector3 y, out Vector3 z)
    {
        var axes = Matrix3x3.FromQuaternion(rotation);
        y = axes.Y;
        z = axes.Z;
    }

    /// <summary>Rotation about a unit axis, counterclockwise when seen from its tip; angle in radians.</summary>
    public static Quaternion CreateFromAxisAngle(in Vector3 axis, float angle)
    {
        MathHelper.SinCos(angle * 0.5f, out var sin, out var cos);
        return new(axis.X * sin, axis.Y * sin, axis.Z * sin, cos);
    }

    /// <summary>Rotation about a unit axis, counterclockwise when seen from its tip; angle in radians.</summary>
    public static void CreateFromAxisAngle(in Vector3 axis, float angle, out Quaternion q) => q = CreateFromAxisAngle(axis, angle);

    /// <summary>Roll about Z first, then pitch about X, then yaw about Y (fixed axes); angles in radians.</summary>
    public static Quaternion CreateFromYawPitchRoll(float yaw, float pitch, float roll)
    {
        MathHelper.SinCos(yaw * 0.5f, out var sinYaw, out var cosYaw);
        MathHelper.SinCos(pitch * 0.5f, out var sinPitch, out var cosPitch);
        MathHelper.SinCos(roll * 0.5f, out var sinRoll, out var cosRoll);
        var tilt = Exact.Concatenate(new(0, 0, sinRoll, cosRoll), new(sinPitch, 0, 0, cosPitch));
        return Exact.Concatenate(tilt, new(0, sinYaw, 0, cosYaw));
    }

    /// <summary>Roll about Z first, then pitch about X, then yaw about Y (fixed axes); angles in radians.</summary>
    public static void CreateFromYawPitchRoll(float yaw, float pitch, float roll, out Quaternion q) => q = CreateFromYawPitchRoll(yaw, pitch, roll);

    /// <summary>The unit quaternion of a rotation matrix whose rows are the rotated axes.</summary>
    // The largest of the four components is found first (its square is at least a quarter), and the others by division by it.
    public static Quaternion CreateFromRotationMatrix(in Matrix3x3 r)
    {
        Quaternion q;
        if (r.X.X + r.Y.Y + r.Z.Z >= 0)
            q = new(r.Y.Z - r.Z.Y, r.Z.X - r.X.Z, r.X.Y - r.Y.X, 1 + r.X.X + r.Y.Y + r.Z.Z);
        else if (r.X.X >= r.Y.Y && r.X.X >= r.Z.Z)
            q = new(1 + r.X.X - r.Y.Y - r.Z.Z, r.X.Y + r.Y.X, r.X.Z + r.Z.X, r.Y.Z - r.Z.Y);
        else if (r.Y.Y >= r.Z.Z)
            q = new(r.X.Y + r.Y.X, 1 - r.X.X + r.Y.Y - r.Z.Z, r.Y.Z + r.Z.Y, r.Z.X - r.X.Z);
        else
            q = new(r.X.Z + r.Z.X, r.Y.Z + r.Z.Y, 1 - r.X.X - r.Y.Y + r.Z.Z, r.X.Y - r.Y.X);
        return Exact.Normalize(q);
    }

    /// <summary>The unit quaternion of a rotation matrix whose rows are the rotated axes.</summary>
    public static void CreateFromRotationMatrix(in Matrix3x3 r, out Quaternion q) => q = CreateFromRotationMatrix(r);

    /// <inheritdoc cref="QuaternionWide.GetQuaternionBetweenNormalizedVectors(in Vector3Wide, in Vector3Wide)"/>
    public static Quaternion GetQuaternionBetweenNormalizedVectors(in Vector3 from, in Vector3 to) =>
        FirstLane(QuaternionWide.GetQuaternionBetweenNormalizedVectors(Vector3Wide.Broadcast(from), Vector3Wide.Broadcast(to)));

    /// <inheritdoc cref="GetQuaternionBetweenNormalizedVectors(in Vector3, in Vector3)"/>
    public static void GetQuaternionBetweenNormalizedVectors(in Vector3 v1, in Vector3 v2, out Quaternion q) =>
        q = GetQuaternionBetweenNormalizedVectors(v1, v2);

    /// <summary>Angle in [0, pi] radians by which a unit quaternion rotates.</summary>
    public static float GetAngleFromQuaternion(in Quaternion q)
    {
        GetAxisAngleFromQuaternion(q, out _, out var angle);
        return angle;
    }

    /// <summary>Axis (unit) and angle in [0, pi] radians of a unit quaternion; the X axis and zero if there is no rotation.</summary>
    public static void GetAxisAngleFromQuaternion(in Quaternion q, out Vector3 axis, out float angle)
    {
        QuaternionWide.GetAxisAngleFromQuaternion(QuaternionWide.Broadcast(q), out var wideAxis, out var wideAngle);
        Vector3Wide.ReadFirst(wideAxis, out axis);
        angle = wideAngle.ToScalar();
    }

    /// <summary>The rotation from <paramref name="start"/> to <paramref name="end"/>, both in world axes: start * relative = end.</summary>
    public static void GetRelativeRotation(in Quaternion start, in Quaternion end, out Quaternion relative) =>
        relative = Exact.Concatenate(Exact.Conjugate(start), end);

    /// <summary>The rotation from <paramref name="start"/> to <paramref name="end"/>, both in world axes: start * relative = end.</summary>
    public static void GetRelativeRotationWithoutOverlap(in Quaternion start, in Quaternion end, out Quaternion relative) =>
        GetRelativeRotation(start, end, out relative);

    /// <summary>A rotation as it is seen from a basis: local * basis = rotation.</summary>
    public static void GetLocalRotationWithoutOverlap(in Quaternion rotation, in Quaternion targetBasis, out Quaternion localRotation) =>
        localRotation = Exact.Concatenate(rotation, Exact.Conjugate(targetBasis));

    /// <summary>Rotation between two unit quaternions by a constant rate along the shorter way; amount 0 gives the start, 1 the end.</summary>
    public static Quaternion Slerp(in Quaternion start, in Quaternion end, float interpolationAmount)
    {
        var target = Exact.Dot(start, end) < 0 ? Negate(end) : end;

        // Half the angle between the quaternions from the lengths of sum and difference: accurate at both ends of the range, where
        // the arc cosine of the dot product is not.
        var sum = new Quaternion(start.X + target.X, start.Y + target.Y, start.Z + target.Z, start.W + target.W);
        var difference = new Quaternion(target.X - start.X, target.Y - start.Y, target.Z - start.Z, target.W - start.W);
        var angle = 2 * MathHelper.Atan2(Length(difference), Length(sum));
        var sin = MathHelper.Sin(angle);

        // Below this angle the sines are their arguments to rounding, and the rotation is linear.
        var isLinear = angle < 1e-3f;
        var weightA = isLinear ? 1 - interpolationAmount : MathHelper.Sin((1 - interpolationAmount) * angle) / sin;
        var weightB = isLinear ? interpolationAmount : MathHelper.Sin(interpolationAmount * angle) / sin;
        return Exact.Normalize(new Quaternion(
            start.X * weightA + target.X * weightB, start.Y * weightA + target.Y * weightB,
            start.Z * weightA + target.Z * weightB, start.W * weightA + target.W * weightB));
    }

    /// <inheritdoc cref="Slerp(in Quaternion, in Quaternion, float)"/>
    public static void Slerp(in Quaternion start, in Quaternion end, float interpolationAmount, out Quaternion result) =>
        result = Slerp(start, end, interpolationAmount);

    static Quaternion FirstLane(in QuaternionWide q)
    {
        QuaternionWide.ReadFirst(q, out var result);
        return result;
    }
}
