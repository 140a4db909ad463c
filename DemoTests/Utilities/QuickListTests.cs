using System;
using System.Collections.Generic;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

public class QuickListTests
{
    [Fact]
    public void BehavesLikeTheFrameworksList() => OperationSequences.Check(15, 40, operations =>
    {
        using var pool = new BufferPool(4096);
        var list = new QuickList<int>(1, pool);
        List<int> model = [];
        foreach (var (kind, value) in operations)
            Apply(ref list, model, kind, value, pool);
        list.Dispose(pool);
        pool.AssertEmpty();
    });

    static void Apply(ref QuickList<int> list, List<int> model, int kind, int value, BufferPool pool)
    {
        var index = model.Count == 0 ? -1 : value % model.Count;
        switch (kind)
        {
            case <= 2:
                list.Add(value, pool);
                model.Add(value);
                break;
            case 3:
                list.Allocate(pool) = value;
                model.Add(value);
                break;
            case 4:
                var count = value % 7;
                ref var first = ref list.Allocate(count, pool);
                for (int i = 0; i < count; ++i)
                {
                    System.Runtime.CompilerServices.Unsafe.Add(ref first, i) = i;
                    model.Add(i);
                }
                break;
            case 5:
                int[] range = [value, value + 1, value + 2, value + 3];
                list.AddRange(range.AsSpan(), value % 3, 2, pool);
                model.AddRange(range[(value % 3)..(value % 3 + 2)]);
                break;
            case 6 when index >= 0:
                list.RemoveAt(index);
                model.RemoveAt(index);
                break;
            case 7 when index >= 0:
                list.FastRemoveAt(index);
                model[index] = model[^1];
                model.RemoveAt(model.Count - 1);
                break;
            case 8:
                Assert.Equal(model.Remove(value), list.Remove(value));
                break;
            case 9:
                var found = model.IndexOf(value);
                Assert.Equal(found, list.IndexOf(value));
                Assert.Equal(found >= 0, list.FastRemove(value));
                if (found >= 0)
                {
                    model[found] = model[^1];
                    model.RemoveAt(model.Count - 1);
                }
                break;
            case 10:
                Assert.Equal(model.Count > 0, list.TryPop(out var popped));
                if (model.Count > 0)
                {
                    Assert.Equal(model[^1], popped);
                    model.RemoveAt(model.Count - 1);
                }
                break;
            case 11:
                list.Compact(pool);
                break;
            case 12:
                list.EnsureCapacity(value * 10, pool);
                Assert.True(list.Span.Length >= value * 10);
                break;
            case 13 when value == 0:
                list.Clear();
                model.Clear();
                break;
            case 14 when index >= 0:
                // An element of its own, whose memory may go away while it is added.
                list.Add(in list[index], pool);
                model.Add(model[index]);
                break;
        }
        Assert.Equal(model.ToArray(), list.AsSpan().ToArray());
    }

    [Fact]
    public void PredicatesSearchAndRemove()
    {
        using var pool = new BufferPool();
        var list = new QuickList<int>(4, pool);
        list.AddRange([5, 6, 7, 8], pool);
        var even = new Even();
        Assert.Equal(1, list.IndexOf(ref even));
        Assert.True(list.Contains(ref even));
        Assert.True(list.Remove(ref even));
        Assert.Equal([5, 7, 8], list.AsSpan().ToArray());
        Assert.True(list.FastRemove(ref even));
        Assert.False(list.FastRemove(ref even));
        Assert.False(list.Contains(ref even));
        var sum = 0;
        foreach (ref var element in list)
            sum += element;
        Assert.Equal(12, sum);
        Buffer<int> exact = list;
        Assert.Equal(2, exact.Length);
        list.Dispose(pool);
        pool.AssertEmpty();
    }

    [Fact]
    public void BadCallsAreRefusedAndChangeNothing()
    {
        using var pool = new BufferPool();
        QuickList<int> list = default;
        list.Add(1, pool);
        Assert.Throws<ArgumentOutOfRangeException>(() => list.RemoveAt(1));
        Assert.Throws<ArgumentOutOfRangeException>(() => list.FastRemoveAt(-1));
        Assert.Throws<ArgumentOutOfRangeException>(() => list.Resize(0, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => list.Allocate(-1, pool));
        Assert.Throws<ArgumentException>(() => list.AddRangeUnsafely(new int[1000]));
        Assert.Equal([1], list.AsSpan().ToArray());
        Assert.Equal(1, list.Pop());
        Assert.Throws<InvalidOperationException>(() => list.Pop());
        list.Dispose(pool);
        pool.AssertEmpty();
    }

    struct Even : IPredicate<int>
    {
        public readonly bool Matches(ref int item) => item % 2 == 0;
    }
}
