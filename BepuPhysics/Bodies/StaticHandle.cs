using System;

namespace BepuPhysics;

/// <summary>Name of a static for as long as it exists. Never changes, unlike the place of the static in memory.</summary>
public struct StaticHandle(int value) : IEquatable<StaticHandle>
{
    /// <summary>Value that identifies the static; not negative for a static that exists.</summary>
    public int Value = value;

    /// <inheritdoc/>
    public readonly bool Equals(StaticHandle other) => Value == other.Value;
    /// <inheritdoc/>
    public override readonly bool Equals(object? obj) => obj is StaticHandle other && Equals(other);
    /// <inheritdoc/>
    public override readonly int GetHashCode() => Value;
    /// <inheritdoc/>
    public override readonly string ToString() => $"static {Value}";
    /// <summary>Whether both name the same static.</summary>
    public static bool operator ==(StaticHandle a, StaticHandle b) => a.Value == b.Value;
    /// <summary>Whether the two name different statics.</summary>
    public static bool operator !=(StaticHandle a, StaticHandle b) => a.Value != b.Value;
}
