using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.InteropServices;

namespace Demos.Fuzz;

/// <summary>Random values, good ones and bad ones, the same for a seed everywhere (SplitMix64, Steele, Lea and Flood 2014).</summary>
sealed class FuzzRandom(ulong seed)
{
    /// <summary>Values with which something once went wrong, or might.</summary>
    static readonly float[] badNumbers =
    [
        float.NaN, float.PositiveInfinity, float.NegativeInfinity, float.MaxValue, float.MinValue, float.Epsilon, -float.Epsilon, 0, -0f, 1, -1,
        1e-40f, 1e-30f, 1e-20f, 1e-10f, 1e-7f, 1e7f, 1e10f, 1e13f, 1e20f, 1e30f, -1e7f, -1e20f, -1e30f, 0.5f, 2, 1000,
    ];

    static readonly int[] badCounts =
        [0, 1, 2, 3, 7, 8, 16, 64, 100, -1, -2, -1000, int.MinValue, int.MinValue + 1];

    ulong state = seed;

    /// <summary>Any 64 bits.</summary>
    public ulong NextBits()
    {
        state += 0x9E3779B97F4A7C15;
        ulong mixed = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9;
        mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EB;
        return mixed ^ (mixed >> 31);
    }

    /// <summary>A seed for another sequence.</summary>
    public static ulong Mix(ulong seed, ulong number) => new FuzzRandom(seed ^ (number * 0xD1342543DE82EF95 + 1)).NextBits();

    /// <summary>From 0 to below a count.</summary>
    public int Below(int count) => (int)(NextBits() % (ulong)count);

    /// <summary>True so many times in a hundred.</summary>
    public bool Percent(int percent) => Below(100) < percent;

    /// <summary>One of some.</summary>
    public T Of<T>(ReadOnlySpan<T> values) => values[Below(values.Length)];

    /// <summary>One of a list that is not empty.</summary>
    public T Of<T>(List<T> values) => values[Below(values.Count)];

    public float Number(float minimum, float maximum) => minimum + (NextBits() >> 40) * (1f / (1 << 24)) * (maximum - minimum);

    /// <summary>From a minimum to a maximum, each power of ten as likely as the others.</summary>
    public float Magnitude(float minimum, float maximum) => minimum * MathF.Pow(maximum / minimum, Number(0, 1));

    public Vector3 Vector(float size) => new(Number(-size, size), Number(-size, size), Number(-size, size));

    public Vector3 Direction()
    {
        Vector3 v = Vector(1);
        return v.LengthSquared() > 0.01f ? Vector3.Normalize(v) : Vector3.UnitY;
    }

    public Quaternion Turn() => Percent(30) ? Quaternion.Identity : Quaternion.CreateFromAxisAngle(Direction(), Number(-4, 4));

    /// <summary>A number that is seldom good.</summary>
    public float Bad() => Percent(80) ? Of<float>(badNumbers) : BitConverter.UInt32BitsToSingle((uint)NextBits());

    /// <summary>A count, at times a bad one; never so large that it would only tell how much memory there is.</summary>
    public int Count() => Percent(70) ? Below(70) : Of<int>(badCounts);

    /// <summary>Any bits at all.</summary>
    public int Bits() => (int)NextBits();

    /// <summary>At times, writes a bad number or any bits to some place of a value, whatever is there.</summary>
    public T Spoil<T>(T value, int percent = 12) where T : unmanaged
    {
        Span<uint> words = MemoryMarshal.Cast<byte, uint>(MemoryMarshal.AsBytes(new Span<T>(ref value)));
        while (words.Length > 0 && Percent(percent))
            words[Below(words.Length)] = Percent(85) ? BitConverter.SingleToUInt32Bits(Bad()) : (uint)NextBits();
        return value;
    }
}
