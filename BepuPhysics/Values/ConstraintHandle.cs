namespace BepuPhysics;

/// <summary>Name of a constraint for as long as it exists. Never changes, unlike the place of the constraint in memory.</summary>
/// <remarks>
/// No other constraint gets the same name later: a handle that outlived its constraint is refused. This holds for the next 127 constraints in
/// the same slot; after those the value begins anew.
/// </remarks>
public record struct ConstraintHandle
{
    internal const int SlotBits = 24;
    internal const int SlotMask = (1 << SlotBits) - 1;
    internal const int ValueBits = 31;

    /// <summary>Value that identifies the constraint, to be stored and compared; not negative for one that exists. No index: see <see cref="Slot"/>.</summary>
    public int Value;

    /// <summary>Names what has a value.</summary>
    public ConstraintHandle(int value) => Value = value;

    /// <summary>Number that no other constraint has at the same time, as index into arrays of a game's own. Contacts have such numbers too.</summary>
    public readonly int Slot => Value & SlotMask;

    /// <inheritdoc/>
    public override readonly string ToString() => HandleLayout.Describe("constraint", Value, SlotBits);
}
