using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace BepuPhysics.Characters;

// What a game that goes back in time keeps beside a snapshot of the simulation.
public sealed partial class CharacterControllers
{
    // Says what the bytes are, and changes with the layout of a character.
    const int Format = 0x43480001;

    static int HeaderBytes => 3 * sizeof(int);

    /// <summary>Number of bytes that <see cref="WriteTo"/> writes.</summary>
    public int SerializedByteCount => HeaderBytes + characters.Count * Unsafe.SizeOf<CharacterController>();

    /// <summary>Writes all characters: their goals, and what they stand on.</summary>
    /// <param name="target">At least <see cref="SerializedByteCount"/> bytes.</param>
    /// <exception cref="ArgumentException">There is too little room.</exception>
    public void WriteTo(Span<byte> target)
    {
        if (target.Length < SerializedByteCount)
            throw new ArgumentException($"{SerializedByteCount} bytes are needed and {target.Length} are there.", nameof(target));
        var header = MemoryMarshal.Cast<byte, int>(target[..HeaderBytes]);
        header[0] = Format;
        header[1] = characters.Count;
        header[2] = Unsafe.SizeOf<CharacterController>();
        MemoryMarshal.AsBytes(characters.Span.AsSpan()[..characters.Count]).CopyTo(target[HeaderBytes..]);
    }

    /// <summary>Makes the characters those that were written, after the simulation has been restored to the same step.</summary>
    /// <param name="source">What <see cref="WriteTo"/> has written.</param>
    /// <exception cref="ArgumentException">
    /// The bytes are not those of characters of this library, or two are of one body, or of one that the simulation does not have; nothing was changed.
    /// </exception>
    public void ReadFrom(ReadOnlySpan<byte> source)
    {
        var header = source.Length < HeaderBytes ? default : MemoryMarshal.Cast<byte, int>(source[..HeaderBytes]);
        if (header.IsEmpty || header[0] != Format || header[2] != Unsafe.SizeOf<CharacterController>() || header[1] < 0 ||
            source.Length - HeaderBytes < header[1] * (long)header[2])
            throw new ArgumentException("The bytes are not those of characters of this version of the library.", nameof(source));
        var count = header[1];
        var saved = MemoryMarshal.Cast<byte, CharacterController>(source.Slice(HeaderBytes, count * header[2]));
        int slotCount = 0;
        foreach (ref readonly var character in saved)
        {
            if (!Simulation.Bodies.BodyExists(character.BodyHandle))
                throw new ArgumentException($"The simulation has no {character.BodyHandle}: restore it first.", nameof(source));
            slotCount = Math.Max(slotCount, character.BodyHandle.Slot + 1);
        }
        EnsureCapacity(count, slotCount);
        if (!TryIndex(saved))
        {
            TryIndex(characters.Span.AsSpan()[..characters.Count]);
            throw new ArgumentException("The bytes have two characters of one body.", nameof(source));
        }
        characters.Count = count;
        saved.CopyTo(characters.Span.AsSpan());
    }

    // Notes where each is; not all, where two are of one body.
    bool TryIndex(ReadOnlySpan<CharacterController> list)
    {
        indexOfSlot.Clear(0, indexOfSlot.Length);
        for (int i = 0; i < list.Length; ++i)
        {
            ref var index = ref indexOfSlot[list[i].BodyHandle.Slot];
            if (index != 0)
                return false;
            index = i + 1;
        }
        return true;
    }
}
