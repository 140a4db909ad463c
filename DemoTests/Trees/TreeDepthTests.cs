using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using Xunit;

namespace DemoTests.Trees;

/// <summary>No order of insertion and no kind of box makes a tree deeper than its traversals can take, nor an insertion slow.</summary>
public class TreeDepthTests
{
    public static TheoryData<string> Kinds => [.. Orders.Keys];

    static readonly Dictionary<string, Func<int, BoundingBox>> Orders = new()
    {
        ["along a line"] = i => Cube(new(i, 0, 0), 0.4f),
        ["points on a line"] = i => Cube(new(i, 0, 0), 0),
        ["all the same"] = _ => Cube(new(1, 2, 3), 1),
        ["all the same point"] = _ => Cube(default, 0),
        ["nested, growing"] = i => Cube(default, i),
        ["nested, shrinking"] = i => Cube(default, 1e6f / (1 + i)),
        ["doubling distances"] = i => Cube(new(MathF.ScaleB(1, i % 120), 0, 0), MathF.ScaleB(0.25f, i % 120)),
        ["halving distances"] = i => Cube(new(MathF.ScaleB(1, -(i % 140)), 0, 0), 0),
        ["far away"] = i => Cube(new(2e38f, -2e38f, i % 2 * 2e38f), 2e37f * (i % 7)),
        ["so far that areas overflow"] = i => Cube(new(i * 1e30f, -i * 1e30f, 0), 1e29f),
        ["two clusters in turn"] = i => Cube(new(i % 2 * 1e6f, i / 2, 0), 0.5f),
        ["one huge box again and again"] = i => i % 10 == 0 ? Cube(default, 1e6f) : Cube(new(i * 0.1f, 0, 0), 0.05f),
        ["denormal"] = i => Cube(new(i * 1e-45f, 0, 0), 1e-45f)
    };

    static BoundingBox Cube(Vector3 center, float half)
    {
        var size = new Vector3(half);
        return new BoundingBox(center - size, center + size);
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void EveryOrderStaysShallow(string kind)
    {
        const int Count = 3000;
        foreach (var refine in new[] { true, false })
        {
            using var model = new TreeModel();
            for (var i = 0; i < Count; ++i)
            {
                var box = Orders[kind](i);
                if (refine)
                    model.Add(box);
                else
                    model.Apply(new TreeOperation(TreeOperationKind.AddWithoutRefinement, 0, box));
                Assert.InRange(model.Tree.Height, 1, Tree.MaximumHeight);
            }
            model.Validate();
            // Every builder and every traversal over what came out of it.
            for (var i = 0; i < 40; ++i)
                model.Tree.Refine(model.Pool);
            model.Validate();
            model.Tree.BinnedBuild(model.Pool);
            model.Validate();
            var query = Orders[kind](17);
            Assert.Equal(model.BruteForceOverlaps(query), model.Overlaps(query));
            for (var i = 0; i < Count / 2; ++i)
                model.Remove(i * 7919 % model.Boxes.Count);
            model.Validate();
            CountOverlaps(model);
        }
    }

    [Theory]
    [InlineData("along a line"), InlineData("all the same"), InlineData("nested, growing"), InlineData("doubling distances")]
    public void AHundredThousandLeavesInABadOrder(string kind)
    {
        using var model = new TreeModel();
        for (var i = 0; i < 100_000; ++i)
        {
            var box = Orders[kind](i);
            model.Boxes.Add(box);
            model.Tree.Add(box, model.Pool);
        }
        Assert.InRange(model.Tree.Height, 17, Tree.MaximumHeight);
        model.Validate();
        model.Tree.Refine(model.Pool);
        model.Tree.BinnedBuild(model.Pool);
        Assert.InRange(model.Tree.Height, 17, Tree.MaximumHeight);
        model.Validate();
        var query = new BoundingBox(new(0.5f), new(0.6f));
        Assert.Equal(model.BruteForceOverlaps(query), model.Overlaps(query));
    }

    [Fact]
    public void EqualBoxesAreHalved()
    {
        using var model = new TreeModel(Enumerable.Repeat(Cube(Vector3.One, 1), 1024));
        Assert.InRange(model.Tree.Height, 10, 20);
        model.Tree.BinnedBuild(model.Pool);
        Assert.InRange(model.Tree.Height, 10, 11);
        CountOverlaps(model, 1024 * 1023 / 2);
    }

    static void CountOverlaps(TreeModel model, int? expected = null)
    {
        var plain = new Counter();
        model.Tree.GetSelfOverlaps(ref plain);
        var runs = new Counter();
        model.Tree.GetSelfOverlaps(ref runs, model.Pool);
        Assert.Equal((plain.Count, plain.Sum), (runs.Count, runs.Sum));
        Assert.Equal(expected ?? plain.Count, plain.Count);
    }

    struct Counter : IOverlapHandler
    {
        public long Count;
        public ulong Sum;

        public void Handle(int indexA, int indexB)
        {
            Assert.True(indexA < indexB);
            ++Count;
            // A sum does not care for order, and the product makes it care for what was summed.
            Sum += ((ulong)indexA << 32 | (uint)indexB) * 0x9E3779B97F4A7C15;
        }
    }
}
