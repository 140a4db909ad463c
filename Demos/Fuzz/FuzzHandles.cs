using System;
using System.Collections.Generic;

namespace Demos.Fuzz;

/// <summary>Names of what there is, and of some that there was.</summary>
sealed class FuzzHandles<T>(int rememberedCount)
{
    readonly List<T> stale = [];

    public List<T> Live { get; } = [];

    /// <summary>A name: mostly of what there is, at times of what there was, seldom any.</summary>
    public T Any(FuzzRandom random, bool allowBad, Func<int, T> make)
    {
        int kind = random.Below(100);
        if (!allowBad || kind < 85)
        {
            if (Live.Count > 0)
                return random.Of(Live);
            return make(-1);
        }
        if (kind < 94 && stale.Count > 0)
            return random.Of(stale);
        return make(kind < 97 ? random.Below(100) - 20 : random.Bits());
    }

    /// <summary>Moves what is no more to those that are remembered.</summary>
    public void Forget(Func<T, bool> exists)
    {
        for (int i = Live.Count - 1; i >= 0; --i)
        {
            if (exists(Live[i]))
                continue;
            stale.Add(Live[i]);
            Live.RemoveAt(i);
        }
        if (stale.Count > rememberedCount)
            stale.RemoveRange(0, stale.Count - rememberedCount);
    }
}
