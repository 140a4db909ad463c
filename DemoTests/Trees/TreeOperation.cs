using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuUtilities;
using FsCheck;
using FsCheck.Fluent;

namespace DemoTests.Trees;

public enum TreeOperationKind
{
    Add, AddWithoutRefinement, Remove, UpdateBounds, WriteAllBounds, RefitInPlace, Refit, Refine, Build, Clear
}

/// <summary>One change of a tree; the place is taken modulo the present number of leaves.</summary>
public sealed record TreeOperation(TreeOperationKind Kind, int Place, BoundingBox Box);

static class TreeGenerators
{
    public static Config Reproducible(int count) => Config.QuickThrowOnFailure.WithMaxTest(count).WithReplay(77_001, 901);

    /// <summary>Boxes on a coarse grid, so that many touch exactly, coincide, or have no extent on some axis.</summary>
    public static Gen<BoundingBox> Boxes =>
        from x in Gen.Choose(-20, 20)
        from y in Gen.Choose(-20, 20)
        from z in Gen.Choose(-20, 20)
        from width in Gen.Choose(0, 6)
        from height in Gen.Choose(0, 6)
        from length in Gen.Choose(0, 6)
        from scale in Gen.Frequency((12, Gen.Constant(0.25f)), (1, Gen.Constant(1e-4f)), (1, Gen.Constant(1e4f)))
        select new BoundingBox(new Vector3(x, y, z) * scale, new Vector3(x + width, y + height, z + length) * scale);

    static Gen<TreeOperation> Operation =>
        from kind in Gen.Frequency(
            (12, Gen.Constant(TreeOperationKind.Add)),
            (4, Gen.Constant(TreeOperationKind.AddWithoutRefinement)),
            (7, Gen.Constant(TreeOperationKind.Remove)),
            (4, Gen.Constant(TreeOperationKind.UpdateBounds)),
            (1, Gen.Constant(TreeOperationKind.WriteAllBounds)),
            (1, Gen.Constant(TreeOperationKind.RefitInPlace)),
            (1, Gen.Constant(TreeOperationKind.Refit)),
            (2, Gen.Constant(TreeOperationKind.Refine)),
            (1, Gen.Constant(TreeOperationKind.Build)))
        from place in Gen.Choose(0, 1 << 20)
        from box in Boxes
        select new TreeOperation(kind, place, box);

    public static Arbitrary<TreeOperation[]> Sequences(int maximumLength)
    {
        var sequences =
            from length in Gen.Choose(0, maximumLength)
            from operations in Gen.ArrayOf(Operation, length)
            select operations;
        return Arb.From(sequences, Shorten);
    }

    static IEnumerable<TreeOperation[]> Shorten(TreeOperation[] operations)
    {
        if (operations.Length == 0)
            yield break;
        yield return operations[..(operations.Length / 2)];
        yield return operations[((operations.Length + 1) / 2)..];
        for (var i = 0; i < operations.Length; ++i)
            yield return [.. operations[..i], .. operations[(i + 1)..]];
    }

    /// <summary>A world of boxes of one size or of many, dense enough that each meets several others.</summary>
    public static BoundingBox[] World(int count, int seed, float largest = 1)
    {
        var random = new Random(seed);
        var side = MathF.Cbrt(count) * 1.3f;
        return Enumerable.Range(0, count).Select(_ =>
        {
            var center = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * side;
            var half = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * 0.5f + new Vector3(0.2f);
            if (random.Next(50) == 0)
                half *= largest;
            return new BoundingBox(center - half, center + half);
        }).ToArray();
    }
}
