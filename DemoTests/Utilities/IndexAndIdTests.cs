using System;
using System.Collections.Generic;
using System.Linq;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

public class IndexAndIdTests
{
    [Fact]
    public void IndexSetBehavesLikeASet() => OperationSequences.Check(7, 5000, operations =>
    {
        using var pool = new BufferPool(4096);
        var set = new IndexSet(pool, 1);
        HashSet<int> model = [];
        foreach (var (kind, value) in operations)
        {
            switch (kind)
            {
                case 0 when !model.Contains(value):
                    set.Add(value, pool);
                    model.Add(value);
                    break;
                case 1:
                    set.Set(value, pool);
                    model.Add(value);
                    break;
                case 2:
                    set.Unset(value);
                    model.Remove(value);
                    break;
                case 3 when model.Count > 0:
                    set.Remove(model.First());
                    model.Remove(model.First());
                    break;
                case 4:
                    set.EnsureCapacity(value, pool);
                    Assert.True(set.Capacity >= value);
                    break;
                case 5 when value < 1000:
                    // Shrinks: what no longer fits is gone, and is not there when the set grows again.
                    set.Resize(value, pool);
                    var capacity = set.Capacity;
                    model.RemoveWhere(index => index >= capacity);
                    break;
                case 6 when value < 500:
                    set.Clear();
                    model.Clear();
                    break;
            }
            Span<int> three = [value, value / 2, kind];
            Assert.Equal(!model.Contains(value) && !model.Contains(value / 2) && !model.Contains(kind), set.CanFit(three));
        }
        for (int i = -70; i < 5100; ++i)
            Assert.Equal(model.Contains(i), set.Contains(i));
        set.Dispose(pool);
        pool.AssertEmpty();
    });

    [Fact]
    public void IndexSetRefusesNegativeIndices()
    {
        using var pool = new BufferPool();
        var set = new IndexSet(pool, 64);
        Assert.False(set.Contains(int.MinValue));
        Assert.False(set.Contains(int.MaxValue));
        Assert.Throws<ArgumentOutOfRangeException>(() => set.Set(-1, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => set.EnsureCapacity(-1, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => new IndexSet(pool, -1));
        set.Dispose(pool);
        pool.AssertEmpty();
    }

    [Fact]
    public void IdsAreUniqueAndReturnedOnesComeFirst() => OperationSequences.Check(4, 1000, operations =>
    {
        using var pool = new BufferPool(4096);
        var ids = new IdPool(1, pool);
        var managed = new ManagedIdPool(0);
        List<int> held = [];
        Stack<int> returned = [];
        var used = 0;
        foreach (var (kind, value) in operations)
        {
            if (kind <= 1)
            {
                var expected = returned.Count > 0 ? returned.Pop() : used++;
                Assert.Equal(expected, ids.Take());
                Assert.Equal(expected, managed.Take());
                held.Add(expected);
            }
            else if (kind == 2 && held.Count > 0)
            {
                var id = held[value % held.Count];
                held.Remove(id);
                ids.Return(id, pool);
                managed.Return(id);
                returned.Push(id);
            }
            else if (kind == 3 && value < 20)
            {
                ids.Resize(value, pool);
                if (value == 0)
                {
                    ids.Clear();
                    managed.Clear();
                    held.Clear();
                    returned.Clear();
                    used = 0;
                }
            }
            Assert.Equal(returned.Count, ids.AvailableIdCount);
            Assert.Equal(returned.Count, managed.AvailableIdCount);
            Assert.Equal(used - 1, ids.HighestPossiblyClaimedId);
            Assert.Equal(used - 1, managed.HighestPossiblyClaimedId);
        }
        ids.Dispose(pool);
        pool.AssertEmpty();
    });

    [Fact]
    public void IdsThatWereNeverTakenAreRefused()
    {
        using var pool = new BufferPool();
        var ids = new IdPool(4, pool);
        var managed = new ManagedIdPool();
        ids.Take();
        managed.Take();
        Assert.Throws<ArgumentOutOfRangeException>(() => ids.Return(1, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => ids.Return(-1, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => managed.Return(1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new ManagedIdPool(-1));
        ids.ReturnUnsafely(0);
        Assert.Equal(0, ids.Take());
        ids.Dispose(pool);
    }
}
