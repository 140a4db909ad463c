using System;

namespace BepuPhysics.Collidables;

/// <summary>Names a body or a static as the collision detection sees it.</summary>
public struct CollidableReference : IEquatable<CollidableReference>
{
    const int MobilityShift = 30;

    /// <summary>Bits 30 and 31: mobility; bits 0 to 29: value of the body's or static's handle.</summary>
    public uint Packed;

    /// <summary>Names a body.</summary>
    /// <param name="mobility">Dynamic or kinematic.</param>
    /// <param name="handle">The body.</param>
    public CollidableReference(CollidableMobility mobility, BodyHandle handle) => Packed = (uint)mobility << MobilityShift | (uint)handle.Value;

    /// <summary>Names a static.</summary>
    public CollidableReference(StaticHandle handle) => Packed = (uint)CollidableMobility.Static << MobilityShift | (uint)handle.Value;

    /// <summary>How the collidable moves.</summary>
    public readonly CollidableMobility Mobility => (CollidableMobility)(Packed >> MobilityShift);
    /// <summary>The body; meaningless for a static.</summary>
    public readonly BodyHandle BodyHandle => new(RawHandleValue);
    /// <summary>The static; meaningless for a body.</summary>
    public readonly StaticHandle StaticHandle => new(RawHandleValue);
    /// <summary>Value of the handle, of whichever kind it is.</summary>
    public readonly int RawHandleValue => (int)(Packed & ((1u << MobilityShift) - 1));

    /// <inheritdoc/>
    public readonly bool Equals(CollidableReference other) => Packed == other.Packed;
    /// <inheritdoc/>
    public override readonly bool Equals(object? obj) => obj is CollidableReference other && Equals(other);
    /// <inheritdoc/>
    public override readonly int GetHashCode() => (int)Packed;
    /// <inheritdoc/>
    public override readonly string ToString() => $"{Mobility} {RawHandleValue}";
    /// <summary>Whether both name the same collidable.</summary>
    public static bool operator ==(CollidableReference a, CollidableReference b) => a.Packed == b.Packed;
    /// <summary>Whether the two name different collidables.</summary>
    public static bool operator !=(CollidableReference a, CollidableReference b) => a.Packed != b.Packed;
}
