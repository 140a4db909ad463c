using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Trees;

/// <summary>A tree beside the list of boxes that it should hold.</summary>
unsafe sealed class TreeModel : IDisposable
{
    public readonly BufferPool Pool = new();
    public readonly List<BoundingBox> Boxes = [];
    public Tree Tree;

    public TreeModel() => Tree = new Tree(Pool, 1);

    public TreeModel(IEnumerable<BoundingBox> boxes) : this()
    {
        foreach (var box in boxes)
            Add(box);
    }

    public void Add(BoundingBox box)
    {
        Assert.Equal(Boxes.Count, Tree.Add(box, Pool));
        Boxes.Add(box);
    }

    public void Apply(TreeOperation operation)
    {
        var index = Boxes.Count == 0 ? 0 : operation.Place % Boxes.Count;
        switch (operation.Kind)
        {
            case TreeOperationKind.Add:
                Add(operation.Box);
                break;
            case TreeOperationKind.AddWithoutRefinement:
                Assert.Equal(Boxes.Count, Tree.AddWithoutRefinement(operation.Box, Pool));
                Boxes.Add(operation.Box);
                break;
            case TreeOperationKind.Remove when Boxes.Count > 0:
                Remove(index);
                break;
            case TreeOperationKind.UpdateBounds when Boxes.Count > 0:
                Tree.UpdateBounds(index, operation.Box.Min, operation.Box.Max);
                Boxes[index] = operation.Box;
                break;
            case TreeOperationKind.WriteAllBounds:
                MoveAll(leaf => operation.Box.Min * (leaf % 3 * 0.1f));
                Tree.Refit();
                break;
            case TreeOperationKind.RefitInPlace:
                Tree.Refit();
                break;
            case TreeOperationKind.Refit:
                Tree.Refit(Pool);
                Assert.True(Tree.IsDepthFirst);
                break;
            case TreeOperationKind.Refine:
                Tree.Refine(Pool);
                break;
            case TreeOperationKind.Build:
                Tree.BinnedBuild(Pool);
                break;
            case TreeOperationKind.Clear:
                Tree.Clear();
                Boxes.Clear();
                break;
        }
    }

    public void Remove(int index)
    {
        var moved = Tree.RemoveAt(index);
        var last = Boxes.Count - 1;
        Assert.Equal(index == last ? -1 : last, moved);
        Boxes[index] = Boxes[last];
        Boxes.RemoveAt(last);
    }

    /// <summary>Writes through bounds pointers, without a refit.</summary>
    public void MoveAll(Func<int, Vector3> offset)
    {
        for (var leaf = 0; leaf < Boxes.Count; ++leaf)
        {
            var box = Boxes[leaf];
            box.Min += offset(leaf);
            box.Max += offset(leaf);
            Boxes[leaf] = box;
            Tree.GetBoundsPointers(leaf, out var min, out var max);
            *min = box.Min;
            *max = box.Max;
        }
    }

    /// <summary>Invariants, and the box of each leaf to the bit.</summary>
    public void Validate()
    {
        Tree.Validate();
        Assert.Equal(Boxes.Count, Tree.LeafCount);
        for (var leaf = 0; leaf < Boxes.Count; ++leaf)
        {
            var box = Tree.GetBounds(leaf);
            Assert.True(box.Min == Boxes[leaf].Min && box.Max == Boxes[leaf].Max, $"Leaf {leaf} has another box.");
        }
    }

    public (int, int)[] BruteForceSelfOverlaps() =>
        (from a in Enumerable.Range(0, Boxes.Count)
         from b in Enumerable.Range(a + 1, Boxes.Count - a - 1)
         where BoundingBox.Intersects(Boxes[a], Boxes[b])
         select (a, b)).ToArray();

    public (int, int)[] BruteForceOverlaps(TreeModel other) =>
        (from a in Enumerable.Range(0, Boxes.Count)
         from b in Enumerable.Range(0, other.Boxes.Count)
         where BoundingBox.Intersects(Boxes[a], other.Boxes[b])
         select (a, b)).ToArray();

    public int[] BruteForceOverlaps(BoundingBox box) =>
        Enumerable.Range(0, Boxes.Count).Where(leaf => BoundingBox.Intersects(Boxes[leaf], box)).ToArray();

    public (int, int)[] SelfOverlaps()
    {
        var pairs = new PairList { Pairs = [] };
        Tree.GetSelfOverlaps(ref pairs);
        return pairs.Sorted();
    }

    public (int, int)[] SelfOverlapsWithPool()
    {
        var pairs = new PairList { Pairs = [] };
        Tree.GetSelfOverlaps(ref pairs, Pool);
        return pairs.Sorted();
    }

    public (int, int)[] Overlaps(TreeModel other)
    {
        var pairs = new PairList { Pairs = [] };
        Tree.GetOverlaps(ref other.Tree, ref pairs);
        return pairs.Sorted();
    }

    public int[] Overlaps(BoundingBox box)
    {
        var leaves = new LeafList { Leaves = [] };
        Tree.GetOverlaps(box, Pool, ref leaves);
        return leaves.Leaves.Order().ToArray();
    }

    /// <summary>Fails when the tree did not give all memory back.</summary>
    public void Dispose()
    {
        Tree.Dispose(Pool);
        Pool.AssertEmpty();
        Pool.Clear();
    }

    public struct PairList : IOverlapHandler
    {
        public List<(int, int)> Pairs;

        public readonly void Handle(int indexA, int indexB) => Pairs.Add((indexA, indexB));

        public readonly (int, int)[] Sorted() => Pairs.Order().ToArray();
    }

    public struct LeafList : IBreakableForEach<int>
    {
        public List<int> Leaves;
        public int Limit;

        public readonly bool LoopBody(int leaf)
        {
            Leaves.Add(leaf);
            return Leaves.Count != Limit;
        }
    }
}
