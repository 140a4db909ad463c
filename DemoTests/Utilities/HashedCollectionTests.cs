using System;
using System.Collections.Generic;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Utilities;

/// <summary>Sets and maps against the framework's, with hashes from perfect to all the same, and at the tightest table.</summary>
public class HashedCollectionTests
{
    [Fact]
    public void SetBehavesLikeTheFrameworks()
    {
        CheckSet(default(PrimitiveComparer<int>), 2);
        WrapperEqualityComparer<int>.CreateDefault(out var wrapper);
        CheckSet(wrapper, 1);
    }

    [Fact]
    public void SetSurvivesCollisions()
    {
        CheckSet(new CollidingComparer { Mask = 0 }, 1);
        CheckSet(new CollidingComparer { Mask = 3 }, 1);
        CheckSet(new CollidingComparer { Mask = ~7 }, 2);
    }

    [Fact]
    public void DictionaryBehavesLikeTheFrameworks() => CheckDictionary(default(PrimitiveComparer<int>), 2);

    [Fact]
    public void DictionarySurvivesCollisions()
    {
        CheckDictionary(new CollidingComparer { Mask = 0 }, 1);
        CheckDictionary(new CollidingComparer { Mask = 3 }, 1);
    }

    static void CheckSet<TComparer>(TComparer comparer, int tableSizePower) where TComparer : IEqualityComparerRef<int> =>
        OperationSequences.Check(10, 150, operations =>
        {
            using var pool = new BufferPool(4096);
            var set = new QuickSet<int, TComparer>(1, tableSizePower, comparer, pool);
            // The order is part of the contract: additions at the end, removals fill the gap with the last.
            List<int> model = [];
            foreach (var (kind, value) in operations)
            {
                var found = model.IndexOf(value);
                switch (kind)
                {
                    case <= 3:
                        Assert.Equal(found < 0, kind == 3 ? set.AddAndReplace(value, pool) : set.Add(value, pool));
                        if (found < 0)
                            model.Add(value);
                        break;
                    case <= 5:
                        Assert.Equal(found >= 0, set.FastRemove(value));
                        FastRemove(model, found);
                        break;
                    case 6 when model.Count > 0:
                        set.FastRemoveAt(value % model.Count);
                        FastRemove(model, value % model.Count);
                        break;
                    case 7:
                        set.Compact(pool);
                        break;
                    case 8:
                        set.EnsureCapacity(value, pool);
                        break;
                    case 9 when value < 4:
                        if (value < 2)
                            set.Clear();
                        else
                            set.FastClear();
                        model.Clear();
                        break;
                }
                Assert.Equal(model.ToArray(), ((ReadOnlySpan<int>)set).ToArray());
                Assert.Equal(model.IndexOf(value), set.IndexOf(value));
                Assert.Equal(model.Contains(kind), set.Contains(kind));
                Assert.True(IsTableSound(set.Table, set.TableMask, set.Count));
            }
            set.Dispose(pool);
            pool.AssertEmpty();
        }, 80);

    static void CheckDictionary<TComparer>(TComparer comparer, int tableSizePower) where TComparer : IEqualityComparerRef<int> =>
        OperationSequences.Check(10, 150, operations =>
        {
            using var pool = new BufferPool(4096);
            // Values larger than keys, so that a block of the pool has room for different numbers of the two.
            var map = new QuickDictionary<int, (long, long, long), TComparer>(1, tableSizePower, comparer, pool);
            Dictionary<int, (long, long, long)> model = [];
            var next = 0L;
            foreach (var (kind, key) in operations)
            {
                var isKnown = model.ContainsKey(key);
                var value = (++next, -next, 7L);
                switch (kind)
                {
                    case <= 1:
                        Assert.Equal(model.TryAdd(key, value), map.Add(key, value, pool));
                        break;
                    case 2:
                        Assert.Equal(!isKnown, map.AddAndReplace(key, value, pool));
                        model[key] = value;
                        break;
                    case 3:
                        Assert.Equal(isKnown, map.FindOrAllocateSlot(key, pool, out var slot));
                        Assert.Equal(key, map.Keys[slot]);
                        map.Values[slot] = value;
                        model[key] = value;
                        break;
                    case <= 5:
                        Assert.Equal(model.Remove(key), map.FastRemove(key));
                        break;
                    case 6 when map.Count > 0:
                        var index = key % map.Count;
                        Assert.True(model.Remove(map.Keys[index]));
                        map.FastRemoveAt(index);
                        break;
                    case 7:
                        map.Compact(pool);
                        break;
                    case 8:
                        map.EnsureCapacity(key, pool);
                        break;
                    case 9 when key < 4:
                        if (key < 2)
                            map.Clear();
                        else
                            map.FastClear();
                        model.Clear();
                        break;
                }
                Assert.Equal(model.Count, map.Count);
                for (int i = 0; i < map.Count; ++i)
                    Assert.Equal(model[map.Keys[i]], map.Values[i]);
                Assert.Equal(model.TryGetValue(key, out var expected), map.TryGetValue(key, out var actual));
                Assert.Equal(expected, actual);
                Assert.Equal(model.ContainsKey(kind), map.ContainsKey(kind));
                Assert.True(IsTableSound(map.Table, map.TableMask, map.Count));
            }
            map.Dispose(pool);
            pool.AssertEmpty();
        }, 80);

    [Fact]
    public void OwnElementsMayBeAddedWhileTheCollectionGrows()
    {
        using var pool = new BufferPool();
        var map = new QuickDictionary<int, int, PrimitiveComparer<int>>(1, pool);
        var capacity = map.Keys.Length;
        for (int i = 0; i < capacity; ++i)
            map.Add(i, i * 10, pool);
        map.Add(capacity, in map.Values[3], pool);
        Assert.True(map.TryGetValue(capacity, out var value));
        Assert.Equal(30, value);
        Assert.False(map.Add(in map.Keys[2], 5, pool));
        map.Dispose(pool);
        pool.AssertEmpty();
    }

    [Fact]
    public void BadCallsAreRefused()
    {
        using var pool = new BufferPool();
        Assert.Throws<ArgumentOutOfRangeException>(() => new QuickSet<int, PrimitiveComparer<int>>(4, 0, default, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => new QuickSet<int, PrimitiveComparer<int>>(-1, pool));
        Assert.Throws<ArgumentOutOfRangeException>(() => new QuickDictionary<int, int, PrimitiveComparer<int>>(int.MaxValue / 2, pool));
        pool.AssertEmpty();
        var set = new QuickSet<int, PrimitiveComparer<int>>(4, pool);
        Assert.Throws<ArgumentOutOfRangeException>(() => set.FastRemoveAt(0));
        set.Add(1, pool);
        Assert.Throws<ArgumentOutOfRangeException>(() => set.Resize(0, pool));
        set.Dispose(pool);
        pool.AssertEmpty();
    }

    [Fact]
    public void PrimitiveHashesAreTheBits()
    {
        Assert.Equal(-5, Hash(-5));
        Assert.Equal(0xfffb, Hash((short)-5));
        Assert.Equal(200, Hash((byte)200));
        Assert.Equal(3, Hash(DayOfWeek.Wednesday));
        Assert.Equal(1 ^ 2, Hash((2L << 32) | 1));
        Assert.Equal(Hash((1.5f, 2)), Hash((1.5f, 2)));
        static int Hash<T>(T value) where T : unmanaged => default(PrimitiveComparer<T>).Hash(ref value);
    }

    static void FastRemove(List<int> model, int index)
    {
        if (index < 0)
            return;
        model[index] = model[^1];
        model.RemoveAt(model.Count - 1);
    }

    /// <summary>Whether the table names each element once and nothing else.</summary>
    static bool IsTableSound(Buffer<int> table, int mask, int count)
    {
        var seen = new bool[count];
        var used = 0;
        foreach (var entry in table.AsSpan())
        {
            if (entry == 0)
                continue;
            if (entry < 0 || entry > count || seen[entry - 1])
                return false;
            seen[entry - 1] = true;
            ++used;
        }
        return used == count && table.Length == mask + 1 && table.Length > count;
    }

    struct CollidingComparer : IEqualityComparerRef<int>
    {
        public int Mask;
        public readonly int Hash(ref int item) => item & Mask;
        public readonly bool Equals(ref int a, ref int b) => a == b;
    }
}
