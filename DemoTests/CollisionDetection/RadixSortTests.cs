using System;
using System.Linq;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Sorting by digits against the stable sort of the framework.</summary>
public class RadixSortTests
{
    struct Element
    {
        public ulong Key;
        public int Place;
    }

    struct ByKey : ISortKey<Element>
    {
        public static ulong Of(in Element element) => element.Key;
    }

    [Theory]
    [InlineData(0, ulong.MaxValue)]
    [InlineData(1, ulong.MaxValue)]
    [InlineData(2, 1UL)]
    [InlineData(5000, ulong.MaxValue)]
    [InlineData(5000, 7UL)]
    [InlineData(5000, 0UL)]
    [InlineData(5000, 0xFFF0_0000_0000_0000UL)]
    [InlineData(5000, 0xC001_FFFF_C001_FFFFUL)]
    public void SortsAndKeepsTheOrderOfEqualKeys(int count, ulong mask)
    {
        var state = 88172645463325252UL;
        var elements = new Element[count];
        for (int i = 0; i < count; ++i)
        {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            elements[i] = new() { Key = state & mask, Place = i };
        }
        var expected = elements.OrderBy(element => element.Key).ToArray();
        var pool = new BufferPool();
        RadixSort<Element, ByKey>.Sort(elements.AsSpan(), pool);
        Assert.Equal(expected.Select(element => (element.Key, element.Place)), elements.Select(element => (element.Key, element.Place)));
        pool.AssertEmpty();
        pool.Clear();
    }
}
