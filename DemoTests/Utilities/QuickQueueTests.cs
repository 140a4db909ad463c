using System;
using System.Collections.Generic;
using System.Linq;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

public class QuickQueueTests
{
    /// <summary>Elements of twelve bytes: no power of two of them fills a block, so the ring has an odd length.</summary>
    readonly record struct Odd(int A, int B, int C);

    [Fact]
    public void BehavesLikeAListWithTwoEnds() => OperationSequences.Check(9, 30, operations =>
    {
        using var pool = new BufferPool(4096);
        var queue = new QuickQueue<Odd>(1, pool);
        List<Odd> model = [];
        foreach (var (kind, value) in operations)
        {
            var element = new Odd(value, -value, kind);
            switch (kind)
            {
                case <= 1:
                    queue.Enqueue(element, pool);
                    model.Add(element);
                    break;
                case 2:
                    queue.EnqueueFirst(element, pool);
                    model.Insert(0, element);
                    break;
                case 3:
                    Assert.Equal(model.Count > 0, queue.TryDequeue(out var first));
                    Assert.Equal(model.FirstOrDefault(), first);
                    model.RemoveRange(0, Math.Min(1, model.Count));
                    break;
                case 4:
                    Assert.Equal(model.Count > 0, queue.TryDequeueLast(out var last));
                    Assert.Equal(model.LastOrDefault(), last);
                    model.RemoveRange(Math.Max(0, model.Count - 1), Math.Min(1, model.Count));
                    break;
                case 5 when model.Count > 0:
                    queue.RemoveAt(value % model.Count);
                    model.RemoveAt(value % model.Count);
                    break;
                case 6:
                    queue.Compact(pool);
                    break;
                case 7:
                    queue.EnsureCapacity(value * 2, pool);
                    break;
                case 8 when value == 0:
                    queue.Clear();
                    model.Clear();
                    break;
            }
            Assert.Equal(model.Count, queue.Count);
            for (int i = 0; i < model.Count; ++i)
                Assert.Equal(model[i], queue[i]);
            if (model.Count > 0)
                Assert.Equal(model[^1], queue.Span[queue.LastIndex]);
        }
        queue.Dispose(pool);
        pool.AssertEmpty();
    });

    [Fact]
    public void AnEmptyQueueRefuses()
    {
        using var pool = new BufferPool();
        var queue = new QuickQueue<int>(4, pool);
        Assert.Throws<InvalidOperationException>(() => queue.Dequeue());
        Assert.Throws<InvalidOperationException>(() => queue.DequeueLast());
        Assert.Throws<ArgumentOutOfRangeException>(() => queue.RemoveAt(0));
        queue.Dispose(pool);
    }
}
