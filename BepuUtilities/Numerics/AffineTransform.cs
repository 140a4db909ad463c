using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>A linear map followed by a translation, on row vectors: p * LinearTransform + Translation.</summary>
public struct AffineTransform
{
    /// <summary>Moved by, after the linear map.</summary>
    public Vector3 Translation;
    /// <summary>Rotation, scale and shear.</summary>
    public Matrix3x3 LinearTransform;

    /// <summary>Builds from the two parts.</summary>
    public AffineTransform(in Matrix3x3 linearTransform, in Vector3 translation)
    {
        LinearTransform = linearTransform;
        Translation = translation;
    }

    /// <summary>Rotation by a unit quaternion, then translation.</summary>
    public AffineTransform(in Quaternion orientation, in Vector3 translation) : this(Matrix3x3.FromQuaternion(orientation), translation) { }

    /// <summary>Scale along the axes, rotation by a unit quaternion, then translation.</summary>
    public AffineTransform(in Vector3 scaling, in Quaternion orientation, in Vector3 translation)
        : this(Matrix3x3.CreateScale(scaling) * Matrix3x3.FromQuaternion(orientation), translation) { }

    /// <summary>Leaves points where they are.</summary>
    public static AffineTransform Identity => new(Matrix3x3.Identity, default(Vector3));

    /// <summary>Transforms a point.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Transform(in Vector3 position, in AffineTransform transform, out Vector3 transformed) =>
        transformed = Matrix3x3.TransposeTimes(transform.LinearTransform, position) + transform.Translation;

    /// <summary>The transform that applies <paramref name="a"/> first, then <paramref name="b"/>.</summary>
    public static void Multiply(in AffineTransform a, in AffineTransform b, out AffineTransform transform)
    {
        Transform(a.Translation, b, out var translation);
        transform = new(a.LinearTransform * b.LinearTransform, translation);
    }

    /// <summary>The transform that undoes another; a zero linear part where the determinant is zero.</summary>
    public static void Invert(in AffineTransform transform, out AffineTransform inverse)
    {
        var linear = Matrix3x3.Invert(transform.LinearTransform);
        inverse = new(linear, -Matrix3x3.TransposeTimes(linear, transform.Translation));
    }
}
