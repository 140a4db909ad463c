using System.Runtime.CompilerServices;
using BepuUtilities.Collections;

namespace BepuPhysics.Collidables;

/// <summary>Equality and hash of collidable references, for dictionaries and sets over pooled memory.</summary>
public struct CollidableReferenceComparer : IEqualityComparerRef<CollidableReference>
{
    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly int Hash(ref CollidableReference item) => (int)item.Packed;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool Equals(ref CollidableReference a, ref CollidableReference b) => a.Packed == b.Packed;
}
