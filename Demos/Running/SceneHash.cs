using System;
using System.Numerics;

namespace Demos.Running;

/// <summary>
/// A 64-bit hash over the bits of numbers, dependent on their order. Zero and minus zero differ, as do two NaNs of different bits.
/// </summary>
struct SceneHash()
{
    /// <summary>The hash of all that was added.</summary>
    public ulong Value { get; private set; } = 0x9E3779B97F4A7C15;

    public void Add(Vector3 v)
    {
        Add(v.X);
        Add(v.Y);
        Add(v.Z);
    }

    public void Add(Quaternion q)
    {
        Add(q.X);
        Add(q.Y);
        Add(q.Z);
        Add(q.W);
    }

    public void Add(float number) => Add(BitConverter.SingleToUInt32Bits(number));

    public void Add(uint bits)
    {
        // A step of MurmurHash3's finalizer per number: every bit of the input reaches every bit above and below it.
        ulong mixed = (Value ^ bits) * 0xFF51AFD7ED558CCD;
        Value = mixed ^ (mixed >> 32);
    }
}
