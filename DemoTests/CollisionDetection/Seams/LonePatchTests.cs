using System;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What is made of a child that is alone without its having to agree is what agreeing with nobody makes of it, bit for bit.</summary>
public sealed class LonePatchTests
{
    readonly Random random = new(7);

    float Next() => random.NextSingle() * 2 - 1;

    Vector3 NextNormal() => Vector3.Normalize(new(Next(), Next(), Next() + 1e-3f));

    ConvexContactManifold NextManifold(Vector3 normal)
    {
        var manifold = new ConvexContactManifold { OffsetB = new(Next(), Next(), Next()), Normal = normal, Count = random.Next(1, 5) };
        for (int i = 0; i < manifold.Count; ++i)
        {
            ConvexContactManifold.GetConvexContactReference(ref manifold, i) = new()
            {
                Offset = new(Next(), Next(), Next()),
                Depth = Next(),
                FeatureId = random.Next(),
            };
        }
        return manifold;
    }

    // Up to four patches, of which some are near the normal.
    KnownPatches NextKnown(Vector3 normal)
    {
        var known = default(KnownPatches);
        var count = random.Next(5);
        var first = random.Next(4);
        for (int i = 0; i < count; ++i)
        {
            var near = Vector3.Normalize(normal + .6f * new Vector3(Next(), Next(), Next()));
            known.Add((first + i) % 4, new() { Normal = random.Next(2) == 0 ? near : NextNormal(), First = random.Next(), Second = random.Next() });
        }
        return known;
    }

    [Fact]
    public void A_child_that_is_alone_becomes_the_same_patch_either_way()
    {
        var pool = new BufferPool();
        var memory = new SeamMemory();
        var (newCount, keptCount) = (0, 0);
        for (int i = 0; i < 500; ++i)
        {
            var normal = NextNormal();
            var child = new ChildResult { Children = new(0, random.Next(100)), OffsetA = new(Next(), Next(), Next()), Manifold = NextManifold(normal) };
            var known = NextKnown(normal);

            ChildResult[] results = [child];
            var target = new ChildResult[PatchSet.Capacity];
            memory.Rank([new RankedChild()], pool);
            Assert.Equal(1, PatchSet.Build(ref memory, results, new PlacedChildren[1], known, target, pool));

            var alone = default(ChildResult);
            PatchSet.BuildOfOne(ref child, known, ref alone);

            Assert.True(BytesOf.AreEqual(target[^1], alone));
            Assert.Equal(results[0].Manifold.Count, child.Manifold.Count);
            var isKept = false;
            for (int j = 0; j < known.Count; ++j)
                isKept |= Vector3.Dot(known[j].Normal, normal) > .95f && known.Number(j) == alone.Children.B;
            (newCount, keptCount) = isKept ? (newCount, keptCount + 1) : (newCount + 1, keptCount);
        }
        // Both kinds have come up.
        Assert.InRange(keptCount, 50, 450);
        Assert.InRange(newCount, 50, 450);
        memory.Dispose(pool);
        pool.AssertEmpty();
        pool.Clear();
    }
}
