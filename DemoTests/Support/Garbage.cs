using System;

namespace DemoTests.Support;

/// <summary>What code takes from the garbage collector.</summary>
static class Garbage
{
    /// <summary>Bytes that some work allocates on this thread when it is done again.</summary>
    // A collection that another test sets off ends the block that this thread allocates from, and what is left of the block counts as allocated: so the
    // least of a few times. What allocates does so each time.
    public static long Of(Action work)
    {
        var least = long.MaxValue;
        for (int i = 0; i < 4 && least > 0; ++i)
        {
            var before = GC.GetAllocatedBytesForCurrentThread();
            work();
            least = Math.Min(least, GC.GetAllocatedBytesForCurrentThread() - before);
        }
        return least;
    }
}
