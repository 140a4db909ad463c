using System;
using System.Linq;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>What was found for a parent comes in the order of children, however it was found.</summary>
public class FoundOrderTests
{
    /// <summary>Few and many, with small and large numbers, in their order, nearly, and in any.</summary>
    [Theory]
    [InlineData(6, 30), InlineData(40, 1), InlineData(128, 128), InlineData(129, 40), InlineData(1 << 23, 1 << 23)]
    [InlineData(1 << 24, 30), InlineData(30, int.MaxValue), InlineData(int.MaxValue, int.MaxValue)]
    public void All_come_in_the_order_of_children(int mostA, int mostB)
    {
        var random = new Random(mostA ^ mostB);
        for (int i = 0; i < 400; ++i)
        {
            var count = Math.Min(random.Next(2, i % 4 == 0 ? 300 : 40), mostA * (long)mostB / 4 + 1);
            var found = Enumerable.Range(0, (int)count * 2)
                .Select(_ => new FoundChild(i, new(random.Next(mostA), random.Next(mostB)))
                {
                    LeadsOut = random.Next(2) == 0,
                    IsOfNeighbour = random.Next(2) == 0,
                    LeavesToNeighbours = random.Next(2) == 0,
                })
                .DistinctBy(child => child.Children).Take((int)count).ToArray();
            var expected = found.OrderBy(child => child.Children.A).ThenBy(child => child.Children.B).ToArray();
            if (i % 3 > 0)
                expected.CopyTo(found, 0);
            if (i % 3 == 2)
                (found[0], found[^1]) = (found[^1], found[0]);
            FoundOrder.Sort(found);
            Assert.Equal(expected, found);
        }
    }
}
