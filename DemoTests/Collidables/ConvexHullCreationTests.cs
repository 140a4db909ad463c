using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Collidables;

/// <summary>What creating a hull refuses, copies and leaves behind.</summary>
public sealed class ConvexHullCreationTests(ITestOutputHelper output) : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose()
    {
        pool.AssertEmpty();
        pool.Dispose();
    }

    public static TheoryData<HullFailure, Vector3[]> Degenerates
    {
        get
        {
            var random = new Random(3);
            var turn = HullInputs.Turn(random);
            Vector3[] plane = [.. Enumerable.Range(0, 100).Select(_ => HullInputs.InCube(random) * new Vector3(1, 0, 1))];
            Vector3[] line = [.. Enumerable.Range(0, 100).Select(_ => new Vector3(1, -2, 3) * random.NextSingle())];
            return new()
            {
                { HullFailure.TooFewPoints, [] },
                { HullFailure.TooFewPoints, [Vector3.One] },
                { HullFailure.TooFewPoints, [Vector3.Zero, Vector3.UnitX, Vector3.UnitY] },
                { HullFailure.AllPointsCoincide, [.. Enumerable.Repeat(new Vector3(1, 2, 3), 50)] },
                { HullFailure.AllPointsCoincide, [new(1e4f), new(1e4f), new(1e4f), new(1e4f + 1e-3f, 1e4f, 1e4f)] },
                { HullFailure.AllPointsOnALine, line },
                { HullFailure.AllPointsOnALine, HullInputs.Moved(line, new(1000)) },
                { HullFailure.AllPointsOnALine, HullInputs.Scaled(line, new(1e-3f)) },
                { HullFailure.AllPointsInAPlane, plane },
                { HullFailure.AllPointsInAPlane, HullInputs.Turned(plane, turn) },
                { HullFailure.AllPointsInAPlane, HullInputs.Scaled(HullInputs.Turned(plane, turn), new(1e6f)) },
                { HullFailure.AllPointsInAPlane, HullInputs.Moved(HullInputs.Turned(plane, turn), new(1e4f, 0, 1e4f)) },
                { HullFailure.AllPointsInAPlane, [.. plane.Select(p => p + new Vector3(0, 1e-6f * random.NextSingle(), 0))] },
                { HullFailure.AllPointsInAPlane, [Vector3.Zero, Vector3.UnitX, Vector3.UnitY, new(0.3f, 0.3f, 0)] },
                { HullFailure.SizeOutOfRange, HullInputs.Box(1e30f, 1e30f, 1e30f) },
                { HullFailure.SizeOutOfRange, [new(float.MinValue), new(float.MaxValue), Vector3.UnitX, Vector3.UnitY] },
                { HullFailure.SizeOutOfRange, HullInputs.Box(1e-30f, 1e-30f, 1e-30f) },
            };
        }
    }

    [Theory, MemberData(nameof(Degenerates))]
    public void PointsWithoutVolumeAreRefusedWithAReason(HullFailure expected, Vector3[] points)
    {
        Assert.False(ConvexHullHelper.TryCreateShape(points, pool, out var center, out var hull, out var failure));
        Assert.Equal((expected, default(Vector3), false), (failure, center, hull.Data.Allocated));
        Assert.False(ConvexHullHelper.CreateShape(points, pool, out _, out hull));
        Assert.False(ConvexHullHelper.CreateShape(points, pool, out var data, out _, out hull));
        Assert.False(data.OriginalVertexMapping.Allocated || data.FaceVertexIndices.Allocated || data.FaceStartIndices.Allocated);
        Assert.False(ConvexHullHelper.ComputeHull(points, pool, out data));
        var exception = Assert.Throws<ArgumentException>(() => new ConvexHull(points, pool, out _));
        Assert.Equal("points", exception.ParamName);
        Assert.Contains($"{points.Length} points", exception.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    [InlineData(float.NegativeInfinity)]
    public void PointsThatAreNotFiniteAreAnError(float value)
    {
        foreach (var axis in (ReadOnlySpan<int>)[0, 1, 2])
        {
            var points = HullInputs.Box(1, 1, 1);
            points[5][axis] = value;
            var exception = Assert.Throws<ArgumentException>(() => ConvexHullHelper.CreateShape(points, pool, out _, out _));
            Assert.Contains("point 5", exception.Message, StringComparison.Ordinal);
            Assert.Throws<ArgumentException>(() => ConvexHullHelper.ComputeHull(points.AsSpan(3, 3), pool, out _));
        }
        Assert.Throws<ArgumentNullException>(() => ConvexHullHelper.CreateShape(HullInputs.Box(1, 1, 1), null!, out _, out _));
    }

    [Fact]
    public void ShapesReturnTheMemoryOfHullsThatTheyDispose()
    {
        var shapes = new Shapes(pool, 1);
        var kept = new ConvexHull(HullInputs.Prism(7, 1), pool, out _);
        var keptIndex = shapes.Add(kept);
        var index = shapes.Add(new ConvexHull(HullInputs.Box(1, 2, 3), pool, out _));
        Assert.Equal(ConvexHull.Id, index.Type);
        shapes.RemoveAndDispose(index, pool);
        shapes.UpdateBounds(new(new Vector3(1, 2, 3)), keptIndex, out var bounds);
        Assert.Equal(new Vector3(1, 2, 3).Y + 0.5f, bounds.Max.Y);
        shapes.Remove(keptIndex);
        kept.Dispose(pool);
        Assert.Throws<ArgumentException>(() => shapes.Add(default(ConvexHull)));
        Assert.Throws<ArgumentException>(() => kept.ComputeInertia(1));
        Assert.Throws<ArgumentNullException>(() => default(ConvexHull).Dispose(null!));
        shapes.Dispose();
    }

    [Fact]
    public void WhatIsCreatedCanBeAddedAndNothingElseIsCreated()
    {
        var shapes = new Shapes(pool, 1);
        var random = new Random(5);
        int accepted = 0, refused = 0;
        for (int i = 0; i < 300; ++i)
        {
            // Half of them near one of the limits, some of these thin.
            var size = MathF.Pow(10, i % 2 == 0 ? random.NextSingle() * 30 - 15 : random.NextSingle() * 0.2f - 0.1f + (i % 4 < 2 ? -5.7f : 7.3f));
            var thickness = i % 3 == 0 ? size * MathF.Pow(10, -4 * random.NextSingle()) : size;
            if (!ConvexHullHelper.TryCreateShape(HullInputs.Box(size, thickness, size), pool, out _, out var hull, out var failure))
            {
                Assert.Equal(HullFailure.SizeOutOfRange, failure);
                Assert.True(size / 2 > 9.9e6f || thickness / 2 < 1.01e-6f, $"{size} by {thickness}");
                Assert.Equal(0, hull.Data.Length);
                ++refused;
                continue;
            }
            ++accepted;
            shapes.Add(hull);
            hull.Dispose(pool);
        }
        Assert.True(accepted > 50 && refused > 50, $"{accepted} accepted, {refused} refused");
        var good = new ConvexHull(HullInputs.Box(1, 1, 1), pool, out _);
        foreach (var scale in (ReadOnlySpan<float>)[1e-7f, 3e7f])
        {
            var transform = new Matrix3x3 { X = new(scale, 0, 0), Y = new(0, scale, 0), Z = new(0, 0, scale) };
            Assert.Throws<ArgumentException>(() => ConvexHullHelper.CreateTransformedCopy(good, transform, pool, out _));
        }
        good.Dispose(pool);
        shapes.Dispose();
        pool.AssertEmpty();
    }

    [Theory]
    [InlineData(0f)]
    [InlineData(-1f)]
    [InlineData(float.NaN)]
    [InlineData(float.PositiveInfinity)]
    [InlineData(1e-40f)]
    [InlineData(3e38f)]
    public void MassesWithoutAnInverseAreRefused(float mass)
    {
        var hull = new ConvexHull(HullInputs.Box(1, 2, 3), pool, out _);
        Assert.Equal("mass", Assert.Throws<ArgumentOutOfRangeException>(() => hull.ComputeInertia(mass)).ParamName);
        hull.Dispose(pool);
    }

    [Fact]
    public void IndicesThatAreNotThereAreRefused()
    {
        Assert.True(ConvexHullHelper.CreateShape(HullInputs.Box(1, 2, 3), pool, out var data, out _, out var hull));
        foreach (var index in (ReadOnlySpan<int>)[-1, 8, int.MaxValue])
        {
            Assert.Throws<ArgumentOutOfRangeException>(() => hull.GetPoint(index, out _));
            Assert.Throws<ArgumentOutOfRangeException>(() => hull.GetVertexIndicesForFace(index, out _));
            Assert.Throws<ArgumentOutOfRangeException>(() => data.GetFace(index, out _));
        }
        hull.GetPoint(new HullVertexIndex { BundleIndex = 0, InnerIndex = 1 }, out var point);
        Assert.Equal(HullInputs.Box(1, 2, 3)[1], point);
        data.Dispose(pool);
        data.Dispose(pool);
        hull.Dispose(pool);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void TheDataSaysTheSameAsTheShape(int seed)
    {
        var random = new Random(seed);
        Vector3[] points = [.. Enumerable.Range(0, 300).Select(_ => HullInputs.InCube(random) + new Vector3(5, 0, 0))];
        Assert.True(ConvexHullHelper.CreateShape(points, pool, out var data, out var center, out var hull));
        var checker = new HullChecker(hull);
        Assert.Equal(checker.Faces.Count, data.FaceStartIndices.Length);
        for (int i = 0; i < checker.Faces.Count; ++i)
        {
            data.GetFace(i, out var face);
            Assert.Equal(checker.Faces[i], face.AsSpan().ToArray());
        }
        for (int i = 0; i < checker.Vertices.Count; ++i)
            Assert.Equal(0, (checker.Vertices[i] + center - points[data.OriginalVertexMapping[i]]).Length, 1e-6);
        Assert.Equal(checker.Vertices.Count, data.OriginalVertexMapping.AsSpan().ToArray().Distinct().Count());
        hull.Dispose(pool);
        data.Dispose(pool);
    }

    /// <summary>Sizes of one and the same hull, whatever the order of its points; bit by bit the same from the same points.</summary>
    [Fact]
    public void OrderDoesNotMatterAndTheSamePointsGiveTheSameBits()
    {
        var hash = new StateHash();
        for (int seed = 0; seed < 100; ++seed)
        {
            var points = ConvexHullFuzzTests.Generate(seed, out _);
            if (!ConvexHullHelper.CreateShape(points, pool, out var center, out var hull))
                continue;
            Assert.True(ConvexHullHelper.CreateShape(points, pool, out var sameCenter, out var same));
            Assert.Equal(center, sameCenter);
            Assert.True(hull.Data.AsSpan().SequenceEqual(same.Data.AsSpan()));
            var random = new Random(seed);
            random.Shuffle(points);
            Assert.True(ConvexHullHelper.CreateShape(points, pool, out _, out var shuffled));
            HullChecker checker = new(hull), other = new(shuffled);
            Assert.Null(other.FindFault());
            Assert.Equal(1, other.Volume / checker.Volume, 0.01);
            foreach (var vertex in checker.Vertices)
                hash.Add(vertex.ToVector3());
            foreach (var face in checker.Faces)
            {
                foreach (var vertex in face)
                    hash.Add(vertex);
            }
            foreach (var (normal, offset) in checker.Planes)
            {
                hash.Add(normal.ToVector3());
                hash.Add((float)offset);
            }
            hull.Dispose(pool);
            same.Dispose(pool);
            shuffled.Dispose(pool);
        }
        output.WriteLine($"{Vector<float>.Count} lanes: {hash.Value:x16}");
    }

    [Theory]
    [InlineData(2, 2, 2)]
    [InlineData(0.001f, 0.001f, 0.001f)]
    [InlineData(1, 10, 0.1f)]
    [InlineData(1, 1000, 1)]
    [InlineData(-1, 1, 1)]
    [InlineData(-1, -3, -1)]
    public void CopiesAreTransformed(float x, float y, float z)
    {
        var random = new Random(8);
        var points = HullInputs.Turned(HullInputs.Prism(9, 1.3f), HullInputs.Turn(random));
        var hull = new ConvexHull(points, pool, out _);
        var shear = new Matrix3x3(new(x, 0.2f * y, 0), new(0, y, 0.1f * z), new(0, 0, z));
        ConvexHullHelper.CreateTransformedCopy(hull, shear, pool, out var copy);
        ConvexHullHelper.CreateTransformedShallowCopy(hull, shear, pool, out var second);
        HullChecker original = new(hull), checker = new(copy);
        Assert.Null(checker.FindFault());
        Assert.Equal(1, checker.Volume / original.Volume / Math.Abs((double)x * y * z), 1e-5);
        for (int i = 0; i < original.Vertices.Count; ++i)
        {
            var v = original.Vertices[i];
            Double3 expected = new(v.X * x, v.X * 0.2f * y + v.Y * y, v.Y * 0.1f * z + v.Z * z);
            Assert.Equal(0, (expected - checker.Vertices[i]).Length, 1e-6 * checker.Size);
        }
        Assert.True(copy.Data.AsSpan().SequenceEqual(second.Data.AsSpan()));
        second.Dispose(pool);
        hull.Dispose(pool);
        copy.Dispose(pool);
    }

    [Fact]
    public void CopiesThroughMatricesWithoutAnInverseAreRefused()
    {
        var hull = new ConvexHull(HullInputs.Box(1, 1, 1), pool, out _);
        foreach (var scale in (ReadOnlySpan<float>)[0, float.NaN, float.PositiveInfinity, 3e38f])
            Assert.Throws<ArgumentException>(() => ConvexHullHelper.CreateTransformedCopy(hull, Matrix3x3.CreateScale(new(scale, scale, 2)), pool, out _));
        hull.Dispose(pool);
        Assert.Throws<ArgumentException>(() => ConvexHullHelper.CreateTransformedCopy(hull, Matrix3x3.Identity, pool, out _));
    }
}
