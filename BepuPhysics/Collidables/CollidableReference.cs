using System;
using System.Diagnostics.CodeAnalysis;

namespace BepuPhysics.Collidables;

/// <summary>Names a body or a static as the collision detection sees it.</summary>
public record struct CollidableReference
{
    const int MobilityShift = 30;

    /// <summary>Bits 30 and 31: mobility; bits 0 to 29: value of the body's or static's handle.</summary>
    public uint Packed;

    /// <summary>Names a body.</summary>
    /// <param name="mobility">Dynamic or kinematic.</param>
    /// <param name="handle">The body.</param>
    /// <exception cref="ArgumentOutOfRangeException">The handle's value is none that a body can have.</exception>
    public CollidableReference(CollidableMobility mobility, BodyHandle handle) => Packed = (uint)mobility << MobilityShift | Fitting(handle.Value);

    /// <summary>Names a static.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The handle's value is none that a static can have.</exception>
    public CollidableReference(StaticHandle handle) => Packed = (uint)CollidableMobility.Static << MobilityShift | Fitting(handle.Value);

    /// <summary>How the collidable moves.</summary>
    public readonly CollidableMobility Mobility => (CollidableMobility)(Packed >> MobilityShift);
    /// <summary>The body; meaningless for a static.</summary>
    public readonly BodyHandle BodyHandle => new(RawHandleValue);
    /// <summary>The static; meaningless for a body.</summary>
    public readonly StaticHandle StaticHandle => new(RawHandleValue);
    /// <summary>Value of the handle, of whichever kind it is. No index: see <see cref="Slot"/>.</summary>
    public readonly int RawHandleValue => (int)(Packed & ((1u << MobilityShift) - 1));
    /// <summary>Slot of the handle, as index into arrays of a game's own, of which there is one for bodies and one for statics.</summary>
    public readonly int Slot => (int)Packed & BodyHandle.SlotMask;

    /// <summary>Bits that collidables are put in order by: mobility, then slot. Equal for two of them that never exist at the same time.</summary>
    internal const uint OrderMask = 3u << MobilityShift | BodyHandle.SlotMask;

    static uint Fitting(int handleValue)
    {
        if (handleValue >>> MobilityShift != 0)
            ThrowUnfitting(handleValue);
        return (uint)handleValue;
    }

    [DoesNotReturn]
    static void ThrowUnfitting(int handleValue) =>
        throw new ArgumentOutOfRangeException(nameof(handleValue), handleValue, "No body or static has a handle of that value.");

    /// <inheritdoc/>
    public override readonly string ToString() => Mobility == CollidableMobility.Static ? StaticHandle.ToString() : $"{Mobility} {BodyHandle}";
}
