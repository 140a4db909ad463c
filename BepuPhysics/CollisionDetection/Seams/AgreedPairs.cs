using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the pairs of bodies that lie across statics have agreed on in this step and in the last: an entry for each, in the order of pairs.</summary>
struct AgreedPairs
{
    QuickList<AgreedPair> now, before;

    // Pairs that there is room for without a need; and how many times those that there are.
    const int LeastRoom = 64, MostRoom = 4;

    /// <summary>The pairs of this step.</summary>
    public readonly Span<AgreedPair> Now => now.AsSpan();

    /// <summary>Those of the last step.</summary>
    public readonly Span<AgreedPair> Before => before.AsSpan();

    /// <summary>Begins a step. Takes no memory before the first pair.</summary>
    /// <param name="count">Number of its pairs.</param>
    /// <param name="pool">Source of memory.</param>
    public void BeginStep(int count, BufferPool pool)
    {
        (now, before) = (before, now);
        now.Count = 0;
        // In its first step each pair waits; of what lies on one ground, no later one.
        if (now.Span.Allocated && now.Span.Length > Math.Max(LeastRoom, MostRoom * count))
        {
            now.Dispose(pool);
            now = default;
        }
        if (count == 0)
            return;
        if (!now.Span.Allocated)
            now = new(count, pool);
        now.EnsureCapacity(count, pool);
        now.Count = count;
    }

    /// <summary>Forgets everything.</summary>
    public void Clear() => now.Count = before.Count = 0;

    /// <summary>Returns all memory.</summary>
    public void Dispose(BufferPool pool)
    {
        if (now.Span.Allocated)
            now.Dispose(pool);
        if (before.Span.Allocated)
            before.Dispose(pool);
        this = default;
    }
}
