using System;
using System.Threading;
using BepuPhysics;
using Xunit;

namespace DemoTests.Locking;

/// <summary>Queries of the thread that changed the world last are counted without a fence, and yet never missed by a change of another.</summary>
public class QueryCountTests
{
    // Long, for machines on which much else runs.
    static readonly TimeSpan patience = TimeSpan.FromMinutes(5);

    sealed class Rivals
    {
        public readonly WorldLock World = new();
        public int Clashes, Queries, Changes;
        int asking, changing;

        // Both threads do both, so each is at home again and again, and is driven out by the other.
        public void Compete(int turnCount)
        {
            for (int turn = 0; turn < turnCount; ++turn)
            {
                TryChange();
                for (int i = 0; i < 20; ++i)
                    TryAsk();
            }
        }

        void TryChange()
        {
            try
            {
                using var change = World.Change("a change");
                Volatile.Write(ref changing, 1);
                Thread.SpinWait(3);
                if (Volatile.Read(ref asking) != 0)
                    Interlocked.Increment(ref Clashes);
                Volatile.Write(ref changing, 0);
                Interlocked.Increment(ref Changes);
            }
            catch (InvalidOperationException)
            {
                // Refused, as something else goes on.
            }
        }

        void TryAsk()
        {
            try
            {
                using var reading = World.Read("a query");
                Interlocked.Increment(ref asking);
                if (Volatile.Read(ref changing) != 0)
                    Interlocked.Increment(ref Clashes);
                Interlocked.Decrement(ref asking);
                Interlocked.Increment(ref Queries);
            }
            catch (InvalidOperationException)
            {
                // As above.
            }
        }
    }

    // With two threads, and with more than are remembered.
    [Theory]
    [InlineData(1, 20_000)]
    [InlineData(11, 1_000)]
    public void A_query_and_a_change_of_another_thread_never_go_on_at_once(int otherCount, int turnCount)
    {
        var rivals = new Rivals();
        var others = new Thread[otherCount];
        for (int i = 0; i < otherCount; ++i)
        {
            others[i] = new Thread(() => rivals.Compete(turnCount));
            others[i].Start();
        }
        rivals.Compete(turnCount);
        foreach (var other in others)
            Assert.True(other.Join(patience));
        Assert.Equal(0, rivals.Clashes);
        Assert.True(rivals.Queries > 0 && rivals.Changes > 0);
    }

    [Fact]
    public void A_query_is_seen_whoever_was_at_home_before()
    {
        var world = new WorldLock();
        // More threads than are remembered.
        for (int i = 0; i < 12; ++i)
        {
            using var isAsking = new ManualResetEventSlim();
            using var mayEnd = new ManualResetEventSlim();
            var asker = new Thread(() =>
            {
                world.Change("a change").Dispose();
                using (world.Read("a query"))
                using (world.Read("a query within it"))
                {
                    isAsking.Set();
                    mayEnd.Wait(patience);
                }
            });
            asker.Start();
            Assert.True(isAsking.Wait(patience));
            Assert.Throws<InvalidOperationException>(() => world.Change("a change").Dispose());
            Assert.Throws<InvalidOperationException>(() => world.Step("a step").Dispose());
            world.Read("another query").Dispose();
            mayEnd.Set();
            Assert.True(asker.Join(patience));
            world.Change("a change").Dispose();
        }
    }

    [Fact]
    public void A_query_at_home_takes_no_memory_and_ends_with_its_scope()
    {
        var world = new WorldLock();
        world.Change("a change").Dispose();
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 100; ++i)
        {
            world.Read("a query").Dispose();
            world.Change("a change").Dispose();
        }
        Assert.Equal(before, GC.GetAllocatedBytesForCurrentThread());
        using (world.Read("a query"))
            Assert.Throws<InvalidOperationException>(() => world.Change("a change").Dispose());
        world.Change("a change").Dispose();
    }
}
