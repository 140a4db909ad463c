using System;
using System.Collections.Generic;
using System.Numerics;
using BepuUtilities;
using Xunit;

namespace DemoTests.Trees;

public class TreeRefinementTests
{
    [Theory]
    [InlineData(40), InlineData(400), InlineData(4000)]
    public void AWanderingWorldStaysNearlyAsGoodAsANewTree(int count)
    {
        using var refined = new TreeModel(TreeGenerators.World(count, seed: 10));
        using var neglected = new TreeModel(refined.Boxes);
        var random = new Random(11);
        var offsets = new Vector3[count];
        for (var step = 0; step < 200; ++step)
        {
            for (var i = 0; i < count; ++i)
                offsets[i] = new Vector3(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f);
            foreach (var model in new[] { refined, neglected })
            {
                model.MoveAll(leaf => offsets[leaf]);
                model.Tree.Refit(model.Pool);
            }
            refined.Tree.Refine(refined.Pool);
        }
        refined.Validate();
        var reached = refined.Tree.MeasureRelativeCost();
        var untouched = neglected.Tree.MeasureRelativeCost();
        refined.Tree.BinnedBuild(refined.Pool);
        var best = refined.Tree.MeasureRelativeCost();
        Assert.True(reached < 1.5f * best, $"Cost {reached}, a new tree has {best}.");
        Assert.True(count < 100 || reached < 0.75f * untouched, $"Cost {reached}, without refinement {untouched}.");
    }

    [Fact]
    public void RefinementOfAPoorTreeComesCloseToABuild()
    {
        using var model = new TreeModel();
        foreach (var box in TreeGenerators.World(3000, seed: 12))
            model.Apply(new TreeOperation(TreeOperationKind.AddWithoutRefinement, 0, box));
        var poor = model.Tree.MeasureRelativeCost();
        for (var i = 0; i < 300; ++i)
            model.Tree.Refine(model.Pool);
        var reached = model.Tree.MeasureRelativeCost();
        model.Tree.BinnedBuild(model.Pool);
        var best = model.Tree.MeasureRelativeCost();
        Assert.True(best < poor, $"A build costs {best}, insertion {poor}.");
        Assert.True(reached < 1.2f * best, $"Refinement ended at {reached}, a build at {best}.");
    }

    [Fact]
    public void TheSameCallsMakeTheSameTree()
    {
        using var first = MakeBusyTree();
        using var second = MakeBusyTree();
        Assert.Equal(TreeBytes.Of(first.Tree), TreeBytes.Of(second.Tree));
    }

    /// <summary>Where nothing moves nothing is gained, even if all is on a grid and any order is as good: then no node may be moved either.</summary>
    [Fact]
    public unsafe void AGridAtRestIsLeftAlone()
    {
        var boxes = new List<BoundingBox>();
        for (var i = 0; i < 4096; ++i)
        {
            var place = new Vector3(i % 64, 0, i / 64) * 2;
            boxes.Add(new BoundingBox(place, place + Vector3.One));
        }
        using var model = new TreeModel(boxes);
        for (var i = 0; i < 4000; ++i)
            model.Tree.Refine(model.Pool);
        var (nodes, bytes) = ((nint)model.Tree.Nodes.Memory, TreeBytes.Of(model.Tree));
        for (var i = 0; i < 1000; ++i)
        {
            model.Tree.Refine(model.Pool);
            Assert.Equal(nodes, (nint)model.Tree.Nodes.Memory);
        }
        Assert.Equal(bytes, TreeBytes.Of(model.Tree));
        model.Validate();
    }

    static TreeModel MakeBusyTree()
    {
        var model = new TreeModel(TreeGenerators.World(1500, seed: 13, largest: 20));
        for (var i = 0; i < 60; ++i)
        {
            model.MoveAll(leaf => new Vector3(leaf % 5 - 2, leaf % 3 - 1, leaf % 7 - 3) * 0.1f);
            model.Tree.Refit(model.Pool);
            model.Tree.Refine(model.Pool);
            model.Remove(i * 13 % model.Boxes.Count);
            model.Add(model.Boxes[i]);
        }
        return model;
    }
}
