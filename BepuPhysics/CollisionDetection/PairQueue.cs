using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>Overlapping pairs on their way to their test, for as long as it takes to load what is remembered of them.</summary>
/// <remarks>
/// The tree finds pairs in the order of space, the cache holds them in the order of time: each lookup would wait for memory, three times
/// one after the other. Here each pair asks for the next of the three while others are tested. Tests are in the order of the pairs.
/// </remarks>
struct PairQueue
{
    const int Length = 32;
    // Pairs between two stages of one pair.
    const int StageLength = 8;

    [InlineArray(Length)]
    struct Ring
    {
        CollidablePair first;
    }

    [InlineArray(Length)]
    struct Elements
    {
        int first;
    }

    Ring pairs;
    Elements elements;
    int added;
    int taken;

    /// <summary>Adds a pair. There must be room: <see cref="TryTake"/> after each.</summary>
    public void Add(in PairCache cache, CollidablePair pair)
    {
        pairs[added % Length] = pair;
        cache.Pairs.PrefetchSlot(pair);
        var second = added - StageLength;
        if (second >= taken)
            elements[second % Length] = cache.Pairs.PrefetchElement(pairs[second % Length]);
        var third = second - StageLength;
        if (third >= taken && elements[third % Length] >= 0)
            cache.PrefetchHistory(elements[third % Length]);
        ++added;
    }

    /// <summary>Takes the oldest pair when its turn has come.</summary>
    public bool TryTake(out CollidablePair pair)
    {
        pair = pairs[taken % Length];
        if (added - taken < 3 * StageLength)
            return false;
        ++taken;
        return true;
    }

    /// <summary>Takes the oldest pair whether its turn has come or not; false when there is none.</summary>
    public bool TryTakeLast(out CollidablePair pair)
    {
        pair = pairs[taken % Length];
        if (added == taken)
            return false;
        ++taken;
        return true;
    }
}
