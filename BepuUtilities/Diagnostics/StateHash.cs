using System;
using System.Buffers.Binary;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace BepuUtilities.Diagnostics;

/// <summary>
/// A 64-bit hash of raw bits in the order in which they are added: equal states have equal hashes on every machine, whatever the
/// sizes of the pieces in which they were added. Not for adversaries.
/// </summary>
/// <remarks>
/// Bytes are collected into little-endian words of eight; each word is mixed in by two multiplications, each step a bijection; the
/// number of bytes and a final avalanche end it. Like FNV-1a in form, with words for bytes, since whole simulations are hashed after each step.
/// </remarks>
public struct StateHash
{
    const ulong Basis = 0xCBF29CE484222325;
    const ulong Factor = 0x9E3779B97F4A7C15;
    const ulong SecondFactor = 0xD6E8FEB86659FD93;

    // Stored as the difference from the basis, so that a default instance is a valid, empty hash.
    ulong state;
    ulong pending;
    ulong byteCount;

    /// <summary>The hash of everything added so far; more may be added afterwards.</summary>
    public readonly ulong Value
    {
        get
        {
            // The pending bytes and the count are mixed in as words of their own: neither can be mistaken for data that follow.
            var hash = Mix(Mix(state ^ Basis, pending), byteCount);
            hash = (hash ^ (hash >> 32)) * Factor;
            hash = (hash ^ (hash >> 29)) * Factor;
            return hash ^ (hash >> 32);
        }
    }

    /// <summary>Adds bytes.</summary>
    public void Add(ReadOnlySpan<byte> bytes)
    {
        while (bytes.Length > 0)
        {
            var filled = (int)(byteCount & 7);
            if (filled == 0 && bytes.Length >= sizeof(ulong))
            {
                state = Mix(state ^ Basis, ReadWord(bytes)) ^ Basis;
                byteCount += sizeof(ulong);
                bytes = bytes[sizeof(ulong)..];
                continue;
            }
            pending |= (ulong)bytes[0] << (filled * 8);
            ++byteCount;
            bytes = bytes[1..];
            if (filled == 7)
            {
                state = Mix(state ^ Basis, pending) ^ Basis;
                pending = 0;
            }
        }
    }

    /// <summary>
    /// Adds the raw bits of a value. Padding bytes count: use it for types without padding, or with padding that is kept at zero.
    /// </summary>
    public void Add<T>(in T value) where T : unmanaged => Add(MemoryMarshal.AsBytes(new ReadOnlySpan<T>(in value)));

    // One multiplication carries a change upwards only: a flipped top bit would stay one bit, and a later word could undo it.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static ulong Mix(ulong hash, ulong word)
    {
        var product = (hash ^ word) * Factor;
        product ^= product >> 32;
        return BitOperations.RotateLeft(product * SecondFactor, 27);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static ulong ReadWord(ReadOnlySpan<byte> bytes) => BinaryPrimitives.ReadUInt64LittleEndian(bytes);
}
