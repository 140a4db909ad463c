using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>The active bodies without constraints in a step: they are left out of its substeps, and moved once, over all of it.</summary>
// A bit per lane for each bundle of bodies. To who is left out a bundle looks as if its lane was empty.
unsafe readonly struct FreeBodies(Buffer<uint> lanes)
{
    readonly Buffer<uint> lanes = lanes;

    /// <summary>Whether there can be any; otherwise all bodies take the substeps.</summary>
    internal bool Exist => lanes.Allocated;

    /// <summary>Finds out which bodies of a bundle are free. Once per step, before the bundle is asked for.</summary>
    internal void Find(int bundle, in BodySet set)
    {
        var start = bundle * Vector<float>.Count;
        var count = Math.Min(Vector<float>.Count, set.Count - start);
        var lists = set.Constraints.Memory + start;
        uint free = 0;
        for (int i = 0; i < count; ++i)
            free |= lists[i].Count == 0 ? 1u << i : 0;
        lanes[bundle] = free;
    }

    /// <summary>Whether any body is free.</summary>
    internal bool Any => lanes.Allocated && lanes.AsSpan().ContainsAnyExcept(0u);

    /// <summary>Takes the free bodies out of a bundle; false where no other is left.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool TryRemove(int bundle, ref Vector<int> indices, ref Vector<int> exists) =>
        lanes[bundle] == 0 || TryKeep(~lanes[bundle], ref indices, ref exists);

    /// <summary>Takes all others out of a bundle; false where there is no free one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool TryKeep(int bundle, ref Vector<int> indices, ref Vector<int> exists) =>
        lanes[bundle] != 0 && TryKeep(lanes[bundle], ref indices, ref exists);

    static bool TryKeep(uint kept, ref Vector<int> indices, ref Vector<int> exists)
    {
        var existing = Wide.Bits(exists);
        if ((existing & kept) == 0)
            return false;
        if ((existing & ~kept) == 0)
            return true;
        var mask = stackalloc int[Vector<int>.Count];
        for (int i = 0; i < Vector<int>.Count; ++i)
            mask[i] = -(int)(kept >> i & 1);
        exists &= *(Vector<int>*)mask;
        indices |= ~exists;
        return true;
    }

    /// <summary>Returns the memory.</summary>
    internal void Dispose(BufferPool pool)
    {
        if (lanes.Allocated)
        {
            var buffer = lanes;
            pool.Return(ref buffer);
        }
    }
}
