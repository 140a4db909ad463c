using System;
using System.Numerics;

namespace DemoTests.CollisionDetection;

/// <summary>Repeatable random numbers: SplitMix64 by S. Vigna.</summary>
struct PairRandom(ulong seed)
{
    ulong state = seed;

    public ulong NextBits()
    {
        var z = state += 0x9E3779B97F4A7C15;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27) * 0x94D049BB133111EB;
        return z ^ z >> 31;
    }

    /// <summary>From 0 to 1.</summary>
    public double Next() => (NextBits() >> 11) * (1.0 / (1L << 53));

    public float Next(double min, double max) => (float)(min + (max - min) * Next());

    public int Next(int count) => (int)(NextBits() % (ulong)count);

    /// <summary>Even in its logarithm.</summary>
    public float NextLogarithmic(double min, double max) => (float)(min * Math.Pow(max / min, Next()));

    public Vector3 NextDirection()
    {
        while (true)
        {
            var v = new Vector3(Next(-1, 1), Next(-1, 1), Next(-1, 1));
            var length = v.Length();
            if (length is > 0.1f and < 1)
                return v / length;
        }
    }

    public Quaternion NextOrientation()
    {
        while (true)
        {
            var q = new Quaternion(Next(-1, 1), Next(-1, 1), Next(-1, 1), Next(-1, 1));
            if (q.Length() is > 0.1f and < 1)
                return Quaternion.Normalize(q);
        }
    }

    /// <summary>A rotation by quarters of a turn, and a little beyond.</summary>
    public Quaternion NextAligned(double angle)
    {
        var q = Quaternion.CreateFromAxisAngle(NextDirection(), (float)angle);
        for (int i = Next(4); i > 0; --i)
            q *= Quaternion.CreateFromAxisAngle(i == 1 ? Vector3.UnitX : i == 2 ? Vector3.UnitY : Vector3.UnitZ, MathF.PI / 2);
        return Quaternion.Normalize(q);
    }
}

/// <summary>Poses of a pair of two shapes.</summary>
readonly record struct PairCase<TShapeA, TShapeB>(TShapeA A, TShapeB B, Vector3 OffsetB, Quaternion OrientationA, Quaternion OrientationB)
{
    /// <summary>The same pair, the shapes in the other order.</summary>
    public PairCase<TShapeB, TShapeA> Swap() => new(B, A, -OffsetB, OrientationB, OrientationA);
}

/// <summary>Ways in which a pair can lie.</summary>
enum PairKind
{
    Apart,
    Touching,
    Shallow,
    Deep,
    Concentric,
    ParallelShallow,
    ParallelDeep,
    NearlyParallel,
}
