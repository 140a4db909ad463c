namespace BepuPhysics;

/// <summary>Name of a body for as long as it exists. Never changes, unlike the place of the body in memory.</summary>
/// <remarks>
/// No other body gets the same name later: a handle that outlived its body is refused. This holds for the next 255 bodies in the same slot;
/// after those the value begins anew.
/// </remarks>
public record struct BodyHandle
{
    internal const int SlotMask = HandleLayout.SlotMask;
    internal const int MaximumValue = (1 << HandleLayout.ValueBits) - 1;

    /// <summary>Value that identifies the body, to be stored and compared; not negative for a body that exists. No index: see <see cref="Slot"/>.</summary>
    public int Value;

    /// <summary>Names what has a value.</summary>
    public BodyHandle(int value) => Value = value;

    /// <summary>
    /// Number that no other body has at the same time, as index into arrays of a game's own. Small: the slot of a body that was removed is the
    /// first to be given out again.
    /// </summary>
    public readonly int Slot => Value & SlotMask;

    /// <inheritdoc/>
    public override readonly string ToString() => HandleLayout.Describe("body", Value);
}
