using System;
using System.Collections.Generic;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Ids of what waits for results.</summary>
public class WaitingListTests
{
    const int InitialCapacity = 4;

    /// <summary>Where one thing waits at a time, as in a question to a world, nothing but the room for it is taken: no notes of ids that are free.</summary>
    [Fact]
    public void What_waits_alone_takes_one_block()
    {
        using var pool = new BufferPool();
        var list = new WaitingList<long>(InitialCapacity);
        for (int i = 0; i < 10; ++i)
        {
            Assert.Equal(0, list.Add(i, pool));
            list.Take(0, pool, out var taken);
            Assert.Equal(i, taken);
            Assert.Equal(64ul, pool.GetTotalTakenByteCount());
        }
        list.Dispose(pool);
        Assert.Equal(0ul, pool.GetTotalTakenByteCount());
    }

    /// <summary>In any order of coming and going no two that wait have one id, each keeps what it was given, and ids are no more than ever waited.</summary>
    [Fact]
    public void Ids_are_used_again_and_never_twice()
    {
        using var pool = new BufferPool();
        var random = new Random(17);
        var list = new WaitingList<long>(InitialCapacity);
        var waiting = new List<(int Id, long Item)>();
        var most = 0;
        for (int i = 0; i < 20_000; ++i)
        {
            // Now many, now few.
            if (waiting.Count == 0 || random.Next(100) < (i / 500 % 2 == 0 ? 70 : 30))
            {
                var id = list.Add(i, pool);
                Assert.DoesNotContain(waiting, other => other.Id == id);
                waiting.Add((id, i));
                most = Math.Max(most, waiting.Count);
                Assert.True(id < most && list.Span <= most);
                continue;
            }
            var index = random.Next(waiting.Count);
            var (taken, item) = waiting[index];
            Assert.Equal(item, list[taken]);
            list.Take(taken, pool, out var found);
            Assert.Equal(item, found);
            waiting.RemoveAt(index);
        }
        list.Dispose(pool);
    }
}
