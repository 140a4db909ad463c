using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace DemoTests.Numerics;

/// <summary>Random wide structs, and their lanes as doubles. Seeds are fixed: a failure can be run again.</summary>
sealed class WideSamples(int seed)
{
    readonly Random random = new(seed);

    public float Number(float scale = 1) => (float)(random.NextDouble() * 2 - 1) * scale;

    public float Positive(float minimum, float maximum) => (float)(minimum * Math.Pow((double)maximum / minimum, random.NextDouble()));

    public int Integer(int end) => random.Next(end);

    public Vector3 Vector(float scale = 1) => new(Number(scale), Number(scale), Number(scale));

    public Quaternion Rotation()
    {
        while (true)
        {
            var q = new Quaternion(Number(), Number(), Number(), Number());
            var lengthSquared = (double)q.X * q.X + (double)q.Y * q.Y + (double)q.Z * q.Z + (double)q.W * q.W;
            if (lengthSquared is < 0.01 or > 1)
                continue;
            var scale = (float)(1 / Math.Sqrt(lengthSquared));
            return new(q.X * scale, q.Y * scale, q.Z * scale, q.W * scale);
        }
    }

    public Matrix3x3 Matrix(float scale = 1) => new(Vector(scale), Vector(scale), Vector(scale));

    /// <summary>Positive definite with eigenvalues between one and about ten, times a scale.</summary>
    public Symmetric3x3 Definite(float scale = 1)
    {
        var m = Matrix();
        return new(
            (1 + Square(m.X)) * scale,
            Dot(m.Y, m.X) * scale, (1 + Square(m.Y)) * scale,
            Dot(m.Z, m.X) * scale, Dot(m.Z, m.Y) * scale, (1 + Square(m.Z)) * scale);
    }

    /// <summary>A wide struct whose every lane is a sample of its own.</summary>
    public static TWide Bundle<TScalar, TWide>(Func<TScalar> sample) where TScalar : unmanaged where TWide : unmanaged, IWide<TScalar>
    {
        Unsafe.SkipInit(out TWide result);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
            Lanes.Write(sample(), ref result, lane);
        return result;
    }

    public Vector3Wide Vectors(float scale = 1) => Bundle<Vector3, Vector3Wide>(() => Vector(scale));

    public QuaternionWide Rotations() => Bundle<Quaternion, QuaternionWide>(Rotation);

    public Matrix3x3Wide Matrices() => Bundle<Matrix3x3, Matrix3x3Wide>(() => Matrix());

    public Symmetric3x3Wide Definites(float scale = 1) => Bundle<Symmetric3x3, Symmetric3x3Wide>(() => Definite(scale));

    public Vector<float> Numbers(float scale = 1)
    {
        Span<float> values = stackalloc float[Vector<float>.Count];
        foreach (ref var value in values)
            value = Number(scale);
        return new(values);
    }

    /// <summary>The floats of one lane, in order of the fields.</summary>
    public static double[] Lane<T>(T wide, int lane) where T : unmanaged
    {
        var result = new double[Unsafe.SizeOf<T>() / Unsafe.SizeOf<Vector<float>>()];
        for (int i = 0; i < result.Length; ++i)
            result[i] = Unsafe.Add(ref Unsafe.As<T, float>(ref wide), i * Vector<float>.Count + lane);
        return result;
    }

    static float Square(Vector3 v) => Dot(v, v);

    static float Dot(Vector3 a, Vector3 b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;
}
