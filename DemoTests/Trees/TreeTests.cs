using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using FsCheck;
using FsCheck.Fluent;
using Xunit;

namespace DemoTests.Trees;

public class TreeTests
{
    [Fact]
    public void AnyChangesKeepTheInvariantsAndTheOverlaps() =>
        Prop.ForAll(TreeGenerators.Sequences(160), operations =>
        {
            using var model = new TreeModel();
            foreach (var operation in operations)
            {
                model.Apply(operation);
                model.Validate();
            }
            var expected = model.BruteForceSelfOverlaps();
            Assert.Equal(expected, model.SelfOverlaps());
            Assert.Equal(expected, model.SelfOverlapsWithPool());
        }).Check(TreeGenerators.Reproducible(200));

    [Fact]
    public void TwoTreesMeetWhereTheirBoxesDo() =>
        Prop.ForAll(TreeGenerators.Sequences(60), TreeGenerators.Sequences(60), (first, second) =>
        {
            using var a = new TreeModel();
            using var b = new TreeModel();
            foreach (var operation in first)
                a.Apply(operation);
            foreach (var operation in second)
                b.Apply(operation);
            Assert.Equal(a.BruteForceOverlaps(b), a.Overlaps(b));
        }).Check(TreeGenerators.Reproducible(150));

    [Fact]
    public void BoxQueriesFindWhatTheyTouch() =>
        Prop.ForAll(TreeGenerators.Sequences(80), TreeGenerators.Boxes.ToArbitrary(), (operations, query) =>
        {
            using var model = new TreeModel();
            foreach (var operation in operations)
                model.Apply(operation);
            Assert.Equal(model.BruteForceOverlaps(query), model.Overlaps(query));
            var everything = new BoundingBox(new Vector3(float.NegativeInfinity), new Vector3(float.PositiveInfinity));
            Assert.Equal(Enumerable.Range(0, model.Boxes.Count), model.Overlaps(everything));
        }).Check(TreeGenerators.Reproducible(150));

    [Theory]
    [InlineData(0), InlineData(1), InlineData(2), InlineData(3), InlineData(7), InlineData(8),
     InlineData(9), InlineData(17), InlineData(1000)]
    public void ABuildOfAnySizeIsRight(int count)
    {
        using var model = new TreeModel();
        var boxes = TreeGenerators.World(count, seed: 4, largest: 10);
        model.Tree.BinnedBuild(boxes, model.Pool);
        model.Boxes.AddRange(boxes);
        model.Validate();
        Assert.True(model.Tree.IsDepthFirst);
        Assert.Equal(model.BruteForceSelfOverlaps(), model.SelfOverlaps());
        Assert.Equal(model.BruteForceSelfOverlaps(), model.SelfOverlapsWithPool());
    }

    [Fact]
    public void ABoxQueryStopsWhenToldTo()
    {
        using var model = new TreeModel(TreeGenerators.World(100, seed: 1));
        var leaves = new TreeModel.LeafList { Leaves = [], Limit = 3 };
        model.Tree.GetOverlaps(new Vector3(-1000), new Vector3(1000), model.Pool, ref leaves);
        Assert.Equal(3, leaves.Leaves.Count);
    }

    [Fact]
    public void TheLastLeafMovesIntoTheHole()
    {
        using var model = new TreeModel(TreeGenerators.World(10, seed: 2));
        Assert.Equal(9, model.Tree.RemoveAt(4));
        Assert.Equal(-1, model.Tree.RemoveAt(8));
        Assert.Equal(model.Boxes[9].Min, model.Tree.GetBounds(4).Min);
    }

    [Fact]
    public void RefusedCallsChangeNothing()
    {
        using var model = new TreeModel(TreeGenerators.World(20, seed: 3));
        var pool = model.Pool;
        foreach (var bad in new[]
        {
            new BoundingBox(new(0, 0, 1), new(1, 1, 0)),
            new BoundingBox(new(float.NaN, 0, 0), new(1, 1, 1)),
            new BoundingBox(new(0, 0, 0), new(1, float.NaN, 1)),
            new BoundingBox(new(0, 0, 0), new(1, 1, float.PositiveInfinity)),
            new BoundingBox(new(float.NegativeInfinity, 0, 0), new(1, 1, 1))
        })
        {
            Assert.ThrowsAny<ArgumentException>(() => model.Tree.Add(bad, pool));
            Assert.ThrowsAny<ArgumentException>(() => model.Tree.AddWithoutRefinement(bad, pool));
            Assert.ThrowsAny<ArgumentException>(() => model.Tree.UpdateBounds(0, bad));
            Assert.ThrowsAny<ArgumentException>(() => model.Tree.BinnedBuild([bad], pool));
        }
        foreach (var index in new[] { -1, 20, int.MinValue, int.MaxValue })
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => model.Tree.RemoveAt(index));
            Assert.Throws<ArgumentOutOfRangeException>(() => model.Tree.UpdateBounds(index, default));
            Assert.Throws<ArgumentOutOfRangeException>(() => model.Tree.GetBounds(index));
        }
        Assert.Throws<ArgumentOutOfRangeException>(() => new Tree(pool, 0));
        Assert.Throws<ArgumentOutOfRangeException>(() => model.Tree.EnsureCapacity(-1, pool));
        Assert.Throws<ArgumentNullException>(() => model.Tree.Add(default, null!));
        Assert.ThrowsAny<ArgumentException>(() => model.Overlaps(new BoundingBox(new(1), new(0))));
        model.Validate();
    }

    [Fact]
    public void CapacityChangesKeepTheContent()
    {
        using var model = new TreeModel(TreeGenerators.World(100, seed: 5));
        model.Tree.EnsureCapacity(5000, model.Pool);
        Assert.True(model.Tree.Leaves.Length >= 5000);
        model.Validate();
        model.Tree.Resize(model.Pool, 0);
        Assert.InRange(model.Tree.Leaves.Length, 100, 256);
        model.Validate();
    }

    [Fact]
    public void ATreeThatWasNeverConstructedTakesLeavesToo()
    {
        using var model = new TreeModel();
        model.Tree.Dispose(model.Pool);
        model.Tree.Dispose(model.Pool);
        foreach (var box in TreeGenerators.World(30, seed: 6))
            model.Add(box);
        model.Validate();
    }

    [Fact]
    public unsafe void ValidateSeesDamage()
    {
        using var model = new TreeModel(TreeGenerators.World(50, seed: 7));
        ref var tree = ref model.Tree;
        tree.GetBoundsPointers(11, out var min, out _);
        *min -= new Vector3(5);
        Assert.Throws<PhysicsInvariantException>(() => model.Tree.Validate());
        model.Tree.Validate(tightBounds: false);
        *min += new Vector3(5);

        ++tree.Leaves[3].Slot;
        Assert.Throws<PhysicsInvariantException>(() => model.Tree.Validate(tightBounds: false));
        --tree.Leaves[3].Slot;
        ++tree.Metanodes[5].Height;
        Assert.Throws<PhysicsInvariantException>(() => model.Tree.Validate(tightBounds: false));
        --tree.Metanodes[5].Height;
        ++tree.Nodes[9].A.LeafCount;
        Assert.Throws<PhysicsInvariantException>(() => model.Tree.Validate(tightBounds: false));
    }
}
