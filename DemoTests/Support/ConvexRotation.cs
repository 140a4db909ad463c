using System.Numerics;
using Demos.References;

namespace DemoTests.Support;

/// <summary>A rotation in double precision, as the images of the three axes.</summary>
public readonly record struct ConvexRotation(Double3 X, Double3 Y, Double3 Z)
{
    public static readonly ConvexRotation Identity = new(new(1, 0, 0), new(0, 1, 0), new(0, 0, 1));

    public ConvexRotation Transposed => new(new(X.X, Y.X, Z.X), new(X.Y, Y.Y, Z.Y), new(X.Z, Y.Z, Z.Z));

    /// <summary>From a quaternion of floats, which is of unit length only to their rounding: it is normalised here.</summary>
    public static ConvexRotation From(Quaternion orientation)
    {
        double x = orientation.X, y = orientation.Y, z = orientation.Z, w = orientation.W;
        var s = 2 / (x * x + y * y + z * z + w * w);
        return new(
            new(1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
            new(s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w)),
            new(s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y)));
    }

    /// <summary>The axes of B in the frame of A.</summary>
    public static ConvexRotation Between(Quaternion orientationA, Quaternion orientationB)
    {
        var toA = From(orientationA).Transposed;
        var b = From(orientationB);
        return new(toA.Rotate(b.X), toA.Rotate(b.Y), toA.Rotate(b.Z));
    }

    public Double3 Rotate(Double3 v) => X * v.X + Y * v.Y + Z * v.Z;

    public Double3 RotateBack(Double3 v) => new(Double3.Dot(X, v), Double3.Dot(Y, v), Double3.Dot(Z, v));
}
