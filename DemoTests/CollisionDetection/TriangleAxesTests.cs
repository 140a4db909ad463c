using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>Boxes and triangles against triangles: cases that can be worked out by hand, sides, and what must not change a result.</summary>
public sealed class TriangleAxesTests
{
    const float Margin = 0.2f;

    // Clockwise from above; at z = -size it has an edge along X.
    static Triangle Floor(float size, bool twoSided = false) =>
        new(new(-size, 0, -size), new(size, 0, -size), new(0, 0, size)) { TwoSided = twoSided };

    static ConvexContactManifold Run<TShape>(TShape shape, Triangle triangle, Vector3 position, Quaternion orientation, float margin = 0)
        where TShape : unmanaged, IConvexShape =>
        PairHarness.Run<TShape, Triangle>(new(shape, triangle, -position, orientation, Quaternion.Identity), margin);

    static void AssertVector(Vector3 expected, Vector3 actual, float tolerance = 1e-5f) =>
        Assert.True(Vector3.Distance(expected, actual) < tolerance, $"{actual} for {expected}");

    [Theory]
    [InlineData(1e-3f)]
    [InlineData(1)]
    [InlineData(1e3f)]
    public void ABoxOnTheFloorHasItsFourCorners(float size)
    {
        var manifold = Run(new Box(1 * size, 1 * size, 1 * size), Floor(4 * size), new(0.1f * size, 0.49f * size, 0), Quaternion.Identity);
        AssertVector(Vector3.UnitY, manifold.Normal);
        Assert.Equal(4, manifold.Count);
        for (int i = 0; i < 4; ++i)
        {
            Assert.Equal(0.01f, manifold.GetDepth(i) / size, 1e-6f);
            var place = manifold.GetOffset(i) / size;
            AssertVector(new(0.5f * MathF.Sign(place.X), -0.495f, 0.5f * MathF.Sign(place.Z)), place);
        }
    }

    [Fact]
    public void ATriangleUnderALargeBoxHasItsOwnCorners()
    {
        var manifold = Run(new Box(10, 1, 10), Floor(1), new(0, 0.45f, 0), Quaternion.Identity);
        AssertVector(Vector3.UnitY, manifold.Normal);
        Assert.Equal(3, manifold.Count);
        Assert.Equal(0.05f, manifold.Deepest(), 1e-6f);
    }

    [Fact]
    public void BoxesThatArePastAreLetGo()
    {
        foreach (var height in (ReadOnlySpan<float>)[0.3f, 0.001f, 0])
            Assert.Equal(0.5f - height, Run(new Box(1, 1, 1), Floor(4), new(0, height, 0), Quaternion.Identity).Deepest(), 1e-6f);
        foreach (var height in (ReadOnlySpan<float>)[-0.001f, -0.3f, -0.51f])
            Assert.Equal(0, Run(new Box(1, 1, 1), Floor(4), new(0, height, 0), Quaternion.Identity, 0.1f).Count);
        var back = Run(new Box(1, 1, 1), Floor(4, true), new(0, -0.3f, 0), Quaternion.Identity);
        AssertVector(-Vector3.UnitY, back.Normal);
        Assert.Equal(0.2f, back.Deepest(), 1e-6f);
    }

    [Fact]
    public void ABoxFromBehindIsNotCaughtByEdges()
    {
        Triangle first = new(new(-2, 0, -2), new(2, 0, -2), new(2, 0, 2)), second = new(new(-2, 0, -2), new(2, 0, 2), new(-2, 0, 2));
        var random = new PairRandom(4);
        for (int i = 0; i < 500; ++i)
        {
            var position = new Vector3(random.Next(-1, 1), -0.01f - random.Next(0, 0.7), 0);
            position.Z = position.X + random.Next(-0.5, 0.5);
            var turn = random.NextOrientation();
            Assert.Equal(0, Run(new Box(0.5f, 1, 0.8f), first, position, turn, 0.1f).Count);
            Assert.Equal(0, Run(new Box(0.5f, 1, 0.8f), second, position, turn, 0.1f).Count);
        }
    }

    [Fact]
    public void TwoEdgesMeetWhereTheyPass()
    {
        // A box that stands on its edge along Z, over the triangle's edge along X, which sticks up.
        var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 4);
        Triangle fin = new(new(-2, 0, 0), new(2, 0, 0), new(0, -3, 0)) { TwoSided = true };
        var height = MathF.Sqrt(0.5f) - 0.02f;
        var manifold = Run(new Box(1, 1, 1), fin, new(0.3f, height, 0.1f), turn);
        AssertVector(Vector3.UnitY, manifold.Normal);
        Assert.Equal(1, manifold.Count);
        Assert.Equal(0.02f, manifold.GetDepth(0), 1e-5f);
        AssertVector(new(0, -height - 0.01f, -0.1f), manifold.GetOffset(0), 1e-4f);
    }

    [Fact]
    public void ShapesApartAtCornersSeeTheirDistance()
    {
        // Corner to corner: the box's (0.5, 0.5, 0.5) and the triangle's corner further along (2, 1, 2) / 3.
        var direction = new Vector3(2, 1, 2) / 3;
        var corner = new Vector3(0.5f, 0.5f, 0.5f) + direction * 0.1f;
        Triangle triangle = new(default, new(1, 1, 0.2f), new(0.2f, 1, 1)) { TwoSided = true };
        var manifold = PairHarness.Run<Box, Triangle>(new(new(1, 1, 1), triangle, corner, Quaternion.Identity, Quaternion.Identity), Margin);
        AssertVector(-direction, manifold.Normal);
        Assert.Equal(-0.1f, manifold.Deepest(), 1e-6f);
        Assert.Equal(0, PairHarness.Run<Box, Triangle>(new(new(1, 1, 1), triangle, corner, Quaternion.Identity, Quaternion.Identity), 0.09f).Count);
    }

    [Fact]
    public void TrianglesInOnePlaneSeeTheirDistance()
    {
        // Side by side, a corner of the one towards an edge of the other, and turned out of the plane by less than rounding shows.
        Triangle a = new(new(0, 0, -1), new(0, 0, 1), new(-1, 0, 0)) { TwoSided = true };
        Triangle b = new(default, new(1, 0, 1), new(1, 0, -1)) { TwoSided = true };
        foreach (var angle in (ReadOnlySpan<float>)[0, 1e-8f, 1e-6f, 1e-4f, 1e-2f])
        {
            var turn = Quaternion.CreateFromAxisAngle(Vector3.UnitX, angle);
            var manifold = PairHarness.Run<Triangle, Triangle>(new(a, b, new(0.1f, 0, 0), Quaternion.Identity, turn), Margin);
            AssertVector(-Vector3.UnitX, manifold.Normal);
            Assert.Equal(-0.1f, manifold.Deepest(), 1e-6f);
            Assert.Equal(0, PairHarness.Run<Triangle, Triangle>(new(a, b, new(0.25f, 0, 0), Quaternion.Identity, turn), Margin).Count);
        }
    }

    [Fact]
    public void TrianglesOnEachOtherHaveTheDepthOfTheFlatOne()
    {
        // B lies over A, turned by half a turn about Y, one corner of it dipped through A.
        Triangle a = Floor(4, true), b = new(new(-1, 0.5f, 0), new(1, 0.5f, 0), new(0, -0.03f, 0.5f)) { TwoSided = true };
        var manifold = PairHarness.Run<Triangle, Triangle>(new(a, b, default, Quaternion.Identity, Quaternion.Identity), 0.01f);
        AssertVector(-Vector3.UnitY, manifold.Normal);
        Assert.Equal(1, manifold.Count);
        Assert.Equal(0.03f, manifold.GetDepth(0), 1e-6f);
        AssertVector(new(0, -0.015f, 0.5f), manifold.GetOffset(0));
        // From the back of a one-sided floor there is none.
        a.TwoSided = false;
        Assert.Equal(1, PairHarness.Run<Triangle, Triangle>(new(a, b, default, Quaternion.Identity, Quaternion.Identity), 0.01f).Count);
        var back = Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI);
        Assert.Equal(0, PairHarness.Run<Triangle, Triangle>(new(a, b, default, Quaternion.Identity, back), 0.01f).Count);
    }

    static PairCase<TShape, Triangle>[] CreateCases<TShape>(int count, ulong seed, Func<PairRandom, TShape> create)
        where TShape : unmanaged, IConvexShape
    {
        var random = new PairRandom(seed);
        return [.. Enumerable.Range(0, count).Select(_ =>
        {
            var shape = create(new(random.NextBits()));
            var triangle = TrianglePairCases.CreateTriangle(ref random);
            var orientation = random.NextOrientation();
            var middle = Vector3.Transform((triangle.A + triangle.B + triangle.C) / 3, orientation);
            return new PairCase<TShape, Triangle>(shape, triangle, random.NextDirection() * random.Next(0, 0.6) - middle, random.NextOrientation(),
                orientation);
        })];
    }

    static Box NextBox(PairRandom random) => new(random.NextLogarithmic(0.02, 2), random.NextLogarithmic(0.2, 2), random.NextLogarithmic(0.2, 2));

    // Around its origin, and of two sides.
    static Triangle NextTriangle(PairRandom random)
    {
        var triangle = TrianglePairCases.CreateTriangle(ref random);
        var middle = (triangle.A + triangle.B + triangle.C) / 3;
        return new(triangle.A - middle, triangle.B - middle, triangle.C - middle) { TwoSided = true };
    }

    [Fact]
    public void ResultsDoNotDependOnTheOtherPairs()
    {
        CheckPurity(CreateCases(500, 1, NextBox));
        CheckPurity(CreateCases(500, 2, NextTriangle));
    }

    static void CheckPurity<TShape>(PairCase<TShape, Triangle>[] cases) where TShape : unmanaged, IConvexShape =>
        Assert.True(PairProperties.CheckPurity(cases, Margin).Count(x => x.Count > 0) > cases.Length / 10);

    [Fact]
    public void OtherOrderOfShapesGivesTheOppositeNormal()
    {
        var boxes = CreateCases(500, 4, NextBox);
        var swapped = boxes.Select(x => x.Swap()).ToArray();
        CompareSwapped(PairHarness.Run(boxes, Margin), PairHarness.Run(swapped, Margin), exactly: true);
        // Two triangles are computed in the frame of the first, so the other order is rounded otherwise.
        var triangles = CreateCases(500, 5, NextTriangle);
        var other = triangles.Select(x => x.Swap()).ToArray();
        CompareSwapped(PairHarness.Run(triangles, Margin), PairHarness.Run(other, Margin), exactly: false);
    }

    static void CompareSwapped(ConvexContactManifold[] first, ConvexContactManifold[] second, bool exactly)
    {
        var compared = 0;
        for (int i = 0; i < first.Length; ++i)
        {
            if (exactly)
                Assert.Equal(first[i].Count, second[i].Count);
            if (first[i].Count == 0 || second[i].Count == 0)
                continue;
            ++compared;
            Assert.Equal(first[i].Deepest(), second[i].Deepest(), exactly ? 0 : 1e-4f);
            if (exactly)
                Assert.Equal(first[i].Normal, -second[i].Normal);
        }
        Assert.True(compared > 50);
    }

    [Fact]
    public void ContactsMoveWithThePair()
    {
        CheckMotion(CreateCases(1000, 6, NextBox));
        CheckMotion(CreateCases(1000, 7, NextTriangle));
    }

    static void CheckMotion<TShape>(PairCase<TShape, Triangle>[] cases) where TShape : unmanaged, IConvexShape
    {
        var turned = PairProperties.RunTurned(cases, Margin);
        Assert.All(turned, x => Assert.Equal(x.Before.Deepest(), x.After.Deepest(), 1e-4f));
        Assert.True(turned.Count > 100);
    }
}
