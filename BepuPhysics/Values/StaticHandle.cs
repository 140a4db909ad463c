namespace BepuPhysics;

/// <summary>Name of a static for as long as it exists. Never changes, unlike the place of the static in memory.</summary>
/// <remarks>
/// No other static gets the same name later: a handle that outlived its static is refused. This holds for the next 255 statics in the same slot;
/// after those the value begins anew.
/// </remarks>
public record struct StaticHandle
{
    internal const int SlotMask = HandleLayout.SlotMask;
    internal const int MaximumValue = (1 << HandleLayout.ValueBits) - 1;

    /// <summary>Value that identifies the static, to be stored and compared; not negative for a static that exists. No index: see <see cref="Slot"/>.</summary>
    public int Value;

    /// <summary>Names what has a value.</summary>
    public StaticHandle(int value) => Value = value;

    /// <summary>
    /// Number that no other static has at the same time, as index into arrays of a game's own. Small: the slot of a static that was removed is the
    /// first to be given out again.
    /// </summary>
    public readonly int Slot => Value & SlotMask;

    /// <inheritdoc/>
    public override readonly string ToString() => HandleLayout.Describe("static", Value);
}
