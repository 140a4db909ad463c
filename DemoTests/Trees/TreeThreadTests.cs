using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuUtilities;
using Xunit;

namespace DemoTests.Trees;

/// <summary>Passes over a whole tree on many threads leave the tree that one thread leaves.</summary>
public class TreeThreadTests
{
    // From a bit more than what is worth threads on; in one row, so that the tree is as deep as it may be; all in one place, so that no split is any good.
    public static TheoryData<string> Kinds => new("world", "large world", "row", "point");

    static List<BoundingBox> Boxes(string kind) => kind switch
    {
        "world" => [.. TreeGenerators.World(2100, seed: 3)],
        "large world" => [.. TreeGenerators.World(9000, seed: 4)],
        // Each twice as far as the one before, until floats end, and again.
        "row" => [.. Enumerable.Range(0, 2500).Select(i => new BoundingBox(new(MathF.Pow(2, i % 120) + i / 120), new(MathF.Pow(2, i % 120) + i / 120 + 1)))],
        _ => [.. Enumerable.Repeat(new BoundingBox(Vector3.Zero, Vector3.One), 3000)],
    };

    [Theory]
    [MemberData(nameof(Kinds))]
    public void A_tree_is_built_as_by_one_thread(string kind)
    {
        using var expected = new TreeModel(Boxes(kind));
        expected.Tree.BinnedBuild(expected.Pool);
        foreach (int threads in (ReadOnlySpan<int>)[2, 3, 5, 8])
        {
            using var dispatcher = new ThreadDispatcher(threads);
            using var model = new TreeModel(Boxes(kind));
            model.Tree.BinnedBuild(model.Pool, dispatcher);
            model.Validate();
            Assert.Equal(TreeBytes.Of(expected.Tree), TreeBytes.Of(model.Tree));
            model.Tree.BinnedBuild(Boxes(kind).ToArray(), model.Pool, dispatcher);
            model.Validate();
            Assert.Equal(TreeBytes.Of(expected.Tree), TreeBytes.Of(model.Tree));
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void A_tree_is_fitted_as_by_one_thread(string kind)
    {
        using var expected = new TreeModel(Boxes(kind));
        expected.Tree.BinnedBuild(expected.Pool);
        Move(expected);
        expected.Tree.Refit(expected.Pool);
        foreach (int threads in (ReadOnlySpan<int>)[2, 3, 5, 8])
        {
            using var dispatcher = new ThreadDispatcher(threads);
            using var model = new TreeModel(Boxes(kind));
            model.Tree.BinnedBuild(model.Pool);
            Move(model);
            model.Tree.Refit(model.Pool, dispatcher);
            model.Validate();
            Assert.Equal(TreeBytes.Of(expected.Tree), TreeBytes.Of(model.Tree));
        }
    }

    /// <summary>Leaves that have come and gone leave nodes in any order; sorting them is part of fitting and of refinement.</summary>
    [Theory]
    [MemberData(nameof(Kinds))]
    public void A_tree_is_sorted_and_refined_as_by_one_thread(string kind)
    {
        List<byte[]> expected = Churn(kind, null);
        foreach (int threads in (ReadOnlySpan<int>)[2, 5])
        {
            using var dispatcher = new ThreadDispatcher(threads);
            TreeBytes.AssertSame(expected, Churn(kind, dispatcher));
        }
    }

    static List<byte[]> Churn(string kind, IThreadDispatcher? dispatcher)
    {
        const int steps = 20;
        List<BoundingBox> boxes = Boxes(kind);
        using var model = new TreeModel(boxes);
        var trees = new List<byte[]>();
        var sorted = 0;
        for (int i = 0; i < steps; ++i)
        {
            Move(model);
            // Nothing comes or goes in some steps: what has to be sorted then is what a rebuilt top has moved.
            for (int j = 0; j < 30 && i % 3 == 0; ++j)
            {
                model.Remove((i * 131 + j * 17) % model.Boxes.Count);
                model.Add(boxes[(i * 57 + j * 29) % boxes.Count]);
            }
            sorted += model.Tree.IsDepthFirst ? 0 : 1;
            model.Tree.Refit(model.Pool, dispatcher);
            model.Tree.Refine(model.Pool, dispatcher);
            Assert.True(model.Tree.IsDepthFirst);
            // What threads leave has the same bytes.
            if (dispatcher is null)
                model.Validate();
            trees.Add(TreeBytes.Of(model.Tree));
        }
        Assert.True(sorted >= steps / 3);
        return trees;
    }

    static void Move(TreeModel model) => model.MoveAll(leaf => new Vector3(leaf % 5 - 2, leaf % 3 - 1, leaf % 7 - 3) * .7f);
}
