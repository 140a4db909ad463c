using System;
using Benchmarks.Pairs.Shared;

namespace Benchmarks.Pairs;

/// <summary>What differs between engines when pairs are measured: here the step adds pairs as everyone does.</summary>
static class PairEngine
{
    /// <summary>Never a test.</summary>
    public static Func<int>? CreateStepTest(PairWorld world, PairPlacement[] placements) => null;
}
