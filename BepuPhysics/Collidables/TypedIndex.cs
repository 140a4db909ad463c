using System;

namespace BepuPhysics.Collidables;

/// <summary>Names a shape: its type and its index among the shapes of that type. The default names no shape.</summary>
public record struct TypedIndex
{
    /// <summary>Number of shape types that can be told apart.</summary>
    public const int MaximumTypeCount = 1 << TypeBits;
    /// <summary>Number of shapes of one type that can be told apart.</summary>
    public const int MaximumIndexCount = 1 << IndexBits;

    const int TypeBits = 7;
    const int IndexBits = 24;

    /// <summary>Bit 31: a shape is named at all; bits 24 to 30: type; bits 0 to 23: index.</summary>
    public uint Packed;

    /// <summary>Names a shape.</summary>
    /// <param name="type">Type id of the shape, 0 to 127.</param>
    /// <param name="index">Index of the shape in its type's batch, 0 to 2^24 - 1.</param>
    /// <exception cref="ArgumentOutOfRangeException">A value does not fit.</exception>
    public TypedIndex(int type, int index)
    {
        if ((uint)type >= MaximumTypeCount)
            throw new ArgumentOutOfRangeException(nameof(type), type, "A shape type id is from 0 to 127.");
        if ((uint)index >= MaximumIndexCount)
            throw new ArgumentOutOfRangeException(nameof(index), index, "A shape index is from 0 to 2^24 - 1.");
        Packed = 1u << 31 | (uint)type << IndexBits | (uint)index;
    }

    /// <summary>Type id of the shape.</summary>
    public readonly int Type => (int)(Packed >> IndexBits) & (MaximumTypeCount - 1);
    /// <summary>Index of the shape among those of its type.</summary>
    public readonly int Index => (int)Packed & (MaximumIndexCount - 1);
    /// <summary>Whether a shape is named at all.</summary>
    public readonly bool Exists => (Packed & 1u << 31) != 0;

    /// <inheritdoc/>
    public override readonly string ToString() => Exists ? $"shape {Index} of type {Type}" : "no shape";
}
