using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Threading;

namespace BepuPhysics;

/// <summary>Counts the queries that are in progress in a world.</summary>
/// <remarks>
/// A query counts itself and then looks whether the world is held; who holds the world looks at the counts. With a fence between the two steps of each, at
/// least one notices the other. But a fence takes as long as a small query, and most are asked by the thread that changes the world as well. So that one is
/// <i>at home</i>, and its queries have none: another thread that changes the world first becomes at home itself and makes all threads pass a fence.
/// </remarks>
sealed class QueryCounts
{
    const int StripeCount = 8;
    // Ints to a cache line.
    const int StripeLength = 16;
    // Threads that may be at home in turn; if there are more, none is.
    const int MaximumHomeCount = 8;

    // By thread, so that threads that ask at the same time do not share a cache line. The first line is left free.
    readonly int[] stripes = new int[(StripeCount + 1) * StripeLength];
    // None is ever removed, and all are counted: a thread may still be about to count itself where it was at home.
    readonly Home?[] homes = new Home?[MaximumHomeCount];
    volatile Home home = Home.Nobody;
    // The home since all threads have passed a fence.
    volatile Home settled = Home.Nobody;

    /// <summary>
    /// Counts a query of the calling thread, if that is at home. It has to be taken back where the world turns out to be held, or the thread no more at home.
    /// </summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool TryCountAtHome(int thread, out Home known)
    {
        known = home;
        if (known.Thread != thread)
            return false;
        Volatile.Write(ref known.Count, known.Count + 1);
        return true;
    }

    /// <summary>Whether a home is still the one of the thread that is at home.</summary>
    internal bool IsHome(Home known) => home == known;

    /// <summary>Counts a query of any thread.</summary>
    internal ref int Count(int thread)
    {
        ref var count = ref stripes[((thread & (StripeCount - 1)) + 1) * StripeLength];
        Interlocked.Increment(ref count);
        return ref count;
    }

    /// <summary>Whether queries are in progress: asked by a thread that has taken hold of the world, which is at home from now on.</summary>
    internal bool HasAny(int thread)
    {
        if (home.Thread != thread)
            Move(thread);
        int sum = 0;
        foreach (var known in homes)
        {
            if (known is null)
                break;
            sum += Volatile.Read(ref known.Count);
        }
        ref var first = ref MemoryMarshal.GetArrayDataReference(stripes);
        for (int i = 1; i <= StripeCount; ++i)
            sum += Volatile.Read(ref Unsafe.Add(ref first, i * StripeLength));
        return sum != 0;
    }

    // After the fence whoever was at home has either been seen to count itself, or sees that it is at home no more. Where nobody is at home, nobody is to
    // be seen: the fence takes microseconds, and where many threads change a world in turn each change would have one.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void Move(int thread)
    {
        var next = FindHome(thread);
        if (next == Home.Nobody && home == Home.Nobody && settled == Home.Nobody)
            return;
        home = next;
        Interlocked.MemoryBarrierProcessWide();
        settled = next;
    }

    // A stage and a step may come here at the same time.
    Home FindHome(int thread)
    {
        for (int i = 0; i < homes.Length; ++i)
        {
            var known = Volatile.Read(ref homes[i]);
            if (known is null)
            {
                var added = new Home(thread);
                known = Interlocked.CompareExchange(ref homes[i], added, null) ?? added;
            }
            if (known.Thread == thread)
                return known;
        }
        return Home.Nobody;
    }

    /// <summary>The queries of a thread that it counts alone.</summary>
    internal sealed class Home(int thread)
    {
        /// <summary>No thread has this number.</summary>
        public static readonly Home Nobody = new(0);

        public readonly int Thread = thread;
        public int Count;
    }
}
