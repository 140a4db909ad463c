using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Runtime.Intrinsics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Trees;

/// <summary>Both sides of a node at once against the comparison of boxes axis by axis, with any bits beside the corners.</summary>
public unsafe class OverlapTestTests
{
    // Few values, so that boxes touch, are flat, begin at either zero or have no end.
    static readonly float[] values =
    [
        float.NegativeInfinity, -float.MaxValue, -2, -1, -float.Epsilon, -0f, 0, float.Epsilon, 1, 2, float.MaxValue, float.PositiveInfinity,
    ];

    static readonly int[] besides = [0, 1, -1, int.MinValue, int.MaxValue, BitConverter.SingleToInt32Bits(float.NaN), BitConverter.SingleToInt32Bits(-1)];

    static (Vector3 Min, Vector3 Max) NextBox(Random random)
    {
        Vector3 min = default, max = default;
        for (int axis = 0; axis < 3; ++axis)
        {
            float a = values[random.Next(values.Length)], b = values[random.Next(values.Length)];
            min[axis] = MathF.Min(a, b);
            max[axis] = MathF.Max(a, b);
        }
        return (min, max);
    }

    [Fact]
    public void BothSidesAreThoseThatTouchTheBox()
    {
        var random = new Random(5);
        var children = stackalloc NodeChild[2];
        int overlaps = 0;
        for (int i = 0; i < 200_000; ++i)
        {
            var query = NextBox(random);
            for (int side = 0; side < 2; ++side)
            {
                var box = NextBox(random);
                children[side] = new()
                {
                    Min = box.Min,
                    Max = box.Max,
                    Index = besides[random.Next(besides.Length)],
                    LeafCount = besides[random.Next(besides.Length)],
                };
            }
            var apart = new OverlapTest(query.Min.AsVector128(), query.Max.AsVector128()).FindApart(children);
            Assert.Equal(Touch(query, children[0]), (apart & OverlapTest.SideA) == 0);
            Assert.Equal(Touch(query, children[1]), (apart & OverlapTest.SideB) == 0);
            overlaps += Touch(query, children[0]) ? 1 : 0;
        }
        Assert.InRange(overlaps, 10_000, 190_000);
    }

    static bool Touch((Vector3 Min, Vector3 Max) query, in NodeChild child) =>
        BoundingBox.IntersectsUnsafe(query.Min, query.Max, child.Min, child.Max);

    struct Listing(List<int> leaves, int most) : IBreakableForEach<int>
    {
        public readonly bool LoopBody(int leaf)
        {
            leaves.Add(leaf);
            return leaves.Count < most;
        }
    }

    [Fact]
    public void AQueryThatIsEndedHasToldTheFirstOfTheSameOrder()
    {
        using var pool = new BufferPool();
        var tree = new Tree(pool);
        var random = new Random(8);
        Vector3 Place() => new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * 10;
        for (int i = 0; i < 300; ++i)
        {
            var min = Place();
            tree.Add(new BoundingBox(min, min + Vector3.One), pool);
        }
        for (int i = 0; i < 50; ++i)
        {
            var min = Place();
            var all = new List<int>();
            var listing = new Listing(all, int.MaxValue);
            tree.GetOverlaps(min, min + new Vector3(3), pool, ref listing);
            Assert.Equal(all.Count, all.Distinct().Count());
            for (int most = 1; most <= all.Count; ++most)
            {
                var first = new List<int>();
                listing = new Listing(first, most);
                tree.GetOverlaps(min, min + new Vector3(3), pool, ref listing);
                Assert.Equal(all.Take(most), first);
            }
        }
        tree.Dispose(pool);
    }
}
