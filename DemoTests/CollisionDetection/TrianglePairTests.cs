using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>Spheres and capsules against triangles of one and of two sides.</summary>
public sealed class TrianglePairTests(ITestOutputHelper output)
{
    const int CaseCount = 100_000;
    const float Margin = 0.2f;
    // How far from the edge of a rule (which side, which normals) both answers are right.
    const double Undecided = 2e-4;
    // The plane of a triangle that is a hundred times as long as thick is as uncertain as that times the rounding of its corners.
    const double SideTolerance = 2e-5;

    [Fact]
    public void SphereTriangle() => Measure(TrianglePairCases.CreateSpheres(CaseCount, 31), x => x.Radius, _ => 0, 2e-6);

    [Fact]
    public void CapsuleTriangle() => Measure(TrianglePairCases.CreateCapsules(CaseCount, 32), x => x.Radius, x => x.HalfLength, 1e-5);

    void Measure<TShape>(PairCase<TShape, Triangle>[] cases, Func<TShape, double> getRadius, Func<TShape, double> getHalfLength, double tolerance)
        where TShape : unmanaged, IConvexShape
    {
        var manifolds = PairHarness.Run(cases, Margin);
        List<double> depthErrors = [], relativeErrors = [], normalErrors = [], placeErrors = [];
        int missed = 0, needless = 0, undecided = 0, refused = 0;
        (double Error, string Text) worst = default, worstNormal = default, worstPlace = default;
        for (int i = 0; i < cases.Length; ++i)
        {
            var (shape, triangle, offset, orientationA, orientationB) = cases[i];
            double radius = getRadius(shape), halfLength = getHalfLength(shape);
            var reference = new SegmentTriangle(triangle, offset, orientationB, Double3.RotatedAxis(orientationA, 1), halfLength);
            var size = radius + halfLength + reference.Reach(offset);
            var smaller = Math.Min(radius + halfLength, reference.TriangleSize);
            var separation = reference.Separation;
            var distance = separation.Length;
            var crosses = distance < 1e-7 * size;
            // The direction between two points is as uncertain as their rounding over their distance.
            var uncertainty = Undecided + 1e-6 * size / distance;
            var facing = crosses ? 0 : Double3.Dot(separation, reference.Front) / distance;
            // The depth of a pair of two sides, and which answers a single side leaves.
            var least = crosses ? reference.LeastDepth : -distance;
            double[] depths = [least];
            var mayExist = true;
            var mustExist = true;
            if (!triangle.TwoSided)
            {
                mayExist = reference.CenterHeight >= -SideTolerance * size && facing >= -uncertainty;
                mustExist = reference.CenterHeight >= SideTolerance * size && facing >= uncertainty - Undecided;
                if (crosses)
                {
                    var certain = reference.AxisDepths().Where(x => x.Facing > Undecided).Min(x => x.Depth);
                    depths = [certain, .. reference.AxisDepths().Where(x => Math.Abs(x.Facing) <= Undecided && x.Depth < certain).Select(x => x.Depth)];
                }
                refused += mayExist ? 0 : 1;
            }
            undecided += mayExist && !mustExist ? 1 : 0;
            ref var manifold = ref manifolds[i];
            if (manifold.Count == 0)
            {
                missed += mustExist && depths.Min() + radius > -Margin + tolerance * size ? 1 : 0;
                continue;
            }
            needless += !mayExist || depths.Max() + radius < -Margin - tolerance * size ? 1 : 0;
            var normal = new Double3(manifold.Normal);
            Assert.Equal(1, normal.Length, 5e-6);
            var deepest = manifold.Deepest();
            var error = depths.Min(x => Math.Abs(deepest - radius - x));
            depthErrors.Add(error / size);
            relativeErrors.Add(error / smaller);
            if (error / size > worst.Error)
                worst = (error / size, $"{i}: {cases[i]}, {deepest - radius} for {string.Join(" or ", depths)}");
            var normalError = Math.Abs(reference.DepthAlong(normal * (1 / normal.Length)) + radius - deepest) / size;
            normalErrors.Add(crosses ? normalError : Math.Max(0, normalError - 3e-7 * size / distance));
            if (normalErrors[^1] > worstNormal.Error)
                worstNormal = (normalErrors[^1], $"{i}: {cases[i]}, {deepest - radius}, {distance}");
            if (!triangle.TwoSided)
                Assert.True(Double3.Dot(normal, reference.Front) > -Undecided);
            // Where a single side leaves the longer way, the place of the contact is that of the segment alone.
            if (depths.Min() > least + tolerance * size)
                continue;
            for (int j = 0; j < manifold.Count; ++j)
            {
                var place = new Double3(manifold.GetOffset(j));
                var halfway = Math.Abs(manifold.GetDepth(j)) * 0.5;
                var fromSurface = Math.Max(reference.FromSegment(place) - radius, reference.FromTriangle(place).Length);
                placeErrors.Add(Math.Max(0, fromSurface - halfway) / size);
                if (placeErrors[^1] > worstPlace.Error)
                    worstPlace = (placeErrors[^1], $"{i}: {cases[i]}, {place}, {manifold.GetDepth(j)} of {deepest}");
            }
        }
        output.WriteLine($"{typeof(TShape).Name}-Triangle, {depthErrors.Count} pairs with {placeErrors.Count} contacts, {refused} refused by side, " +
            $"{undecided} undecided; p50, p99.9, worst:");
        output.WriteErrors("depth by size of the pair", depthErrors);
        output.WriteErrors("depth by size of the smaller", relativeErrors);
        output.WriteErrors("depth along the normal", normalErrors);
        output.WriteErrors("place of contacts", placeErrors);
        output.WriteLine("  worst depth: " + worst.Text);
        output.WriteLine("  worst normal: " + worstNormal.Text);
        output.WriteLine("  worst place: " + worstPlace.Text);
        Assert.Equal((0, 0), (missed, needless));
        Assert.True(depthErrors[^1] < tolerance, $"depth {worst.Text}");
        Assert.True(normalErrors[^1] < tolerance, $"normal {normalErrors[^1]}");
        Assert.True(placeErrors[^1] < 5e-4, $"place {placeErrors[^1]}");
    }

    [Fact]
    public void ResultsDoNotDependOnTheOtherPairs()
    {
        PairProperties.CheckPurity(TrianglePairCases.CreateSpheres(333, 6), Margin);
        PairProperties.CheckPurity(TrianglePairCases.CreateCapsules(333, 7), Margin);
    }

    [Fact]
    public void OtherOrderOfShapesGivesTheOppositeNormal()
    {
        CheckSwap(TrianglePairCases.CreateSpheres(500, 8));
        CheckSwap(TrianglePairCases.CreateCapsules(500, 9));
    }

    static void CheckSwap<TShape>(PairCase<TShape, Triangle>[] cases) where TShape : unmanaged, IConvexShape
    {
        var swapped = cases.Select(x => x.Swap()).ToArray();
        var first = PairHarness.Run(cases, Margin);
        var second = PairHarness.Run(swapped, Margin);
        for (int i = 0; i < cases.Length; ++i)
        {
            Assert.Equal(first[i].Count, second[i].Count);
            Assert.Equal(first[i].Normal, -second[i].Normal);
            for (int j = 0; j < first[i].Count; ++j)
            {
                Assert.Equal(first[i].GetDepth(j), second[i].GetDepth(j));
                Assert.Equal(first[i].GetFeatureId(j), second[i].GetFeatureId(j));
                Assert.True(Vector3.Distance(first[i].GetOffset(j), second[i].GetOffset(j) + cases[i].OffsetB) < 1e-5f);
            }
        }
    }

    [Fact]
    public void ContactsMoveWithThePair()
    {
        CheckMotion(TrianglePairCases.CreateSpheres(2000, 10));
        CheckMotion(TrianglePairCases.CreateCapsules(2000, 11));
    }

    static void CheckMotion<TShape>(PairCase<TShape, Triangle>[] cases) where TShape : unmanaged, IConvexShape
    {
        // Deep ones may leave by another way when they are rounded otherwise.
        cases = [.. cases.Where((x, i) => (PairKind)(i % 5) is PairKind.Apart or PairKind.Touching or PairKind.Shallow && x.B.TwoSided)];
        var turned = PairProperties.RunTurned(cases, Margin);
        Assert.All(turned, x => Assert.Equal(x.Before.Deepest(), x.After.Deepest(), 2e-5f));
        Assert.True(turned.Count > 300);
    }

    /// <summary>The reference itself against a search over directions.</summary>
    [Fact]
    public void NoDirectionIsBetterThanTheReference()
    {
        var crossing = 0;
        var cases = TrianglePairCases.CreateCapsules(700, 5);
        for (int i = 0; i < cases.Length; ++i)
        {
            var (capsule, triangle, offset, orientationA, orientationB) = cases[i];
            var reference = new SegmentTriangle(triangle, offset, orientationB, Double3.RotatedAxis(orientationA, 1), capsule.HalfLength);
            var expected = reference.Crosses ? reference.LeastDepth : -reference.Separation.Length;
            crossing += reference.Crosses ? 1 : 0;
            var best = double.MaxValue;
            Double3 direction = default;
            const int Count = 1000;
            for (int j = 0; j < Count; ++j)
            {
                var z = 1 - (2 * j + 1.0) / Count;
                var r = Math.Sqrt(1 - z * z);
                Try(new(r * Math.Cos(j * 2.399963), r * Math.Sin(j * 2.399963), z));
            }
            var random = new PairRandom((ulong)i);
            for (double step = 0.1; step > 1e-9; step *= 0.95)
            {
                for (int j = 0; j < 8; ++j)
                    Try(direction + new Double3(random.NextDirection()) * step);
            }
            Assert.True(best >= expected - 1e-9, $"{best} < {expected} in {cases[i]}");
            // Two points are as far apart as their shapes along the line through them: then none are nearer.
            if (expected < -1e-4)
                Assert.Equal(expected, reference.DepthAlong(reference.Separation * (-1 / expected)), 1e-6);

            void Try(Double3 candidate)
            {
                candidate *= 1 / candidate.Length;
                var along = reference.DepthAlong(candidate);
                if (along < best)
                    (best, direction) = (along, candidate);
            }
        }
        Assert.InRange(crossing, 50, 600);
    }
}
