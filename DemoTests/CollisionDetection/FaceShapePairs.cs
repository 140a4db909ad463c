using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using DemoTests.CollisionDetection.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What has to hold for every pair of shape types.</summary>
static class FaceShapePairs<TShapeA, TShapeWideA, TFeatureA, TShapeB, TShapeWideB, TFeatureB>
    where TShapeA : unmanaged where TShapeWideA : unmanaged, IWide<TShapeA> where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
    where TShapeB : unmanaged where TShapeWideB : unmanaged, IWide<TShapeB> where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
{
    /// <summary>Anything at all: directions, depths and witnesses that belong to no such pair.</summary>
    static FacePair<TShapeA, TShapeB> CreateAny(ref PairRandom random, TShapeA a, TShapeB b) => new(
        a, b, random.NextDirection(), random.NextOrientation(), random.NextOrientation(),
        random.Next(3) == 0 ? Vector3.UnitY * (random.Next(2) * 2 - 1) : random.NextDirection(), random.Next(-0.1, 0.2), random.NextDirection(),
        random.Next(2) == 0 ? 0.1f : 10);

    /// <summary>The bits of a lane do not depend on what the others hold, nor on its place.</summary>
    public static void AssertLanesArePure(Func<int, TShapeA> a, Func<int, TShapeB> b)
    {
        var random = new PairRandom(77);
        List<FacePair<TShapeA, TShapeB>> pairs = [];
        for (int i = 0; i < 400; ++i)
            pairs.Add(CreateAny(ref random, a(i), b(i)));
        var expected = Run(pairs);
        Assert.True(expected.Count(contacts => contacts.Contacts.Length > 1) > 20);
        var order = Enumerable.Range(0, pairs.Count).ToArray();
        foreach (var fill in new[] { 0, float.NaN, float.PositiveInfinity, 1e30f })
        {
            for (int i = order.Length - 1; i > 0; --i)
            {
                var j = random.Next(i + 1);
                (order[i], order[j]) = (order[j], order[i]);
            }
            AssertSame(expected, FaceHarness<TShapeA, TShapeWideA, TFeatureA, TShapeB, TShapeWideB, TFeatureB>.Run(pairs, order, fill));
        }
        var alone = pairs.Select(pair => FaceHarness<TShapeA, TShapeWideA, TFeatureA, TShapeB, TShapeWideB, TFeatureB>.Run(pair)).ToArray();
        AssertSame(expected, alone);
    }

    static FaceContacts[] Run(List<FacePair<TShapeA, TShapeB>> pairs) =>
        FaceHarness<TShapeA, TShapeWideA, TFeatureA, TShapeB, TShapeWideB, TFeatureB>.Run(pairs);

    static void AssertSame(FaceContacts[] expected, FaceContacts[] actual)
    {
        for (int i = 0; i < expected.Length; ++i)
            Assert.True(expected[i].SameBits(actual[i]), $"pair {i}");
    }

    /// <summary>Contacts are where the features overlap, as deep as they are there, and follow A wherever it is turned to.</summary>
    /// <returns>How many pairs had two contacts or more.</returns>
    public static int AssertContactsLieOnBothFeatures(Func<int, TShapeA> a, Func<int, TShapeB> b)
    {
        var random = new PairRandom(78);
        List<FacePair<TShapeA, TShapeB>> pairs = [];
        List<(FaceReference Reference, double Size)> references = [];
        while (pairs.Count < 600)
        {
            var pair = CreateAny(ref random, a(pairs.Count), b(pairs.Count)) with { SpeculativeMargin = float.MaxValue };
            if (TryPlace(ref pair, out var reference, out var size))
            {
                pairs.Add(pair);
                references.Add((reference, size));
            }
        }
        var results = Run(pairs);
        var turned = Run([.. pairs.Select(pair => pair with { OrientationA = Quaternion.Normalize(pair.OrientationA * new Quaternion(1, 2, 3, 4)) })]);
        for (int i = 0; i < pairs.Count; ++i)
        {
            var (reference, size) = references[i];
            var contacts = results[i].Contacts;
            Assert.InRange(contacts.Length, 1, 4);
            Assert.Equal(contacts.Length, contacts.Select(contact => contact.FeatureId).Distinct().Count());
            Assert.InRange(pairs[i].Depth - results[i].Deepest, -1e-6 * size, 2e-4 * size);
            Assert.Equal(contacts.Length, turned[i].Contacts.Length);
            for (int k = 0; k < contacts.Length; ++k)
            {
                var point = reference.Project(contacts[k].Offset);
                Assert.True(reference.Outside(point.X, point.Y) < 5e-5 * size, $"{i}: outside {reference.Outside(point.X, point.Y)}");
                Assert.Equal(Math.Min(reference.DepthAt(point.X, point.Y), pairs[i].Depth), contacts[k].Depth, 5e-5 * size);
                Assert.Equal(reference.HeightOfA(point.X, point.Y) + contacts[k].Depth * 0.5, point.Height, 5e-5 * size);
                Assert.True((turned[i].Contacts[k].Offset - contacts[k].Offset).Length < 2e-6 * size);
                Assert.Equal(contacts[k].FeatureId, turned[i].Contacts[k].FeatureId);
            }
        }
        return results.Count(contacts => contacts.Contacts.Length >= 2);
    }

    /// <summary>Where the features hold no point that is as deep as the pair, the pair's own witness is a contact.</summary>
    public static void AssertTheWitnessStandsIn(Func<int, TShapeA> a, Func<int, TShapeB> b)
    {
        var random = new PairRandom(79);
        List<FacePair<TShapeA, TShapeB>> pairs = [];
        List<double> sizes = [];
        while (pairs.Count < 300)
        {
            var pair = CreateAny(ref random, a(pairs.Count), b(pairs.Count));
            if (!TryPlace(ref pair, out _, out var size))
                continue;
            // As if there were a corner beyond the features, somewhat below A's.
            var more = (float)size * random.Next(1e-3, 0.1);
            pairs.Add(pair with
            {
                Depth = pair.Depth + more,
                PointOnA = pair.PointOnA - pair.Normal * (more * 0.5f) + Vector3.Cross(pair.Normal, random.NextDirection()) * (float)size,
            });
            sizes.Add(size);
        }
        var results = Run(pairs);
        for (int i = 0; i < pairs.Count; ++i)
        {
            var witness = Assert.Single(results[i].Contacts, contact => (contact.FeatureId & 255) == 255);
            Assert.Equal(pairs[i].Depth, witness.Depth);
            var place = pairs[i].PointOnA + pairs[i].Normal * (pairs[i].Depth * 0.5f);
            Assert.True((witness.Offset - new Double3(place)).Length < 2e-6 * (1 + sizes[i]));
            Assert.Equal(witness.Depth, results[i].Deepest);
            Assert.Equal(results[i].Contacts.Length, results[i].Contacts.Select(contact => contact.FeatureId).Distinct().Count());
        }
    }

    /// <summary>Puts B where the features overlap and are a little deep, and says what a search would have found.</summary>
    static bool TryPlace(ref FacePair<TShapeA, TShapeB> pair, out FaceReference reference, out double size)
    {
        var normal = pair.Normal;
        var featureA = FaceFeature.Find<TShapeA, TShapeWideA, TFeatureA>(pair.A, -normal);
        var directionB = Vector3.Transform(normal, Quaternion.Conjugate(pair.LocalOrientationB));
        var featureB = FaceFeature.Find<TShapeB, TShapeWideB, TFeatureB>(pair.B, directionB);
        size = Math.Min(featureA.Size, featureB.Size);
        reference = null!;
        // Steep features and two segments have tests of their own.
        if (Cosine(featureA, -normal) < 0.2f || Cosine(featureB, directionB) < 0.2f || (featureA.Vertices.Length == 2 && featureB.Vertices.Length == 2))
            return false;
        for (int round = 0; round < 2; ++round)
        {
            reference = new(featureA.VerticesAt(default, Quaternion.Identity, -normal),
                featureB.VerticesAt(pair.LocalOffsetB, pair.LocalOrientationB, normal), new(normal));
            if (reference.Corners.Count == 0)
                return false;
            var (depth, point) = reference.FindDeepest();
            if (round == 0)
                pair.LocalOffsetB += normal * (0.01f - (float)depth);
            pair.Depth = (float)depth;
            pair.PointOnA = new((float)point.X, (float)point.Y, (float)point.Z);
        }
        return true;
    }

    static float Cosine(FaceFeature feature, Vector3 direction) =>
        feature.PlaneNormal == Vector3.Zero ? 0 : Vector3.Dot(Vector3.Normalize(feature.PlaneNormal), direction);
}
