using System;
using Benchmarks.Pairs.Shared;

namespace Benchmarks.Pairs;

/// <summary>What differs between engines when pairs are measured: here nothing is kept from step to step.</summary>
static class PairEngine
{
    /// <summary>Never a test: every one starts afresh.</summary>
    public static Func<int>? CreateWarmTest(PairWorld world, PairPlacement[] placements) => null;
}
