namespace BepuPhysics;

/// <summary>How the value of a body's or static's handle is divided.</summary>
/// <remarks>
/// 30 bits, because a <see cref="Collidables.CollidableReference"/> has as many left beside the mobility. The low bits are the slot, by which
/// everything is found and ordered; the bits above count how often the slot was given up. Results depend on slots alone: that a body had
/// predecessors changes nothing.
/// </remarks>
static class HandleLayout
{
    internal const int SlotBits = 22;
    internal const int SlotMask = (1 << SlotBits) - 1;
    internal const int ValueBits = 30;

    /// <summary>A handle for a reader: its slot, and which one of that slot it is unless it is the first.</summary>
    internal static string Describe(string kind, int value) => Describe(kind, value, SlotBits);

    internal static string Describe(string kind, int value, int slotBits) =>
        value >> slotBits is var generation and > 0 ? $"{kind} {value & ((1 << slotBits) - 1)} (number {generation + 1} of its slot)" : $"{kind} {value}";
}
