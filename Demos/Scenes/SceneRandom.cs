using System;
using System.Numerics;

namespace Demos.Scenes;

/// <summary>
/// Random numbers that are the same for a seed on every machine and runtime (SplitMix64, Steele, Lea and Flood 2014).
/// </summary>
sealed class SceneRandom(int seed)
{
    ulong state = (ulong)seed * 0xD1342543DE82EF95 + 1;

    /// <summary>A number from zero to below one.</summary>
    public double Next()
    {
        state += 0x9E3779B97F4A7C15;
        ulong mixed = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9;
        mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EB;
        return ((mixed ^ (mixed >> 31)) >> 11) * (1.0 / (1UL << 53));
    }

    /// <summary>A number of a range.</summary>
    public float Next(float minimum, float maximum) => (float)(minimum + Next() * (maximum - minimum));

    /// <summary>A rotation, all equally likely: a point of the unit ball in four dimensions, drawn until it lies inside.</summary>
    public Quaternion NextRotation()
    {
        while (true)
        {
            double x = 2 * Next() - 1, y = 2 * Next() - 1, z = 2 * Next() - 1, w = 2 * Next() - 1;
            double squared = x * x + y * y + z * z + w * w;
            if (squared is > 1 or < 0.01)
                continue;
            double length = Math.Sqrt(squared);
            return new Quaternion((float)(x / length), (float)(y / length), (float)(z / length), (float)(w / length));
        }
    }

    /// <summary>A direction, all equally likely: a point of the unit ball, drawn until it lies inside.</summary>
    public Vector3 NextDirection()
    {
        while (true)
        {
            double x = 2 * Next() - 1, y = 2 * Next() - 1, z = 2 * Next() - 1;
            double squared = x * x + y * y + z * z;
            if (squared is > 1 or < 0.01)
                continue;
            double length = Math.Sqrt(squared);
            return new Vector3((float)(x / length), (float)(y / length), (float)(z / length));
        }
    }
}
