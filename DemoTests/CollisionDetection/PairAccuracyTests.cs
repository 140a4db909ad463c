using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.CollisionDetection.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection;

/// <summary>Every pair of shapes against an enumeration of all features and axes in double precision.</summary>
/// <remarks>
/// Errors are relative to the size of the pair, which is the sum of the distances from the centres to the farthest points: that is the
/// scale of the numbers that the test computes with, and so of their rounding.
/// </remarks>
public sealed class PairAccuracyTests(ITestOutputHelper output)
{
    const int CaseCount = 100_000;

    static Sphere CreateSphere(PairRandom random) => new(random.NextLogarithmic(0.01, 1));

    static Capsule CreateCapsule(PairRandom random) =>
        new(random.NextLogarithmic(0.01, 1), random.Next(8) == 0 ? 0 : random.NextLogarithmic(0.01, 2));

    static Box CreateBox(PairRandom random) =>
        new(random.NextLogarithmic(0.02, 2), random.NextLogarithmic(0.02, 2), random.NextLogarithmic(0.02, 2));

    [Fact]
    public void SphereSphere() => Measure(CreateSphere, CreateSphere, 1e-6);

    [Fact]
    public void SphereCapsule() => Measure(CreateSphere, CreateCapsule, 1e-6);

    [Fact]
    public void SphereBox() => Measure(CreateSphere, CreateBox, 1e-6);

    [Fact]
    public void CapsuleCapsule() => Measure(CreateCapsule, CreateCapsule, 1e-5);

    [Fact]
    public void CapsuleBox() => Measure(CreateCapsule, CreateBox, 1e-5);

    [Fact]
    public void BoxBox() => Measure(CreateBox, CreateBox, 1e-5);

    void Measure<TShapeA, TShapeB>(Func<PairRandom, TShapeA> createA, Func<PairRandom, TShapeB> createB, double tolerance)
        where TShapeA : unmanaged, IConvexShape where TShapeB : unmanaged, IConvexShape
    {
        const float Margin = 0.2f;
        var random = new PairRandom(1234);
        var kinds = Enum.GetValues<PairKind>();
        var cases = new PairCase<TShapeA, TShapeB>[CaseCount];
        for (int i = 0; i < CaseCount; ++i)
            cases[i] = PairHarness.Create(ref random, kinds[i % kinds.Length], createA, createB);
        var manifolds = PairHarness.Run(cases, Margin);

        var depthErrors = new List<double>();
        var normalErrors = new List<double>();
        var placeErrors = new List<double>();
        var worst = new Dictionary<PairKind, double>();
        var cornerErrors = new List<double>();
        int missed = 0, needless = 0;
        for (int i = 0; i < CaseCount; ++i)
        {
            var (shapeA, shapeB, offsetB, orientationA, orientationB) = cases[i];
            var a = PairHarness.Reference(shapeA, default, orientationA);
            var b = PairHarness.Reference(shapeB, offsetB, orientationB);
            var size = a.Size + b.Size;
            ref var manifold = ref manifolds[i];
            var depth = PairReference.Depth(a, b);
            var wanted = depth > -Margin + tolerance * size;
            var exact = true;
            if (a.IsBox && b.IsBox && depth <= 0)
            {
                // Boxes that are apart at a corner: no axis shows their whole distance, and what does has a tolerance of its own.
                exact = PairReference.AxisDepth(a, b) - depth < 1e-13;
            }
            if (manifold.Count == 0)
            {
                missed += wanted ? 1 : 0;
                continue;
            }
            needless += depth < -Margin - tolerance * size ? 1 : 0;
            var normal = new Double3(manifold.Normal);
            var along = PairReference.DepthAlong(a, b, normal * (1 / normal.Length));
            var deepest = manifold.Deepest();
            Assert.Equal(1, normal.Length, 5e-6);
            var depthError = Math.Abs(deepest - depth) / size;
            if (!exact)
            {
                cornerErrors.Add(Math.Max(depthError, Math.Abs(along - depth) / size));
                continue;
            }
            normalErrors.Add(Math.Abs(along - depth) / size);
            depthErrors.Add(depthError);
            var kind = kinds[i % kinds.Length];
            worst[kind] = Math.Max(worst.GetValueOrDefault(kind), depthError);
            for (int j = 0; j < manifold.Count; ++j)
                placeErrors.Add(PlaceError(a, b, manifold, j) / size);
        }
        output.WriteLine(
            $"{typeof(TShapeA).Name}-{typeof(TShapeB).Name}, {depthErrors.Count} pairs with {placeErrors.Count} contacts, p50, p99.9, worst:");
        output.WriteErrors("depth", depthErrors);
        output.WriteErrors("depth along the normal", normalErrors);
        if (cornerErrors.Count > 0)
            output.WriteErrors("apart at a corner", cornerErrors);
        output.WriteErrors("place of contacts", placeErrors);
        output.WriteLine("  worst depth: " + string.Join("  ", worst.Select(x => $"{x.Key} {x.Value:e1}")));
        Assert.Equal((0, 0), (missed, needless));
        Assert.True(depthErrors.Max() < tolerance, $"depth {depthErrors.Max()}");
        Assert.True(normalErrors.Max() < tolerance, $"normal {normalErrors.Max()}");
        // Borders of boxes are widened by 1e-5 of their size; capsules share a contact that is 0.02 of the smaller radius to the side.
        Assert.True(placeErrors.Max() < 6e-5, $"place {placeErrors.Max()}");
        Assert.True(cornerErrors.Count == 0 || cornerErrors.Max() < 1e-3, "apart at a corner");
    }

    /// <summary>How much farther a contact is from either surface than halfway between the two.</summary>
    static double PlaceError(RoundedBox a, RoundedBox b, in ConvexContactManifold manifold, int index)
    {
        var place = new Double3(manifold.GetOffset(index));
        var halfway = Math.Abs(manifold.GetDepth(index)) * 0.5;
        return Math.Max(0, Math.Max(a.SignedDistance(place), b.SignedDistance(place)) - halfway);
    }

    /// <summary>The enumeration itself against a search over directions.</summary>
    [Fact]
    public void NoDirectionIsBetterThanTheReference()
    {
        var random = new PairRandom(99);
        for (int i = 0; i < 60; ++i)
        {
            CheckReference(PairHarness.Create(ref random, PairKind.Deep, CreateBox, CreateBox));
            CheckReference(PairHarness.Create(ref random, PairKind.Apart, CreateCapsule, CreateBox));
            CheckReference(PairHarness.Create(ref random, PairKind.Deep, CreateCapsule, CreateBox));
            CheckReference(PairHarness.Create(ref random, PairKind.Deep, CreateCapsule, CreateCapsule));
        }
    }

    static void CheckReference<TShapeA, TShapeB>(PairCase<TShapeA, TShapeB> pair)
    {
        var a = PairHarness.Reference(pair.A, default, pair.OrientationA);
        var b = PairHarness.Reference(pair.B, pair.OffsetB, pair.OrientationB);
        var depth = PairReference.Depth(a, b);
        // A spiral of directions, then steps around the best one that become ever smaller.
        var best = double.MaxValue;
        Double3 direction = default;
        const int Count = 4000;
        for (int i = 0; i < Count; ++i)
        {
            var z = 1 - (2 * i + 1.0) / Count;
            var r = Math.Sqrt(1 - z * z);
            Try(new(r * Math.Cos(i * 2.399963), r * Math.Sin(i * 2.399963), z));
        }
        var random = new PairRandom((ulong)(pair.OffsetB.X * 1e6f + 1e9f));
        for (double step = 0.05; step > 1e-9; step *= 0.97)
        {
            for (int i = 0; i < 8; ++i)
                Try(direction + new Double3(random.NextDirection()) * step);
        }
        // The other bound needs no search: the reference is the depth along an axis, or the distance of two points.
        Assert.True(best >= depth - 1e-9, $"{best} < {depth}");

        void Try(Double3 candidate)
        {
            candidate *= 1 / candidate.Length;
            var along = PairReference.DepthAlong(a, b, candidate);
            if (along < best)
                (best, direction) = (along, candidate);
        }
    }
}
