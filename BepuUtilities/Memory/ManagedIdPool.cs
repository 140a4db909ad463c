using System;

namespace BepuUtilities.Memory;

/// <summary>Hands out small nonnegative integers like <see cref="IdPool"/>, with its bookkeeping in managed memory.</summary>
public sealed class ManagedIdPool
{
    int[] availableIds;
    int nextIndex;

    /// <summary>Creates a pool that has handed out nothing.</summary>
    /// <param name="initialCapacity">Number of returned ids that fit without more memory.</param>
    public ManagedIdPool(int initialCapacity = 128)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(initialCapacity);
        availableIds = new int[initialCapacity];
    }

    /// <summary>Number of returned ids waiting to be taken again.</summary>
    public int AvailableIdCount { get; private set; }

    /// <summary>Greatest id that may be out; -1 when none ever was. An upper bound: that id itself may have been returned.</summary>
    public int HighestPossiblyClaimedId => nextIndex - 1;

    /// <summary>Number of returned ids that fit without more memory.</summary>
    public int Capacity => availableIds.Length;

    /// <summary>Takes an id that nobody holds.</summary>
    public int Take() => AvailableIdCount > 0 ? availableIds[--AvailableIdCount] : nextIndex++;

    /// <summary>Gives an id back.</summary>
    public void Return(int id)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(id);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(id, nextIndex);
        EnsureCapacity(AvailableIdCount + 1);
        availableIds[AvailableIdCount++] = id;
    }

    /// <summary>Takes all ids back.</summary>
    public void Clear()
    {
        nextIndex = 0;
        AvailableIdCount = 0;
    }

    /// <summary>Makes room for a number of returned ids.</summary>
    public void EnsureCapacity(int count)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(count);
        if (availableIds.Length < count)
            Array.Resize(ref availableIds, Math.Max(count, availableIds.Length * 2));
    }
}
