using System;
using System.Numerics;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Repeatable random numbers for poses: the generator of O'Neill's PCG family with 64 bits of state.</summary>
public sealed class ConvexRandom(ulong seed, ulong stream = 0)
{
    ulong state = (seed + stream * 0x9E3779B97F4A7C15) * 6364136223846793005 + 1442695040888963407;

    uint NextBits()
    {
        state = state * 6364136223846793005 + 1442695040888963407;
        var shifted = (uint)((state >> 18 ^ state) >> 27);
        return BitOperations.RotateRight(shifted, (int)(state >> 59));
    }

    /// <summary>From 0 to 1, without 1.</summary>
    public double Next() => (NextBits() * 4294967296.0 + NextBits()) / 18446744073709551616.0;

    public double Next(double min, double max) => min + (max - min) * Next();

    public int Next(int count) => (int)(Next() * count);

    /// <summary>Even in its logarithm.</summary>
    public double NextLogarithmic(double min, double max) => min * Math.Pow(max / min, Next());

    public Double3 NextDirection()
    {
        var y = Next(-1, 1);
        var ring = Math.Sqrt(Math.Max(0, 1 - y * y));
        var angle = Next(0, 2 * Math.PI);
        return new(ring * Math.Cos(angle), y, ring * Math.Sin(angle));
    }

    public Quaternion NextOrientation()
    {
        double a = Next(), b = Next(0, 2 * Math.PI), c = Next(0, 2 * Math.PI);
        double p = Math.Sqrt(1 - a), q = Math.Sqrt(a);
        return new((float)(p * Math.Sin(b)), (float)(p * Math.Cos(b)), (float)(q * Math.Sin(c)), (float)(q * Math.Cos(c)));
    }

    /// <summary>A rotation by multiples of an eighth of a turn around the axes.</summary>
    public Quaternion NextAligned()
    {
        var q = DoubleQuaternion.Identity;
        for (int i = Next(4); i > 0; --i)
        {
            var axis = Next(3);
            q *= DoubleQuaternion.FromAxisAngle(new(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0), Next(8) * Math.PI / 4);
        }
        return new((float)q.X, (float)q.Y, (float)q.Z, (float)q.W);
    }
}
