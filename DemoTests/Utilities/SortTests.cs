using System;
using System.Linq;
using System.Numerics;
using BepuUtilities.Collections;
using Xunit;

namespace DemoTests.Utilities;

public class SortTests
{
    /// <summary>Keys of different spreads: few values, many equal digits, all bits. Each operation makes some keys.</summary>
    static ulong[] Keys(Operation[] operations) =>
        [.. operations.SelectMany(operation => Enumerable.Range(0, 3).Select(i => Spread(operation, (ulong)i)))];

    static ulong Spread(Operation operation, ulong i) => operation.Kind switch
    {
        0 => (ulong)operation.Value % 3,
        1 => (ulong)operation.Value << 24,
        2 => ulong.MaxValue - (ulong)operation.Value * i,
        _ => ((ulong)operation.Value + i) * 0x9E3779B97F4A7C15,
    };

    [Fact]
    public void QuickSortSorts() => OperationSequences.Check(4, 60_000, operations =>
    {
        var keys = Keys(operations);
        var values = keys.ToArray();
        var expected = keys.Order().ToArray();
        var comparer = new Ascending();
        QuickSort.Sort(keys.AsSpan(), values.AsSpan(), ref comparer);
        Assert.Equal(expected, keys);
        Assert.Equal(expected, values);
        var descending = new Descending();
        QuickSort.Sort(keys.AsSpan(), ref descending);
        Assert.Equal(expected.Reverse(), keys);
    });

    /// <summary>An opponent that decides the order while the sort asks drives quicksort to its worst case: the heap sort has to step in.</summary>
    [Fact]
    public void QuickSortWithstandsAnAdversary()
    {
        const int count = 4096;
        var opponent = new Adversary { Ranks = Enumerable.Repeat(int.MaxValue, count).ToArray() };
        var items = Enumerable.Range(0, count).ToArray();
        QuickSort.Sort(items.AsSpan(), ref opponent);
        Assert.True(opponent.ComparisonCount < 10 * count * BitOperations.Log2(count), $"{opponent.ComparisonCount} comparisons");
        var ranks = items.Select(item => opponent.Ranks[item]).ToArray();
        Assert.Equal(ranks.Order(), ranks);
    }

    [Fact]
    public void AComparerThatContradictsItselfLosesNothing()
    {
        var items = Enumerable.Range(0, 1000).ToArray();
        var liar = new Liar();
        try
        {
            QuickSort.Sort(items.AsSpan(), ref liar);
        }
        catch (IndexOutOfRangeException)
        {
        }
        Assert.Equal(Enumerable.Range(0, 1000), items.Order());
    }

    [Fact]
    public void QuickSortRefusesValuesOfAnotherLength()
    {
        var comparer = new Ascending();
        Assert.Throws<ArgumentOutOfRangeException>(() => QuickSort.Sort(new ulong[3].AsSpan(), new int[2].AsSpan(), ref comparer));
    }

    struct Ascending : IComparerRef<ulong>
    {
        public readonly int Compare(ref ulong a, ref ulong b) => a.CompareTo(b);
    }

    struct Descending : IComparerRef<ulong>
    {
        public readonly int Compare(ref ulong a, ref ulong b) => b.CompareTo(a);
    }

    struct Liar : IComparerRef<int>
    {
        public readonly int Compare(ref int a, ref int b) => -1;
    }

    /// <summary>McIlroy, "A killer adversary for quicksort" (1999): items have no rank until a comparison forces one.</summary>
    struct Adversary : IComparerRef<int>
    {
        public int[] Ranks;
        public int ComparisonCount;
        int nextRank;
        int candidate;

        public int Compare(ref int a, ref int b)
        {
            ++ComparisonCount;
            if (Ranks[a] == int.MaxValue && Ranks[b] == int.MaxValue)
                Ranks[a == candidate ? a : b] = nextRank++;
            if (Ranks[a] == int.MaxValue)
                candidate = a;
            else if (Ranks[b] == int.MaxValue)
                candidate = b;
            return Ranks[a].CompareTo(Ranks[b]);
        }
    }
}
