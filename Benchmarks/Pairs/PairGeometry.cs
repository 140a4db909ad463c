using System;
using System.Numerics;

namespace Benchmarks.Pairs;

/// <summary>Random directions and rotations.</summary>
static class PairGeometry
{
    /// <summary>A number of a range.</summary>
    public static float Next(Random random, float minimum, float maximum) => minimum + (maximum - minimum) * random.NextSingle();

    /// <summary>A direction, all equally likely: a point of the unit ball, drawn until it lies inside.</summary>
    public static Vector3 NextDirection(Random random)
    {
        while (true)
        {
            var point = new Vector3(Next(random, -1, 1), Next(random, -1, 1), Next(random, -1, 1));
            float squared = point.LengthSquared();
            if (squared is > 0.01f and < 1)
                return point / MathF.Sqrt(squared);
        }
    }

    /// <summary>A rotation, all equally likely: a point of the unit ball in four dimensions, drawn until it lies inside.</summary>
    public static Quaternion NextRotation(Random random)
    {
        while (true)
        {
            var point = new Quaternion(Next(random, -1, 1), Next(random, -1, 1), Next(random, -1, 1), Next(random, -1, 1));
            if (point.LengthSquared() is > 0.01f and < 1)
                return Quaternion.Normalize(point);
        }
    }

    /// <summary>A direction across another.</summary>
    public static Vector3 NextTangent(Random random, Vector3 normal)
    {
        while (true)
        {
            Vector3 tangent = Vector3.Cross(normal, NextDirection(random));
            if (tangent.LengthSquared() > 0.01f)
                return Vector3.Normalize(tangent);
        }
    }

    /// <summary>The rotation that takes a direction and one across it to another such two.</summary>
    public static Quaternion Align(Vector3 normal, Vector3 tangent, Vector3 targetNormal, Vector3 targetTangent)
    {
        Matrix4x4.Invert(Frame(normal, tangent), out Matrix4x4 toFrame);
        return Quaternion.Normalize(Quaternion.CreateFromRotationMatrix(toFrame * Frame(targetNormal, targetTangent)));
    }

    static Matrix4x4 Frame(Vector3 normal, Vector3 tangent)
    {
        Vector3 binormal = Vector3.Cross(normal, tangent);
        return new Matrix4x4(
            normal.X, normal.Y, normal.Z, 0,
            tangent.X, tangent.Y, tangent.Z, 0,
            binormal.X, binormal.Y, binormal.Z, 0,
            0, 0, 0, 1);
    }
}
