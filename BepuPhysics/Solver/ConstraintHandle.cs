using System;

namespace BepuPhysics;

/// <summary>Name of a constraint for as long as it exists. Never changes, unlike the place of the constraint in memory.</summary>
public struct ConstraintHandle(int value) : IEquatable<ConstraintHandle>
{
    /// <summary>Value that identifies the constraint; not negative for a constraint that exists.</summary>
    public int Value = value;

    /// <inheritdoc/>
    public readonly bool Equals(ConstraintHandle other) => Value == other.Value;
    /// <inheritdoc/>
    public override readonly bool Equals(object? obj) => obj is ConstraintHandle other && Equals(other);
    /// <inheritdoc/>
    public override readonly int GetHashCode() => Value;
    /// <inheritdoc/>
    public override readonly string ToString() => $"constraint {Value}";
    /// <summary>Whether both name the same constraint.</summary>
    public static bool operator ==(ConstraintHandle a, ConstraintHandle b) => a.Value == b.Value;
    /// <summary>Whether the two name different constraints.</summary>
    public static bool operator !=(ConstraintHandle a, ConstraintHandle b) => a.Value != b.Value;
}
