using System;

namespace BepuPhysics;

/// <summary>Name of a constraint for as long as it exists. Never changes, unlike the place of the constraint in memory.</summary>
/// <remarks>
/// No other constraint gets the same name later: a handle that outlived its constraint is refused. This holds for the next 127 constraints in
/// the same slot; after those the value begins anew.
/// </remarks>
public struct ConstraintHandle(int value) : IEquatable<ConstraintHandle>
{
    internal const int SlotBits = 24;
    internal const int SlotMask = (1 << SlotBits) - 1;
    internal const int ValueBits = 31;

    /// <summary>Value that identifies the constraint, to be stored and compared; not negative for one that exists. No index: see <see cref="Slot"/>.</summary>
    public int Value = value;

    /// <summary>Number that no other constraint has at the same time, as index into arrays of a game's own. Contacts have such numbers too.</summary>
    public readonly int Slot => Value & SlotMask;

    /// <inheritdoc/>
    public readonly bool Equals(ConstraintHandle other) => Value == other.Value;
    /// <inheritdoc/>
    public override readonly bool Equals(object? obj) => obj is ConstraintHandle other && Equals(other);
    /// <inheritdoc/>
    public override readonly int GetHashCode() => Value;
    /// <inheritdoc/>
    public override readonly string ToString() => HandleLayout.Describe("constraint", Value, SlotBits);
    /// <summary>Whether both name the same constraint.</summary>
    public static bool operator ==(ConstraintHandle a, ConstraintHandle b) => a.Value == b.Value;
    /// <summary>Whether the two name different constraints.</summary>
    public static bool operator !=(ConstraintHandle a, ConstraintHandle b) => a.Value != b.Value;
}
