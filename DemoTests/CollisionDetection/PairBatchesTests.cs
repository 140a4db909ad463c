using System;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Batches of the tasks that have pairs.</summary>
public class PairBatchesTests
{
    /// <summary>
    /// Whatever the memory held before, and in whatever order tasks come, those that have memory are those that took some, and what is between two of them is
    /// empty: only that much is ever written.
    /// </summary>
    [Fact]
    public void Those_that_have_memory_are_those_that_took_some()
    {
        var registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
        var random = new Random(17);
        for (int round = 0; round < 200; ++round)
        {
            using var pool = new BufferPool();
            Soil(pool, registry.TaskCount);
            var batches = new PairBatches();
            var has = new bool[registry.TaskCount];
            for (int taken = 0; taken < 6; ++taken)
            {
                var index = random.Next(has.Length);
                if (has[index])
                    continue;
                batches.Take(registry[index], index, registry.TaskCount, pool);
                has[index] = true;
                for (int i = 0; i < has.Length; ++i)
                    Assert.Equal(has[i], batches.Has(i));
                Assert.False(batches.Has(has.Length + 1000));
                Assert.Equal(Array.IndexOf(has, true), batches.First);
                Assert.Equal(Array.LastIndexOf(has, true) + 1, batches.End);
                for (int i = batches.First; i < batches.End; ++i)
                    Assert.Equal(0, batches[i].Count);
            }
            batches.Dispose(pool);
            Assert.Equal(0ul, pool.GetTotalTakenByteCount());
            Assert.False(batches.Has(0));
        }
    }

    static void Soil(BufferPool pool, int count)
    {
        pool.TakeAtLeast<PairBatch>(count, out var batches);
        batches.As<byte>().AsSpan().Fill(0xff);
        pool.Return(ref batches);
    }
}
