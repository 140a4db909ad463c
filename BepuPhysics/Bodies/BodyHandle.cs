using System;

namespace BepuPhysics;

/// <summary>Name of a body for as long as it exists. Never changes, unlike the place of the body in memory.</summary>
public struct BodyHandle(int value) : IEquatable<BodyHandle>
{
    /// <summary>Value that identifies the body; not negative for a body that exists.</summary>
    public int Value = value;

    /// <inheritdoc/>
    public readonly bool Equals(BodyHandle other) => Value == other.Value;
    /// <inheritdoc/>
    public override readonly bool Equals(object? obj) => obj is BodyHandle other && Equals(other);
    /// <inheritdoc/>
    public override readonly int GetHashCode() => Value;
    /// <inheritdoc/>
    public override readonly string ToString() => $"body {Value}";
    /// <summary>Whether both name the same body.</summary>
    public static bool operator ==(BodyHandle a, BodyHandle b) => a.Value == b.Value;
    /// <summary>Whether the two name different bodies.</summary>
    public static bool operator !=(BodyHandle a, BodyHandle b) => a.Value != b.Value;
}
